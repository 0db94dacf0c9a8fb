"""`hri gesture`: what it tells of films and of series of poses, and how it refuses bad ones."""

import json
import math
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.signals import Hand, HandGesture
from hri.simulation.people.body_motion import Posture, nod_angles
from hri.simulation.people.scripted_film import Film, Role
from hri.vision.expressions.expression_recognizer import FacialExpression, PeopleExpressions
from hri.vision.hands.hand_gestures import PeopleHands
from hri.vision.pose_file import Remarks, read_poses

HEADER = "t_s,pitch_deg,yaw_deg,roll_deg"


def rows(axis: int, degrees: float = 9.0, rate: float = 30.0, cycles: float = 2.0) -> list[str]:
    """Two seconds of a head that swings after the first."""
    lines = [HEADER]
    for number in range(round(2.2 * rate)):
        time = number / rate
        phase = (time - 0.6) * 1.8
        angles = [0.0, 0.0, 0.0]
        angles[axis] = degrees * math.sin(2 * math.pi * phase) if 0 < phase < cycles else 0.0
        lines.append(",".join(f"{value:.3f}" for value in (time, *angles)))
    return lines


def file(folder: Path, name: str, lines: list[str]) -> Path:
    path = folder / name
    path.write_text("\n".join(lines) + "\n")
    return path


def told(capsys, *words) -> list[dict]:
    assert main(["gesture", *map(str, words), "--json"]) == 0
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def test_one_option_takes_many_series_of_poses(tmp_path, capsys):
    nod, shake = file(tmp_path, "a.csv", rows(0)), file(tmp_path, "b.csv", rows(1, 14))
    still = file(tmp_path, "c.csv", rows(0, 0.0))
    found = told(capsys, "--pose", nod, shake, still)
    assert [(row["file"], row["gesture"]) for row in found] == [
        (str(nod), "nod"),
        (str(shake), "shake"),
    ]
    for row in found:
        assert list(row) == ["file", "t", "gesture", "person", "confidence", "latency_s"]
        assert 0.6 < row["t"] < 1.8
        assert 0 < row["latency_s"] < 0.9
        assert 0 <= row["confidence"] <= 1


def test_the_option_may_be_repeated(tmp_path, capsys):
    paths = [file(tmp_path, name, rows(0)) for name in ("a.csv", "b.csv")]
    assert len(told(capsys, "--pose", paths[0], "--pose", paths[1])) == 2


def test_a_single_nod_counts_only_as_an_answer(tmp_path, capsys):
    path = file(tmp_path, "a.csv", rows(0, cycles=0.6))
    assert told(capsys, "--pose", path) == []
    assert [row["gesture"] for row in told(capsys, "--pose", path, "--prompted")] == ["nod"]


@pytest.mark.parametrize("rate", [10, 25, 100])
def test_any_rate_will_do(tmp_path, capsys, rate):
    path = file(tmp_path, "a.csv", rows(0, rate=rate))
    assert [row["gesture"] for row in told(capsys, "--pose", path, "--prompted")] == ["nod"]


def test_other_gestures_are_told_only_with_patterns(tmp_path, capsys):
    path = file(tmp_path, "a.csv", rows(2, 14, cycles=3))
    own = file(tmp_path, "own.toml", [
        "[sway]", 'axis = "roll"', "[[sway.row]]", "swings = 2", "width_deg = 8", "swing_s = 0.6",
    ])  # fmt: skip
    assert told(capsys, "--pose", path) == []
    found = told(capsys, "--pose", path, "--patterns", "--prompted")
    assert [row["gesture"] for row in found] == ["wobble"]
    assert told(capsys, "--pose", path, "--patterns", own)[0]["gesture"] == "sway"


def test_columns_may_stand_in_any_order_beside_others(tmp_path, capsys):
    lines = [HEADER + ",note", *(f"{line},x" for line in rows(0)[1:])]
    turned = [",".join(reversed(line.split(","))) for line in lines]
    path = file(tmp_path, "a.csv", ["\ufeff" + turned[0], *turned[1:]])
    assert [row["gesture"] for row in told(capsys, "--pose", path)] == ["nod"]


