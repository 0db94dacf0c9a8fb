"""Faces offscreen, for tests: the frames of a sentence, and every expression."""

from itertools import combinations, pairwise

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.face.vocabulary import LABELS
from hri.testing.pictures import SIZE, expressions_of, said, spoken_frames

MOUTH = (slice(132, 200), slice(85, 235))


def test_the_lips_move_while_it_speaks_and_rest_afterwards() -> None:
    frames = list(spoken_frames("Hello there.", rate=25))
    assert len(frames) == round((said("Hello there.").duration + 1) * 25)
    assert {frame.shape for frame in frames} == {(SIZE[1], SIZE[0], 3)}
    moved = [np.abs(a[MOUTH].astype(int) - b[MOUTH]).mean() for a, b in pairwise(frames)]
    assert max(moved[:15]) > 5 * max(moved[-10:])


def test_the_same_sentence_gives_the_same_frames() -> None:
    one, other = (np.stack(list(spoken_frames("Yes.", expression="happy"))) for _ in range(2))
    assert np.array_equal(one, other)
    assert not np.array_equal(one, np.stack(list(spoken_frames("Yes.", expression="sad"))))


def test_an_unknown_expression_is_refused() -> None:
    with pytest.raises(HriError, match='did you mean "happy"'):
        next(spoken_frames("Yes.", expression="hapy"))


def test_all_expressions_differ() -> None:
    pictures = expressions_of("robot")
    assert set(LABELS) <= set(pictures)
    for one, other in combinations(LABELS, 2):
        assert not np.array_equal(pictures[one], pictures[other]), (one, other)
