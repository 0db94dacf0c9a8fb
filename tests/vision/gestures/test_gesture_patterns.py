import math
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import HeadPose
from hri.vision.gestures.gesture_file import chosen
from hri.vision.gestures.gesture_patterns import ANSWERS, load_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

ROW = "swings = 3\nwidth_deg = 4\nswing_s = 0.5\n"
SCORED = ROW + "score = { bias = 1, width = 0, duration = -4, rest = 0, dominance = 0 }\n"


def written(folder: Path, rows: str = ROW, head: str = 'axis = "roll"\n') -> Path:
    path = folder / "gestures.toml"
    path.write_text(f"[sway]\n{head}[[sway.row]]\n{rows}")
    return path


def test_the_files_of_the_project_are_fine() -> None:
    patterns = load_patterns()
    assert [pattern.event for pattern in chosen(patterns, ANSWERS)] == [
        "head.nodded",
        "head.shaken",
    ]
    for pattern in patterns.values():
        assert pattern.about
        assert all(row.words(pattern.axis) for row in pattern.rows)


def test_without_a_question_only_three_swings_are_an_answer() -> None:
    for pattern in chosen(load_patterns(), ANSWERS):
        assert all(row.swings >= 3 for row in pattern.rows if False in row.prompted)
        assert min(row.swings for row in pattern.rows if True in row.prompted) == 2


def test_a_gesture_may_be_added_as_data(tmp_path: Path) -> None:
    pattern = load_patterns(written(tmp_path))["sway"]
    assert pattern.event == "head.sway"
    recognizer = GestureRecognizer([pattern])
    poses = [HeadPose(i / 30, 0, 0, 0.2 * math.sin(i / 3)) for i in range(60)]
    found = [gesture for pose in poses if (gesture := recognizer.update(pose))]
    assert [gesture.kind for gesture in found] == ["sway"]


@pytest.mark.parametrize(
    ("rows", "head", "place", "words"),
    [
        (ROW.replace("3", "2.5"), 'axis = "roll"\n', 4, "write a whole number"),
        (ROW.replace("3", "1"), 'axis = "roll"\n', 3, "add hold_s"),
        (ROW.replace("width_deg", "widht_deg"), 'axis = "roll"\n', 3, "width_deg"),
        (ROW + "widht = 3\n", 'axis = "roll"\n', 7, "width_deg"),
        (ROW, 'axis = "pich"\n', 2, "pitch"),
        (ROW, 'axis = "yaw"\nevent = "nodded"\n', 3, "head."),
        (ROW + 'first = "up"\n', 'axis = "yaw"\n', 7, "left"),
        (ROW + "dominance = { roll = 2 }\n", 'axis = "roll"\n', 7, "cannot be compared"),
        (ROW + 'when = "askd"\n', 'axis = "roll"\n', 7, "asked"),
        (ROW + "score = { bias = 1 }\n", 'axis = "yaw"\n', 7, "width"),
        (SCORED.replace("rest", "rset"), 'axis = "yaw"\n', 7, "rest"),
        (SCORED.replace("3", "1") + "hold_s = 1\n", 'axis = "yaw"\n', 7, "more swings"),
        (ROW + "rest = 1.5\n", 'axis = "roll"\n', 7, "from 0 to 1"),
    ],
)
def test_a_mistake_is_told_with_its_place(
    tmp_path: Path, rows: str, head: str, place: int, words: str
) -> None:
    with pytest.raises(AuthoringError, match=words) as caught:
        load_patterns(written(tmp_path, rows, head))
    assert abs(caught.value.place.line - place) <= 1


def test_a_file_without_gestures_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "gestures.toml"
    path.write_text("")
    with pytest.raises(AuthoringError, match="0 head gestures"):
        load_patterns(path)
    path.write_text('[nod]\naxis = "pitch"\n')
    with pytest.raises(AuthoringError, match="0 rows"):
        load_patterns(path)


def test_a_misspelt_gesture_gets_a_hint() -> None:
    with pytest.raises(HriError, match='did you mean "shake"'):
        chosen(load_patterns(), ["shaek"])


@given(st.binary(max_size=60) | st.text(max_size=60).map(str.encode))
@settings(max_examples=50, deadline=None)
def test_no_file_breaks_the_loader(
    tmp_path_factory: pytest.TempPathFactory, content: bytes
) -> None:
    path = tmp_path_factory.mktemp("patterns") / "gestures.toml"
    path.write_bytes(content)
    with pytest.raises(HriError):
        load_patterns(path)
