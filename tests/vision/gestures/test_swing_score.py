import math

import pytest
from hypothesis import given, strategies as st

from hri.vision.gestures.swing_score import STRONGEST, SwingScore, features

wide = st.floats(0.01, 3.0)


def test_the_features_of_a_pair_of_swings() -> None:
    width, duration, rest, dominance = features(
        [math.radians(16), math.radians(-8)], [0.3, 0.2], [(0.5, 0.05), (0.5, 0.05)]
    )
    assert (width, duration) == pytest.approx((0.0, 0.3))
    assert rest == pytest.approx(0.5)
    assert 1.5 < dominance < math.log(10), "what noise covers counts little"


@given(wide, wide, wide, wide)
def test_the_longer_one_counts_and_mirrored_swings_score_alike(
    out: float, back: float, along: float, across: float
) -> None:
    covers = [(along, across)] * 2
    there = features([out, -back], [0.4, 0.2], covers)
    assert there == features([-out, back], [0.2, 0.4], covers)
    assert all(map(math.isfinite, there))
    assert abs(there[3]) <= STRONGEST


def test_slow_pairs_score_less() -> None:
    score = SwingScore(1.0, (0.0, -4.0, 0.0, 0.0))
    quick, slow = (features([0.3, -0.3], [seconds] * 2, [(0.3, 0.1)] * 2) for seconds in (0.2, 0.4))
    assert score(quick) > 0 > score(slow)
