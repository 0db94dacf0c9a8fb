"""Chance looks random at any distance, and repeats."""

import numpy as np
import pytest

from hri.face.motion.chance import chance, drift, log_normal, normal
from tests.face.motion.kolmogorov import p_value

SEEDS = range(5)
COUNT = 4000


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", ["blink", "saccade"])
def test_what_is_drawn_does_not_depend_on_what_was_drawn_before(seed: int, kind: str) -> None:
    drawn = np.array([chance(seed, kind, number) for number in range(COUNT)])
    centered = drawn - drawn.mean()
    related = [np.mean(centered[lag:] * centered[:-lag]) / centered.var() for lag in range(1, 201)]
    # Of 200 such numbers the largest is below 4.5 deviations but once in a thousand times.
    assert np.abs(related).max() < 4.5 / np.sqrt(COUNT)
    assert np.abs(related).mean() < 1 / np.sqrt(COUNT)


@pytest.mark.parametrize("seed", SEEDS)
def test_chance_is_even_and_within_its_limits(seed: int) -> None:
    drawn = [chance(seed, "any", number) for number in range(COUNT)]
    assert 0 < min(drawn) < max(drawn) < 1
    assert p_value(drawn, lambda share: share) > 0.05


def test_kinds_and_seeds_do_not_depend_on_each_other() -> None:
    rows = [
        [chance(seed, kind, number) for number in range(COUNT)]
        for seed, kind in ((1, "blink"), (2, "blink"), (1, "double"), (12, "blink"))
    ]
    related = np.corrcoef(rows) - np.eye(len(rows))
    assert np.abs(related).max() < 4 / np.sqrt(COUNT)


def test_normal_and_log_normal_numbers_have_their_mean_and_deviation() -> None:
    even = np.array([normal(1, "n", number) for number in range(COUNT)])
    skewed = np.array([log_normal(1, "l", number, 0.8) for number in range(COUNT)])
    assert even.mean() == pytest.approx(0, abs=0.05)
    assert even.std() == pytest.approx(1, abs=0.05)
    assert skewed.mean() == pytest.approx(1, abs=0.05)
    assert skewed.std() == pytest.approx(0.8, abs=0.1)


def test_a_drift_never_repeats_and_neither_it_nor_its_speed_jumps() -> None:
    dt = 0.01
    path = np.array([drift(3, "head", t) for t in np.arange(-20, 180, dt)])
    assert np.abs(path).max() < 1.9
    assert path.std() == pytest.approx(0.7, abs=0.1)
    assert np.abs(np.diff(path, 2)).max() < 12 * dt**2
    part = path[:2000]
    windows = np.lib.stride_tricks.sliding_window_view(path[4000:], len(part))[::10]
    assert np.abs(windows - part).mean(axis=1).min() > 0.2
