"""The frames of a sentence: in time with its sound, with the lips moving."""

from itertools import islice, pairwise

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.core.signals import Phoneme, Speech
from hri.face import Frame, speaking_frames
from hri.testing.pictures import spoken_frames

SAID = Speech("ma", np.zeros(8000, np.int16), 16000, (Phoneme("m", 0, 0.2), Phoneme("A", 0.2, 0.3)))


def test_the_frames_of_a_speech_are_in_time() -> None:
    frames = list(speaking_frames(SAID, size=(64, 48), rate=20))
    assert [frame.time for frame in frames] == pytest.approx([n / 20 for n in range(30)])
    assert {frame.picture.shape for frame in frames} == {(48, 64, 3)}
    moved = [
        np.abs(one.picture.astype(int) - other.picture).max() for one, other in pairwise(frames)
    ]
    assert max(moved[:10]) > 20


def test_a_text_is_spoken_as_for_tests() -> None:
    frames = list(islice(speaking_frames("Yes.", "person", "happy", size=(64, 48)), 4))
    assert isinstance(frames[0], Frame)
    tested = list(islice(spoken_frames("Yes.", "person", "happy", size=(64, 48)), 4))
    assert all(
        np.array_equal(frame.picture, one) for frame, one in zip(frames, tested, strict=True)
    )


def test_what_is_unknown_is_refused() -> None:
    with pytest.raises(HriError, match='did you mean "happy"'):
        next(speaking_frames(SAID, expression="hapy"))
    with pytest.raises(HriError, match="give sides from"):
        next(speaking_frames(SAID, size=(4, 4)))
