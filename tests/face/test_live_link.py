"""Weights as CSV with the columns of Live Link Face, there and back."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.signals import Expression, Gaze
from hri.face.animator import Animator
from hri.face.live_link import TARGETS, WeightWriter, read_weights, timecode
from hri.face.vocabulary import ARKIT
from tests.face.pixels import MODEL
from tests.face.test_motion import TICK, animate

HEADER = "Timecode,BlendShapeCount,JawOpen,MouthSmileLeft"


def recorded(file: Path, seconds: float = 2.0) -> list[np.ndarray]:
    """The weights of a surprised face, written to a file."""
    animator = Animator(MODEL, 3)
    animator.express(Expression("surprised"))
    animator.gesture("tilt")
    animator.look(Gaze(point=(1.0, 0.5, -0.2)))
    writer = WeightWriter(file, MODEL)
    path = list(animate(animator, seconds))
    for number, vector in enumerate(path):
        writer.write(50.0 + number * TICK, vector)
    writer.close()
    return path


def test_the_columns_are_those_of_live_link_then_our_own(tmp_path: Path) -> None:
    recorded(tmp_path / "face.csv", 0.2)
    header, first, *_ = (tmp_path / "face.csv").read_text().splitlines()
    columns = header.split(",")
    assert columns[:4] == ["Timecode", "BlendShapeCount", "EyeBlinkLeft", "EyeLookDownLeft"]
    assert columns[53:57] == ["TongueOut", "HeadYaw", "HeadPitch", "HeadRoll"]
    assert {name[0].lower() + name[1:] for name in TARGETS} == set(ARKIT)
    assert columns[63:]
    assert set(columns[63:]) < set(MODEL.channels)
    assert first.startswith("00:00:00:00.000,61,")


def test_what_was_recorded_is_played_again(tmp_path: Path) -> None:
    path = recorded(tmp_path / "face.csv")
    track = read_weights(tmp_path / "face.csv", MODEL)
    assert track.duration == pytest.approx((len(path) - 1) * TICK, abs=1e-4)
    for number in (0, 17, len(path) - 1):
        values, _ = track.at(number * TICK)
        assert values == pytest.approx(path[number], abs=2e-3)
    animator = Animator(MODEL, 99)
    animator.express(Expression("sad"))
    animator.play(track)
    *_, last = animate(animator, 1.0)
    assert last == pytest.approx(path[29], abs=0.05), "in place of all else"


@given(st.floats(0, 86_399))
def test_a_timecode_has_sixty_frames_a_second(seconds: float) -> None:
    hours, minutes, whole, frames = timecode(seconds).split(":")
    again = int(hours) * 3600 + int(minutes) * 60 + int(whole) + float(frames) / 60
    assert again == pytest.approx(seconds, abs=1e-4)
    assert float(frames) < 60


def test_a_recording_of_the_app_is_read(tmp_path: Path) -> None:
    """Past midnight, with a frame twice, columns we have no use for, and angles in radians."""
    file = tmp_path / "phone.csv"
    file.write_text(
        "\ufeffTimecode,BlendShapeCount,JawOpen,CheekPuff,HeadRoll,LeftEyeYaw\r\n"
        "23:59:59:59.512,61,0.1,0.5,0.1,0.2\r\n"
        "23:59:59:59.512,61,0.9,0.5,0.1,0.2\r\n"
        "00:00:00:29.512,61,0.4,0.5,0.1,0.2\r\n\r\n",
        encoding="utf-8",
    )
    track = read_weights(file, MODEL)
    assert track.duration == pytest.approx(0.5)
    end, _ = track.at(0.5)
    weights = MODEL.weights(end)
    assert weights["jawOpen"] == pytest.approx(0.4)
    assert weights["headRoll"] == pytest.approx(np.degrees(0.1) / MODEL.settings.motion.roll)


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "1:1: no column Timecode"),
        ("a,b\n", "1:1: no column Timecode"),
        ("Timecode,BlendShapeCount,Trunk\n", "1:1: no column for the face astronaut"),
        ("Timecode,JawOpen,JawOpen\n", "1:1: the column JawOpen is there twice"),
        (HEADER + "\n", "0 rows of weights - record two at least"),
        (HEADER + "\n0:0:0:0,61,0\n", "2:1: 3 cells in a row - write 4"),
        (HEADER + "\nnoon,61,0,0\n", '2:1: "noon" is not a timecode'),
        (HEADER + "\n0:0:1:0,61,0,0\n0:0:0:0,61,0,0\n", "3:1: the time goes back"),
        (HEADER + "\n0:0:0:0,61,nan,0\n", "2:1: JawOpen is nan - write a number from -10 to 10"),
        (HEADER + "\n0:0:0:0,61,0,1e9\n", "2:1: MouthSmileLeft is 1e9"),
        (HEADER + "\n0:0:0:0,61,0,0\n2:0:0:0,61,0,0\n", "3:1: longer than 3600 s"),
        (",".join(["Timecode", *map(str, range(900))]) + "\n", "901 columns - keep to 400"),
        (HEADER + "\n" + "9" * 200_000 + ",61,0,0\n", "a line that is too long"),
        ("\x00\x01\xff", "not a text file"),
    ],
)
def test_a_file_that_cannot_be_played_says_where_and_why(
    text: str, error: str, tmp_path: Path
) -> None:
    file = tmp_path / "bad.csv"
    file.write_text(text, encoding="latin-1")
    with pytest.raises(HriError, match=error):
        read_weights(file, MODEL)


def test_a_file_that_is_not_there_or_cannot_be_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(HriError, match="cannot read"):
        read_weights(tmp_path / "nothing.csv", MODEL)
    with pytest.raises(HriError, match="cannot be written"):
        WeightWriter(tmp_path / "no folder" / "face.csv", MODEL)
