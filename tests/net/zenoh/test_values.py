"""Values of ports as bytes, and what is not one."""

import math
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, strategies as st

pytest.importorskip("msgspec", reason="the extra zenoh is not installed")

from hri.behavior.ports import ANY, DATATYPES
from hri.core.errors import HriError
from hri.core.signals import (
    EmotionState,
    FaceBox,
    Frame,
    HeadPose,
    People,
    Person,
    Phoneme,
    Pose2D,
    RangeReading,
    Speech,
    Twist,
    Utterance,
)
from hri.net.zenoh.values import LONGEST, read, written

PERSON = Person("p1", HeadPose(1.0, 0.1, -0.2, 0.0, FaceBox(1, 2, 3, 4)), distance=1.5, since=0.0)
VALUES = {
    "double": 1.5,
    "string": "hello",
    "boolean": True,
    "doublearray": (1.0, 2.0, math.inf),
    "emotion": EmotionState("joy", 0.5, 0.1, 0.2, 0.3, {"joy": 0.5}),
    "people": People(2.0, (PERSON,), "p1"),
    "pose": Pose2D(1.0, 2.0, 0.5),
    "twist": Twist(0.1, 0.2),
    "utterance": Utterance("go forward", "move", {"distance": 10.0}),
}


@pytest.mark.parametrize(("datatype", "value"), VALUES.items())
def test_a_value_arrives_as_it_was_sent(datatype, value):
    found = read(datatype, written(datatype, value))
    assert found == value
    assert type(found) is type(value)


def test_a_range_without_an_echo_arrives():
    found = read("range", written("range", RangeReading("left", math.inf, 1.0)))
    assert math.isinf(found.distance)


def test_landmarks_arrive_with_their_shape():
    points = np.arange(9, dtype=np.float32).reshape(3, 3)
    person = Person("p1", PERSON.pose, landmarks=points)
    found = read("people", written("people", People(1.0, (person,)))).persons[0].landmarks
    assert found.dtype == np.float32
    assert np.array_equal(found, points)


def test_speech_arrives_with_its_sound():
    speech = Speech("hi", np.arange(100, dtype=np.int16), 16000, (Phoneme("h", 0.0, 0.1),))
    found = read("speech", written("speech", speech))
    assert np.array_equal(found.samples, speech.samples)
    assert found.phonemes == speech.phonemes


def test_a_picture_arrives_nearly_as_it_was():
    image = np.zeros((60, 80, 3), np.uint8)
    image[:, 40:] = (250, 30, 10)
    found = read("image", written("image", Frame(image, 3.0, 7)))
    assert (found.time, found.sequence, found.image.shape) == (3.0, 7, image.shape)
    assert np.abs(found.image.astype(int) - image).mean() < 4


@pytest.mark.parametrize(
    ("datatype", "value"),
    [("double", "1.5"), ("string", 5), ("emotion", {"label": "joy"}), ("doublearray", ("a",))],
)
def test_another_type_is_refused(datatype, value):
    with pytest.raises(HriError, match=r"not a|cannot"):
        read(datatype, written(datatype, value))


@pytest.mark.parametrize("datatype", ["double", "doublearray"])
def test_nan_does_not_travel(datatype):
    value = math.nan if datatype == "double" else (1.0, math.nan)
    with pytest.raises(HriError):
        read(datatype, written(datatype, value))


@pytest.mark.parametrize("datatype", [ANY, "nonsense"])
def test_only_a_datatype_can_be_read(datatype):
    with pytest.raises(HriError, match="name a datatype"):
        read(datatype, b"\x01")


def test_a_long_value_is_refused():
    with pytest.raises(HriError, match="bytes"):
        written("string", "x" * (LONGEST + 1))
    with pytest.raises(HriError, match="too many"):
        read("string", b"x" * (LONGEST + 1))


@given(st.sampled_from(sorted(DATATYPES.keys() - {ANY, "samples"})), st.binary(max_size=200))
def test_any_bytes_are_a_value_or_refused(datatype, data):
    try:
        value = read(datatype, data)
    except HriError:
        return
    assert isinstance(value, DATATYPES[datatype] if datatype != "double" else float | int)


@given(st.sampled_from(sorted(VALUES)), st.integers(0, 400), st.integers(0, 255), st.booleans())
def test_damaged_bytes_never_crash(datatype, place, byte, is_cut):
    data = bytearray(written(datatype, VALUES[datatype]))
    place %= len(data)
    data[place] = byte
    with suppress(HriError):
        found = read(datatype, bytes(data[:place] if is_cut else data))
        assert isinstance(found, type(VALUES[datatype]) | int)
