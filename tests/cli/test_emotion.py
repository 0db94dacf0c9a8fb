import json
import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from hri.cli.emotion.plot import figure_of
from hri.cli.emotion.simulate import play
from hri.cli.emotion.stimulus_timeline import Happening
from hri.cli.main import main
from hri.core.signals import Stimulus
from hri.emotion.model_spec import load_emotions

VISIT = """
# seconds stimulus intensity
10 praise 1
0 person_seen
40 scold 0.5
"""

DAY = """
# What became of a hope.
[[event]]
t = 5
goal = "charger"
utility = 1.0
likelihood_after = 0.9

[[event]]
t = 20
goal = "charger"
utility = 1.0
likelihood_before = 0.9
likelihood_after = 0.0

[[event]]
t = 200
object = "music"
appeal = 0.8

[[event]]
t = 300
action = "spilled"
praiseworthiness = -0.6
"""


@pytest.fixture
def visit(tmp_path: Path) -> Path:
    path = tmp_path / "visit.txt"
    path.write_text(VISIT, encoding="utf-8")
    return path


def test_check_finds_the_shipped_files_fine(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "check"]) == 0
    assert "warning" not in capsys.readouterr().out


def test_check_reports_every_wrong_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    folder = tmp_path / "emotions" / "personalities"
    folder.mkdir(parents=True)
    (folder / "odd.toml").write_text("gain = 1\n", encoding="utf-8")
    (folder / "broken.toml").write_text("[baseline\n", encoding="utf-8")
    assert main(["emotion", "check"]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 2
    assert "broken.toml:1:" in lines[0]
    assert "odd.toml:1:1" in lines[1]


def test_check_tells_what_is_not_as_expected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    path = tmp_path / "emotions" / "stimuli" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(
        '[stimulus.x]\nwords = "x"\nemotions = { joy = 0.5 }\ntrigger = "x.hapened"\n'
        '[[stimulus.x.expect]]\ndominant = "anger"\n',
        encoding="utf-8",
    )
    assert main(["emotion", "check"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(f"{path}:5:1: x, neutral, after 0 s: anger was to be dominant")
    assert lines[1].startswith('warning: x: nothing raises "x.hapened"')
    assert "1 of" in lines[-1]


def test_list_names_what_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "list"]) == 0
    text = capsys.readouterr().out
    assert all(word in text for word in ("optimist", "battery_low", "disgust"))


def test_simulate_prints_a_state_for_each_event_and_time(
    visit: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["emotion", "simulate", "--personality", "optimist", "--events", str(visit)]
    assert main([*words, "--at", "5,120", "--json"]) == 0
    states = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [state["t"] for state in states] == [0, 5, 10, 40, 120]
    assert states[2]["label"] == "joy"
    assert states[2]["why"][0]["cause"] == "praise"
    assert set(states[0]) == {
        "t", "label", "pleasure", "arousal", "dominance", "emotions", "drives", "why",
    }  # fmt: skip
    assert sum(cause["share"] for cause in states[2]["why"]) == pytest.approx(1.0)
    assert states[2]["why"][1]["cause"] == "person_seen"
    assert states[2]["why"][1]["age_s"] == 10
    assert set(states[0]["drives"]) == {"company", "play", "rest", "energy"}
    assert main(words) == 0
    assert "praise 79%, person_seen 21%" in capsys.readouterr().out


def test_printed_shares_add_up_to_a_hundred(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = ("praise", "person_seen", "scold", "bump", "insulted", "cliff_found", "praise")
    lines = [f"{3 * n} {name} 0.{n + 3}" for n, name in enumerate(names)]
    (tmp_path / "visit.txt").write_text("\n".join(lines))
    words = ["--events", str(tmp_path / "visit.txt"), "--at", "60,200,400,900"]
    assert main(["emotion", "simulate", "--personality", "pessimist", *words]) == 0

    told = [re.findall(r"(-?\d+)%", line) for line in capsys.readouterr().out.splitlines()]
    assert len(told[-1]) > 2
    assert {sum(map(int, percents)) for percents in told} == {100}


def test_a_person_who_is_liked_pleases_more(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    joys = {}
    for person in ("Anna", "Bob"):
        path = tmp_path / f"{person}.txt"
        visits = "".join(f"{100 * visit} petted 1 Anna\n" for visit in range(9))
        path.write_text(f"{visits}2000 praise 1 {person}\n", encoding="utf-8")
        assert main(["emotion", "simulate", "--events", str(path), "--json"]) == 0
        last = json.loads(capsys.readouterr().out.splitlines()[-1])
        joys[person] = last["emotions"]["joy"]
    assert joys["Anna"] > joys["Bob"]


def test_goals_deeds_and_things_are_felt(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "day.toml"
    path.write_text(DAY, encoding="utf-8")
    assert main(["emotion", "simulate", "--events", str(path), "--json"]) == 0
    states = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [state["label"] for state in states] == ["hope", "disappointment", "love", "shame"]
    reason = {"cause": "goal.charger", "share": 1.0, "age_s": 0.0, "person": None}
    assert states[1]["why"] == [reason]


def test_goals_may_come_in_a_file_of_any_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "events"
    path.write_text(DAY, encoding="utf-8")
    assert main(["emotion", "simulate", "--events", str(path)]) == 0
    assert "hope" in capsys.readouterr().out


def test_nothing_is_kept_of_a_simulation(
    visit: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    assert main(["emotion", "simulate", "--events", str(visit)]) == 0
    assert not (tmp_path / "state").exists()


def test_a_simulation_can_be_drawn(
    visit: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.png"
    words = ["emotion", "simulate", "--events", str(visit), "--plot"]
    assert main([*words, str(out)]) == 0
    picture = np.asarray(Image.open(out).convert("RGB")).reshape(-1, 3)
    # The lines of pleasure, arousal and dominance are there.
    for color in ((0x2E, 0x8B, 0x57), (0xC4, 0x62, 0x10), (0x6A, 0x5A, 0xCD)):
        assert (picture == color).all(axis=1).sum() > 100
    assert main([*words, str(tmp_path / "missing" / "out.png")]) == 2
    assert "out.png: cannot be written: No such file or directory" in capsys.readouterr().err


def test_the_names_in_a_drawing_can_be_read() -> None:
    dynamics = load_emotions("neutral").dynamics()
    whiles = [0.0, 0.1, 0.2, 1.0, 1.1, 5.0, 20.0, 20.5, 21.0, 60.0] + [90.0] * 20
    timeline = [Happening(time, Stimulus("praise", 1.0)) for time in whiles]
    named = [(time, "praise") for time in whiles]
    figure = figure_of(dynamics, list(play(dynamics, timeline, [])), named)
    figure.draw_without_rendering()
    for axes in figure.axes:
        boxes = [text.get_window_extent() for text in axes.texts]
        assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    assert len(figure.axes[1].texts) > 10


def test_nothing_happening_can_be_simulated_and_drawn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = tmp_path / "nothing.txt", tmp_path / "out.png"
    path.write_text("# nothing\n", encoding="utf-8")
    words = ["emotion", "simulate", "--events", str(path), "--plot", str(out)]
    assert main(words) == 0
    assert capsys.readouterr().out == ""
    assert out.is_file()


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("1 prase 1", 'no stimulus "prase" - did you mean "praise"?'),
        ("soon praise 1", '"soon" is not a time'),
        ("1 praise 2", '"2" is not an intensity'),
        ("1 praise nan", '"nan" is not an intensity'),
        ("praise", "1 words"),
        ("1 praise 1 Anna Bob", "5 words"),
        ("-1 praise 1", '"-1" is not a time'),
        ("1e10 praise 1", '"1e10" is not a time'),
    ],
)
def test_a_wrong_event_is_refused_with_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], line: str, what: str
) -> None:
    path = tmp_path / "wrong.txt"
    path.write_text(f"0 praise 1\n{line}\n", encoding="utf-8")
    assert main(["emotion", "simulate", "--events", str(path)]) == 2
    error = capsys.readouterr().err
    assert f"{path}:2:1: {what}" in error


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        ("[[event]]\nt = 1\n", 1, "an event without a kind - name one of stimulus, goal"),
        ('[[event]]\nt = 1\ngoal = "a"\nobject = "b"\n', 1, "an event with two kinds"),
        ('[[event]]\nt = 1\nstimulus = "prase"\n', 3, 'did you mean "praise"'),
        ('[[event]]\nt = -1\nstimulus = "praise"\n', 2, "from 0 to"),
        ('[[event]]\nt = 1\ngoal = "a"\nutility = 2\n', 4, "from -1 to 1"),
        ('[[event]]\nt = 1\ngoal = "a"\nutility = 1\n', 1, '"likelihood_after" is missing'),
        ('[[event]]\nt = 1\nobject = ""\nappeal = 1\n', 3, "0 letters"),
        ('[[event]]\nt = 1\nobject = "a"\nappeal = nan\n', 4, "from -1 to 1"),
        ('[[event]]\nt = 1\nobject = "a"\nappeal = 1\nappeals = 1\n', 5, 'mean "appeal"'),
        ("[[events]]\nt = 1\n", 1, 'did you mean "event"'),
        ("[event]\nt = 1\n", 1, "array of tables"),
    ],
)
def test_a_wrong_event_in_toml_is_refused_with_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, line: int, what: str
) -> None:
    path = tmp_path / "wrong.toml"
    path.write_text(text, encoding="utf-8")
    assert main(["emotion", "simulate", "--events", str(path)]) == 2
    error = capsys.readouterr().err
    assert f"{path}:{line}:" in error
    assert what in error