@pytest.mark.parametrize(
    ("lines", "complaint"),
    [
        ([], 'bad.csv:1:1: no column "t_s"'),
        ([HEADER], "no poses"),
        (["t_s,pitch_deg,roll_deg", "0,0,0"], 'no column "yaw_deg"'),
        ([HEADER, "0,0,0,0", "0.1,up,0,0"], 'bad.csv:3:1: pitch_deg is "up" - write a number'),
        ([HEADER, "0,nan,0,0"], "no poses"),
        ([HEADER, '0,"1', '2",0,0'], r'bad.csv:3:1: pitch_deg is "1\n2" - write a number'),
        ([HEADER, "x" * 200_000], "a line that is too long"),
    ],
)
def test_a_bad_file_is_one_line_and_the_others_are_told(tmp_path, capsys, lines, complaint):
    bad, good = file(tmp_path, "bad.csv", lines), file(tmp_path, "good.csv", rows(0))
    assert main(["gesture", "--pose", str(bad), str(good), str(tmp_path / "no.csv"), "--json"]) == 2
    output = capsys.readouterr()
    assert [json.loads(line)["file"] for line in output.out.splitlines()] == [str(good)]
    assert complaint in output.err
    assert "no.csv: cannot read this file of poses" in output.err
    assert "Traceback" not in output.err


def test_what_is_odd_is_told_and_the_rest_is_recognized(tmp_path, capsys):
    lines = rows(0)
    lines[3:3] = ["0.07,nan,0,0", "0.08,,0,0"]
    path = file(tmp_path, "a.csv", [*lines, *rows(1, 14)[1:]])
    assert main(["gesture", "--pose", str(path), "--json"]) == 0
    output = capsys.readouterr()
    assert [json.loads(line)["gesture"] for line in output.out.splitlines()] == ["nod", "shake"]
    assert "a.csv:4: a row without numbers - passed over (2 times)" in output.err
    assert "time goes back" in output.err
    stopped = file(tmp_path, "c.csv", [HEADER, *("0,0,0,0" for _ in range(9))])
    assert main(["gesture", "--pose", str(stopped)]) == 0
    assert "c.csv:3: time stands still - the row is passed over (8 t" in capsys.readouterr().err
    slow = file(tmp_path, "b.csv", rows(0, rate=4.0))
    assert main(["gesture", "--pose", str(slow)]) == 0
    assert "4 poses a second" in capsys.readouterr().err


def test_a_binary_file_is_refused(tmp_path, capsys):
    (tmp_path / "a.csv").write_bytes(b"\xff\xfe\x00\x01" * 50)
    assert main(["gesture", "--pose", str(tmp_path / "a.csv")]) == 2
    assert "not a text file" in capsys.readouterr().err


