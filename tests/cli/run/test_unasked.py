"""Nothing is recorded unless it is asked for."""

from hri.cli import run as run_app
from hri.cli.main import main


def test_without_a_screen_nothing_is_recorded_and_what_can_be_seen_is_told(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    # Whatever this machine has.
    missing = {"microphone", "camera", "screen", "speaker"}
    monkeypatch.setattr(run_app, "open_senses", lambda robot: missing)
    assert main(["companion", "--config", "simulated", "--duration", "0.1"]) == 0
    assert list(tmp_path.iterdir()) == []
    assert run_app.UNSEEN in capsys.readouterr().out
