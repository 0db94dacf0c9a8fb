"""Eyes, breath and sway of who does nothing: irregular, and never the same again."""

from itertools import pairwise

import numpy as np
import pytest

from hri.core.signals import Gaze
from hri.face.motion import idle
from tests.face.pixels import MODEL

SEEDS = range(5)
SETTINGS = MODEL.settings.idle
DEGREES = MODEL.settings.gaze.degrees
STEP = 0.02


def eyes(seed: int, seconds: float, state: str, step: float = STEP) -> np.ndarray:
    """Where they are turned, degrees to the right and up."""
    looks = [idle.wandering(SETTINGS, seed, t, state) for t in np.arange(0, seconds, step)]
    return np.array([(look.x * DEGREES[0], look.y * DEGREES[1]) for look in looks])


def jumps(path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """When eyes jump, in seconds, and how far, in degrees."""
    moves = np.hypot(*np.diff(path, axis=0).T) > 1e-6
    edges = np.flatnonzero(np.diff(np.concatenate([[0], moves, [0]])))
    begins, ends = edges[::2], edges[1::2]
    return begins * STEP, np.hypot(*(path[ends] - path[begins]).T)


@pytest.mark.parametrize("seed", SEEDS)
def test_small_eye_movements_come_irregularly_and_most_are_tiny(seed: int) -> None:
    # In "error" it does not look away; there all of them are a fifth as large.
    path = eyes(seed, 200, "error") / idle.STATES["error"].saccades
    times, sizes = jumps(path)
    intervals = np.diff(times)
    assert 0.3 < intervals.mean() < 0.6
    assert 0.4 < intervals.std() / intervals.mean() < 0.8
    assert np.abs(np.exp(2j * np.pi * times / 0.8).mean()) < 0.15
    assert 0.5 < np.mean((sizes > 0.1) & (sizes < 0.6)) < 0.9
    assert sizes.max() < 5


@pytest.mark.parametrize("seed", SEEDS)
def test_eyes_return_to_places_where_they_were(seed: int) -> None:
    life = idle.STATES["talking"].glances
    assert life is not None
    now = np.arange(0, 600, 0.1)
    numbers = list(dict.fromkeys(life.rhythm.beat(seed, t).number for t in now))
    places = [idle._again("glance", seed, number) for number in numbers]
    again = np.mean([place in places[max(n - 5, 0) : n] for n, place in enumerate(places)])
    assert 0.1 < again < 0.5


@pytest.mark.parametrize("seed", SEEDS)
def test_some_looks_away_linger(seed: int) -> None:
    step = 0.05
    away = np.hypot(*eyes(seed, 900, "resting", step).T) > 2.5
    edges = np.flatnonzero(np.diff(np.concatenate([[0], away, [0]])))
    lengths = (edges[1::2] - edges[::2]) * step
    assert 0.05 < np.mean(lengths > 1.2) < 0.35
    assert 0.3 < np.median(lengths) < 1.1
    assert lengths.max() < 3.2


@pytest.mark.parametrize("state", ["resting", "talking", "listening", "thinking"])
def test_eyes_never_jump_within_a_moment(state: str) -> None:
    path = eyes(3, 25, state, 1e-3)
    assert np.abs(np.diff(path, axis=0)).max() < 0.05 * min(DEGREES)


def test_any_time_can_be_asked_for_in_any_order() -> None:
    times = [*np.arange(0, 200, 7.3), 1e6, -50.0]
    ahead = [idle.wandering(SETTINGS, 3, t, "talking") for t in times]
    idle._fixation.cache_clear()
    back = [idle.wandering(SETTINGS, 3, t, "talking") for t in reversed(times)]
    assert ahead == back[::-1]
    assert all(isinstance(look, Gaze) for look in ahead)


@pytest.mark.parametrize("seed", SEEDS)
def test_no_two_breaths_are_alike(seed: int) -> None:
    life, step = idle.STATES["resting"], 0.05
    air = np.array([idle.breathing(SETTINGS, seed, t, life) for t in np.arange(0, 600, step)])
    out = np.flatnonzero((air[1:-1] < air[:-2]) & (air[1:-1] <= air[2:])) + 1
    periods = np.diff(out) * step
    depths = np.array([air[a:b].max() for a, b in pairwise(out)])
    assert periods.mean() == pytest.approx(60 / SETTINGS.breaths, rel=0.06)
    assert periods.std() / periods.mean() == pytest.approx(0.16, abs=0.05)
    assert (depths + 1).std() / (depths + 1).mean() == pytest.approx(0.22, abs=0.06)
    assert air[out].max() < -0.95, "all air is out before the next breath"
    assert np.abs(np.diff(air, 2)).max() < 60 * step**2


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sway_never_repeats(seed: int) -> None:
    step, span = 0.2, 100
    moves = [idle.sway(SETTINGS, seed, t, "resting") for t in np.arange(0, 600, step)]
    path = np.array([list(move.values()) for move in moves])
    usual = path.std(axis=0).mean()
    part = path[:span]
    apart = [np.abs(path[n : n + span] - part).mean() for n in range(span, len(path) - span)]
    assert min(apart) > 0.4 * usual