@given(st.text(alphabet="0123456789.,-einfa\n\"' \x00", max_size=80))
@settings(max_examples=60, deadline=None)
def test_no_text_breaks_the_reader(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("poses") / "a.csv"
    path.write_text(f"{HEADER}\n{text}", newline="")
    remarks = Remarks(path)
    try:
        poses = list(read_poses(path, remarks))
    except HriError:
        return
    assert poses
    assert all(math.isfinite(pose.time) and math.isfinite(pose.pitch) for pose in poses)
    assert all(str(path) in remark for remark in remarks)


def nodding(time: float) -> Posture:
    return Posture(*nod_angles(time - 1.2, amplitude=math.radians(10), cycles=2.5))


@pytest.fixture(scope="module")
def film(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("film") / "nod.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 15.0, (320, 240))
    for frame in Film([Role(nodding)], 3.0, 15.0).frames():
        writer.write(np.ascontiguousarray(frame.image[:, :, ::-1]))
    writer.release()
    return path


def test_a_nod_in_a_film_is_told_and_drawn(film, tmp_path, capsys):
    target = tmp_path / "seen.mp4"
    (row,) = told(capsys, "--video", film, "--overlay", target, "--prompted")
    assert list(row) == ["t", "gesture", "person", "confidence", "latency_s"]
    assert (row["gesture"], row["person"]) == ("nod", "p1")
    assert 1.2 < row["t"] < 2.8
    seen = cv2.VideoCapture(str(target))
    assert seen.get(cv2.CAP_PROP_FRAME_COUNT) >= 85


def test_a_line_is_written_for_people_too(film, capsys):
    assert main(["gesture", "--video", str(film), "--seconds", "2.5", "--prompted"]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert "p1  nod" in line


@pytest.mark.parametrize("part", [0.0, 0.01])
def test_a_film_of_nothing_or_cut_short_is_refused(film, tmp_path, capsys, part):
    content = film.read_bytes()
    path = tmp_path / "cut.avi"
    path.write_bytes(content[: round(part * len(content))])
    assert main(["gesture", "--video", str(path)]) == 2
    assert "cut.avi: not a readable video" in capsys.readouterr().err


def test_a_film_that_breaks_off_is_told_up_to_there(film, tmp_path, capsys):
    content = film.read_bytes()
    path = tmp_path / "cut.avi"
    path.write_bytes(content[: round(0.9 * len(content))])
    assert main(["gesture", "--video", str(path), "--prompted", "--json"]) == 0
    output = capsys.readouterr()
    assert [json.loads(line)["gesture"] for line in output.out.splitlines()] == ["nod"]
    assert "breaks off after" in output.err


def test_the_patterns_are_checked_and_listed(tmp_path, capsys):
    assert main(["gesture", "--check"]) == 0
    assert "5 gestures, fine" in capsys.readouterr().out
    assert main(["gesture", "--list"]) == 0
    assert "asked: 2 swings of pitch" in capsys.readouterr().out
    bad = file(tmp_path, "bad.toml", ["[nod]", 'axis = "pich"'])
    assert main(["gesture", "--check", "--patterns", str(bad)]) == 2
    assert 'bad.toml:2:1: axis is "pich" - did you mean "pitch"?' in capsys.readouterr().err


def test_the_patterns_of_hands_are_checked_and_listed(tmp_path, capsys):
    assert main(["gesture", "--check", "--hands"]) == 0
    assert "hands.toml: 6 gestures, fine" in capsys.readouterr().out
    assert main(["gesture", "--list", "--hands"]) == 0
    listed = capsys.readouterr().out
    assert "hand.opened" in listed
    assert "open, palm, 0 to 40 deg from up: still for 0.5 s" in listed
    assert "open, 0 to 65 deg from up: 3 swings of 0.4 palms within 0.8 s each" in listed
    bad = file(tmp_path, "bad.toml", ["[hi]", 'event = "hand.hi"', 'shape = "opn"', "hold_s = 1"])
    assert main(["gesture", "--check", "--hands", "--patterns", str(bad)]) == 2
    assert 'bad.toml:3:1: shape is "opn" - did you mean "open"?' in capsys.readouterr().err


def test_the_patterns_of_expressions_are_checked_and_listed(tmp_path, capsys):
    assert main(["gesture", "--check", "--expressions"]) == 0
    assert "expressions.toml: 5 expressions, fine" in capsys.readouterr().out
    assert main(["gesture", "--list", "--expressions"]) == 0
    assert "blink from 0.5 until 0.3, over within 0.5 s" in capsys.readouterr().out
    bad = file(tmp_path, "bad.toml", ["[grin]", 'measure = "smle"'])
    assert main(["gesture", "--check", "--expressions", "--patterns", str(bad)]) == 2
    assert 'bad.toml:2:1: measure is "smle" - did you mean "smile"?' in capsys.readouterr().err


def test_an_expression_is_told_when_it_shows_and_when_it_is_over(monkeypatch, tmp_path, capsys):
    told = [
        FacialExpression("smile", 0.2, "p1", 1.5, is_over=True),
        FacialExpression("smile", 0.0, "p1", 0.3),
    ]
    monkeypatch.setattr(PeopleExpressions, "update", lambda *_: [told.pop()] if told else [])
    for number in range(2):
        cv2.imwrite(str(tmp_path / f"{number}.png"), np.full((120, 160, 3), 90, np.uint8))
    assert main(["gesture", "--images", str(tmp_path), "--expressions", "--json"]) == 0
    shown, over = map(json.loads, capsys.readouterr().out.splitlines())
    assert shown == {
        "t": 0.0, "expression": "smile", "person": "p1", "is_over": False, "seconds": 0.3
    }  # fmt: skip
    assert (over["is_over"], over["seconds"]) == (True, 1.5)


def test_a_gesture_of_a_hand_is_told_with_whose_it_is(monkeypatch, tmp_path, capsys):
    hand = Hand("left", 0.0, np.zeros((21, 3), np.float32), "open")
    told = [HandGesture("stop", 0.5, hand, "p1", 0.6)]
    monkeypatch.setattr(PeopleHands, "update", lambda self, people: [told.pop()] if told else [])
    for number in range(2):
        cv2.imwrite(str(tmp_path / f"{number}.png"), np.full((120, 160, 3), 90, np.uint8))
    assert main(["gesture", "--images", str(tmp_path), "--hands", "--json"]) == 0
    (row,) = map(json.loads, capsys.readouterr().out.splitlines())
    assert list(row) == ["t", "gesture", "person", "hand", "latency_s"]
    assert (row["gesture"], row["person"], row["hand"]) == ("stop", "p1", "left")


def test_poses_and_pictures_do_not_go_together(tmp_path, capsys):
    path = file(tmp_path, "a.csv", rows(0))
    assert main(["gesture", "--pose", str(path), "--video", "film.mp4"]) == 2
    assert "--pose takes no pictures" in capsys.readouterr().err
