"""The recognizer on recordings of real heads, which are not part of the project."""

from collections import Counter

import numpy as np
import pytest

from benchmarks.vision import cross_validation, recordings
from hri.core.errors import NotAvailable
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

PATTERNS = answer_patterns()
DRAWS = 2
"""Of the noise."""


@pytest.fixture(scope="module")
def heads() -> list[recordings.Recording]:
    try:
        return recordings.read_recordings()
    except NotAvailable as why:
        pytest.skip(str(why))


def confusion(heads: list[recordings.Recording], prompted: bool, rate: float = 30) -> Counter:
    """How many of each kind were first taken for each kind."""
    counts: Counter[tuple[str, str]] = Counter()
    for number, head in enumerate(heads):
        for seed in range(DRAWS):
            recognizer = GestureRecognizer(PATTERNS)
            poses = head.poses(rate, 1.0, 100 * seed + number)
            found = (recognizer.update(pose, prompted) for pose in poses)
            first = next((gesture.kind for gesture in found if gesture is not None), "other")
            counts[head.kind, first] += 1
    return counts


def f1(counts: Counter, kind: str) -> float:
    told = sum(count for (_, first), count in counts.items() if first == kind)
    done = sum(count for (made, _), count in counts.items() if made == kind)
    return 2 * counts[kind, kind] / (told + done)


def accuracy(counts: Counter) -> float:
    return sum(counts[kind, kind] for kind in recordings.KINDS) / counts.total()


def test_answers_of_real_people(heads: list[recordings.Recording]) -> None:
    counts = confusion(heads, prompted=True)
    assert accuracy(counts) >= 0.92
    assert f1(counts, "nod") >= 0.92
    assert f1(counts, "shake") >= 0.91, "three of the shakes are nods by a wrong label"
    assert counts["nod", "shake"] == 0, "a nod taken for a shake is the worst error"


def test_few_poses_a_second_cost_little(heads: list[recordings.Recording]) -> None:
    assert accuracy(confusion(heads, prompted=True, rate=10)) >= 0.88


def test_real_people_whom_nobody_asked(heads: list[recordings.Recording]) -> None:
    counts = confusion(heads, prompted=False)
    assert accuracy(counts) >= 0.84
    assert counts["other", "other"] >= 49 * DRAWS


@pytest.mark.slow
def test_recordings_that_no_limit_was_chosen_on(heads: list[recordings.Recording]) -> None:
    told = cross_validation.tell(heads, PATTERNS)
    counts = cross_validation.confusion(told, np.ones(len(heads), bool))
    assert np.trace(counts) / counts.sum() >= 0.915
    plain = np.array([not cross_validation.is_contradicted(head) for head in heads])
    counts = cross_validation.confusion(told, plain)
    assert np.trace(counts) / counts.sum() >= 0.93
    assert counts[1, 0] / counts[1].sum() <= 0.03
    assert counts[0, 1] == 0
