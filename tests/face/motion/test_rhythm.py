"""Beats are irregular, whatever the time that is asked for, and no grid lies below them."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.face.motion.rhythm import CHAPTER, Rhythm

RHYTHM = Rhythm("test", mean=0.5, spread=0.6, least=0.1)
TIMES = st.floats(-1e4, 1e6)


@given(st.integers(0, 5), TIMES)
def test_beats_follow_each_other_at_least_their_least_interval_apart(seed: int, t: float) -> None:
    beats = [RHYTHM.beat(seed, t, later) for later in range(-300, 300)]
    passed = np.array([beat.since for beat in beats])
    assert passed[300] >= 0 > passed[301]
    assert (np.diff(passed) < -RHYTHM.least + 1e-9).all()
    assert len({beat.number for beat in beats}) == len(beats)


@given(st.integers(0, 5), TIMES, st.floats(0, 5))
def test_the_past_is_the_same_seen_from_later(seed: int, t: float, more: float) -> None:
    seen = {beat.number: beat.since for beat in RHYTHM.past(seed, t, 3.0)}
    later = {beat.number: beat.since for beat in RHYTHM.past(seed, t + more, 3.0 + more + 1e-6)}
    assert seen.keys() <= later.keys()
    for number, since in seen.items():
        assert later[number] == pytest.approx(since + more, abs=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_intervals_have_their_mean_and_spread_and_no_grid(seed: int) -> None:
    span = 10 * CHAPTER * RHYTHM.mean
    times = np.array([span - beat.since for beat in RHYTHM.past(seed, span, span)])[::-1]
    intervals = np.diff(times)
    assert intervals.mean() == pytest.approx(RHYTHM.mean, rel=0.06)
    assert intervals.std() / intervals.mean() == pytest.approx(RHYTHM.spread, abs=0.08)
    for grid in (0.3, 0.5, 0.8, 1.2, CHAPTER * RHYTHM.mean):
        # On a grid all turn to one side.
        turned = np.abs(np.exp(2j * np.pi * times / grid).mean())
        assert turned < 0.12, grid


def test_even_a_time_without_end_has_a_last_beat() -> None:
    assert RHYTHM.beat(1, 1e300).since >= 0
    assert RHYTHM.beat(1, -1e300, 2).number is not None
