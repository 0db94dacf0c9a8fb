"""What a run keeps of people's doings: nothing, unless it is asked to."""

import argparse

import pytest

from hri.cli.main import main
from hri.cli.run import add_arguments, memory_of
from hri.emotion.behaviors import EmotionModel
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import Memory, keep, memory_file, recall


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


@pytest.fixture
def app(tmp_path):
    """An app that feels, and does nothing else."""
    folder = tmp_path / "app"
    folder.mkdir()
    (folder / "app.toml").write_text('networks = ["feeling.xml"]\n')
    (folder / "feeling.xml").write_text(
        '<BehaviorNetwork name="feeling"><Behavior id="emotion" type="Hri.EmotionModel"/>'
        "</BehaviorNetwork>"
    )
    return str(folder)


def options(*words):
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return parser.parse_args(["companion", *words])


def remember_ann(wall=1e9):
    dynamics = load_emotions("neutral").dynamics()
    affect = dynamics.feel(dynamics.rest(0.0), "praise", 1.0, 0.0, "Ann")
    keep(memory_file(), Memory(affect.imprint, 0.0, wall))


@pytest.mark.parametrize("words", [[], ["--headless", "--duration", "5"], ["--fast"]])
def test_nothing_that_is_felt_outlasts_a_run_that_was_not_asked_to_keep_it(words):
    assert memory_of(options(*words)) == ""
    assert memory_of(options(*words, "--keep")) == str(memory_file())


@pytest.mark.parametrize(
    ("words", "may_ask"), [((), True), (("--fast",), False), (("--seed", "0"), False)]
)
def test_it_may_ask_whether_to_keep_unless_the_run_is_to_repeat(app, monkeypatch, words, may_ask):
    files = set()
    monkeypatch.setattr(EmotionModel, "check", lambda model: files.add(model.memory_after_yes))
    assert run(app, *words) == 0
    assert files == {str(memory_file()) if may_ask else ""}


def run(app, *words):
    return main(["run", app, "--config", "simulated", "--headless", "--duration", "0.2", *words])


@pytest.mark.parametrize("words", [(), ("--fast",)])
def test_the_visitor_of_a_demo_is_not_kept_among_people(app, capsys, words):
    remember_ann()
    before = memory_file().read_bytes()
    assert run(app, "--demo", "--keep", *words) == 2
    assert "--demo --keep" in capsys.readouterr().err
    assert memory_file().read_bytes() == before


def test_a_run_keeps_what_it_feels_only_when_it_is_told_to(app, tmp_path):
    assert run(app) == 0
    assert not (tmp_path / "state").exists()
    assert run(app, "--fast", "--keep") == 0
    assert recall(memory_file()).has_ended


def test_what_was_kept_earlier_is_told_in_one_line_and_left_alone(app, capsys):
    remember_ann()
    before = memory_file().read_bytes()
    assert run(app) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if "earlier runs" in line]
    assert len(told) == 1
    assert str(memory_file()) in told[0]
    assert "--keep" in told[0]
    assert memory_file().read_bytes() == before


def test_a_run_that_is_to_repeat_says_nothing_of_what_was_kept(app, capsys):
    remember_ann()
    assert run(app, "--fast") == 0
    assert "earlier runs" not in capsys.readouterr().out


def test_what_earlier_runs_kept_is_taken_up_when_it_is_asked_for(app):
    remember_ann()
    assert run(app, "--fast", "--keep") == 0
    assert "Ann" in recall(memory_file()).imprint.relations


def test_a_run_of_fake_time_goes_on_from_feelings_of_real_time_and_leaves_them_alone(app, caplog):
    remember_ann()
    before = memory_file().read_bytes()
    assert run(app, "--fast", "--keep") == 0
    assert memory_file().read_bytes() == before
    (said,) = [line for line in caplog.messages if str(memory_file()) in line]
    assert "leaves them as they are - run without --fast" in said


def test_runs_of_fake_time_go_on_from_each_other(app):
    assert run(app, "--fast", "--keep") == 0
    first = memory_file().read_bytes()
    assert recall(memory_file()).is_of_fake_time
    assert run(app, "--fast", "--keep") == 0
    assert memory_file().read_bytes() != first


def test_a_run_of_real_time_goes_on_from_feelings_of_fake_time(app):
    assert run(app, "--fast", "--keep") == 0
    assert run(app, "--keep") == 0
    assert not recall(memory_file()).is_of_fake_time
