import json
from collections.abc import Callable
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.core.clock import RealClock
from hri.emotion.dynamics import Dynamics
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import Memory, keep, memory_file


@pytest.fixture
def dynamics(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Dynamics:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return load_emotions("neutral").dynamics()


def remember(
    dynamics: Dynamics, seconds_ago: float, personality: str = "neutral", has_ended: bool = False
) -> None:
    """A robot was scolded by Bob so many seconds ago, and keeps it."""
    affect = dynamics.feel(dynamics.rest(500.0), "scold", 1.0, 500.0, "Bob")
    wall = RealClock().wall().timestamp() - seconds_ago
    keep(memory_file(), Memory(affect.imprint, 500.0, wall, personality, has_ended=has_ended))


def test_one_sees_what_a_robot_feels_now_not_what_it_felt_when_it_was_kept(
    dynamics: Dynamics, capsys: pytest.CaptureFixture[str]
) -> None:
    sadness = []
    for seconds_ago in (0.0, 20.0):
        remember(dynamics, seconds_ago)
        assert main(["emotion", "watch", "--once", "--json"]) == 0
        state = json.loads(capsys.readouterr().out)
        sadness.append(state["emotions"]["sadness"])
        assert state["why"][0]["cause"] == "scold"
        assert state["why"][0]["age_s"] == pytest.approx(seconds_ago, abs=5)
    then = dynamics.feel(dynamics.rest(), "scold", 1.0, 0.0)
    for seen, age in zip(sadness, (0.0, 20.0), strict=True):
        felt = dynamics.read(dynamics.advance(then, age)).emotions["sadness"]
        assert seen == pytest.approx(felt, abs=0.1)


def test_people_are_told_in_words(dynamics: Dynamics, capsys: pytest.CaptureFixture[str]) -> None:
    remember(dynamics, 0.0)
    assert main(["emotion", "watch", "--once"]) == 0
    line = capsys.readouterr().out
    assert "sadness" in line
    assert "I am sad because Bob scolded me" in line
    assert "company 0.60" in line
    assert "ended" not in line


@pytest.mark.parametrize(
    ("seconds_ago", "has_ended", "told"),
    [(0.0, True, "just now"), (130.0, True, "2 minutes ago"), (4000.0, False, "an hour ago")],
)
def test_one_sees_that_a_robot_has_ended_or_that_its_plug_was_pulled(
    dynamics: Dynamics,
    capsys: pytest.CaptureFixture[str],
    seconds_ago: float,
    has_ended: bool,
    told: str,
) -> None:
    remember(dynamics, seconds_ago, has_ended=has_ended)
    assert main(["emotion", "watch", "--once"]) == 0
    assert f"(it ended {told})" in capsys.readouterr().out
    assert main(["emotion", "watch", "--once", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["running"] is False


class Patience(RealClock):
    """A clock that does not wait; something happens in each pause, and after the last it ends."""

    def __init__(self, *happenings: Callable[[], object]) -> None:
        super().__init__()
        self._happenings = list(happenings)

    def advance(self, seconds: float) -> None:
        if not self._happenings:
            raise KeyboardInterrupt
        self._happenings.pop(0)()


def test_watching_goes_on_while_files_are_broken_or_gone(
    dynamics: Dynamics,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text("[baseline]\npleasure = 7", encoding="utf-8")
    remember(dynamics, 0.0, personality=str(mine))
    clock = Patience(
        lambda: None,
        lambda: mine.write_text("[baseline]\npleasure = 0.5", encoding="utf-8"),
        memory_file().unlink,
        lambda: remember(dynamics, 0.0, personality=str(mine)),
    )
    monkeypatch.setattr("hri.cli.emotion.watch.RealClock", lambda: clock)
    assert main(["emotion", "watch"]) == 0
    told = capsys.readouterr()
    assert told.out.count("I am sad because Bob scolded me") == 2
    assert told.err.count("mine.toml:2:") == 1
    assert told.err.count("no robot saves its feelings here") == 1
    mine.write_text("baseline", encoding="utf-8")
    assert main(["emotion", "watch", "--once"]) == 2


def test_a_robot_that_keeps_nothing_cannot_be_watched(
    dynamics: Dynamics, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["emotion", "watch", "--once"]) == 2
    assert "no robot saves its feelings here - run an app" in capsys.readouterr().err
    memory_file().parent.mkdir(parents=True)
    memory_file().write_text("{", encoding="utf-8")
    assert main(["emotion", "watch", "--once"]) == 2
    assert memory_file().read_text(encoding="utf-8") == "{", "only a robot puts its file aside"


def test_one_command_forgets_a_person_or_everything(
    dynamics: Dynamics,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)  # recordings below the current folder would be found, too
    remember(dynamics, 0.0)
    assert main(["emotion", "forget", "Bop"]) == 2
    assert 'did you mean "Bob"' in capsys.readouterr().err
    assert main(["emotion", "forget", "Bob"]) == 0
    assert "Bob" not in memory_file().read_text(encoding="utf-8")
    assert main(["emotion", "forget"]) == 0
    assert not memory_file().exists()
    assert main(["emotion", "forget"]) == 0
    assert "nothing to forget" in capsys.readouterr().out
