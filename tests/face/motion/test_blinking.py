"""Blinks come as irregularly as those of people, and no two are alike."""

import math
from dataclasses import replace
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest

from hri.core.signals import Expression
from hri.face import load_face
from hri.face.animator import Animator
from hri.face.motion.blinking import (
    CAUSES,
    LATEST,
    LEAST,
    RHYTHM,
    Blink,
    Blinks,
    begun,
    blink_closure,
)
from tests.face.motion.kolmogorov import p_value
from tests.face.pixels import MODEL
from tests.face.small_face import write_face

SEEDS = range(5)
BLINK = MODEL.settings.blink
ALIKE = replace(BLINK, double=0.0, half=0.0, uneven=0.0)
TICK = 1 / 30
RATE = 17.0
HOUR = 3600.0


def share_below(interval: float) -> float:
    """Of the intervals between blinks, in units of their mean."""
    variance = math.log1p(RHYTHM.spread**2)
    return NormalDist(-variance / 2, math.sqrt(variance)).cdf(math.log(interval))


def starts(seed: int, seconds: float) -> list[float]:
    """When eyes begin to shut that have nothing to do."""
    blinks, step = Blinks(ALIKE, seed), 0.05
    shut = [max(blinks.closure(n * step, RATE)) > 0 for n in range(round(seconds / step))]
    return [n * step for n in range(1, len(shut)) if shut[n] and not shut[n - 1]]


def of_an_hour(seed: int) -> list[list[Blink]]:
    """The single and double blinks of an hour."""
    beats = RHYTHM.past(seed, HOUR * RATE / 60, HOUR * RATE / 60)
    return [list(begun(BLINK, seed, beat.number, 0.0)) for beat in beats]


@pytest.mark.parametrize("seed", SEEDS)
def test_intervals_of_ten_minutes_are_log_normal(seed: int) -> None:
    intervals = np.diff(starts(seed, 600)) * RATE / 60
    assert len(intervals) > 120
    assert p_value(intervals, share_below) > 0.05


def drawn_intervals(seed: int, seconds: float) -> np.ndarray:
    """Between blinks that Blinks would show in this time, in units of their mean."""
    span = seconds * RATE / 60
    return np.diff([-beat.since for beat in RHYTHM.past(seed, span, span)][::-1])


@pytest.mark.parametrize("seed", SEEDS)
def test_intervals_of_an_hour_are_log_normal(seed: int) -> None:
    intervals = drawn_intervals(seed, HOUR)
    assert intervals.std() / intervals.mean() == pytest.approx(RHYTHM.spread, abs=0.1)
    assert p_value(intervals, share_below) > 0.05


def test_no_more_seeds_than_by_chance_stray_from_the_log_normal() -> None:
    fits = [p_value(drawn_intervals(seed, 600), share_below) for seed in range(100)]
    assert np.mean(np.array(fits) < 0.05) <= 0.1
    assert p_value(fits, lambda share: share) > 0.05


@pytest.mark.parametrize("seed", SEEDS)
def test_blinks_neither_repeat_nor_lie_on_a_grid(seed: int) -> None:
    times = np.array(starts(seed, 1200))
    shut = np.zeros(1200)
    shut[times.astype(int)] = 1
    again = np.corrcoef(shut[120:], shut[:-120])[0, 1]
    assert abs(again) < 4 / math.sqrt(len(shut))
    assert np.abs(np.exp(2j * np.pi * times / 1.2).mean()) < 0.2


@pytest.mark.parametrize("seed", SEEDS)
def test_some_blinks_are_double_half_or_uneven(seed: int) -> None:
    pairs = of_an_hour(seed)
    blinks = [blink for pair in pairs for blink in pair]
    assert 0.09 < np.mean([len(pair) == 2 for pair in pairs]) < 0.15
    assert 0.05 < np.mean([max(blink.depths) < 0.9 for blink in blinks]) < 0.1
    assert 0.09 < np.mean([min(b.depths) < 0.95 * max(b.depths) for b in blinks]) < 0.15
    lengths = [blink.close_s + blink.hold_s + blink.open_s for blink in blinks]
    assert np.std(lengths) / np.mean(lengths) == pytest.approx(0.15, abs=0.03)
    assert np.mean([blink.depths[0] < blink.depths[1] for blink in blinks]) == pytest.approx(
        0.5, abs=0.06
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_both_eyes_blink_nearly_at_once(seed: int) -> None:
    for pair in of_an_hour(seed)[:200]:
        for blink in pair:
            assert min(blink.delays) == 0.0
            assert max(blink.delays) <= min(LATEST, blink.hold_s)
            assert LEAST * max(blink.depths) <= min(blink.depths) <= max(blink.depths) <= 1.0
            assert max(blink.depths) >= 0.4
            shut = blink.closures(blink.start + blink.close_s + max(blink.delays))
            assert shut == pytest.approx(blink.depths)
            assert blink.closures(blink.end) == (0.0, 0.0)


def test_an_author_sets_the_shares_and_may_leave_them_out(tmp_path: Path) -> None:
    folder = write_face(tmp_path / "mine")
    usual = load_face(folder).settings.blink
    assert (usual.double, usual.half, usual.uneven) == (0.12, 0.08, 0.12)
    toml = folder / "face.toml"
    shares = "[blink]\nhalf_share = 1.0\nuneven_share = 0.0\n"
    toml.write_text(toml.read_text().replace("[blink]\n", shares))
    blink = load_face(folder).settings.blink
    depths = [next(begun(blink, 1, number, 0.0)).depths for number in range(50)]
    assert np.max(depths) < 0.81
    assert np.abs(np.diff(depths)).max() < 0.05


def test_lids_stay_within_their_range_and_never_jump() -> None:
    blinks, dt = Blinks(BLINK, seed=4), 2e-3
    path = np.array([blinks.closure(n * dt, 40.0) for n in range(30_000)])
    assert path.min() >= 0.0
    assert path.max() <= 1.0
    assert np.abs(np.diff(path, axis=0)).max() < 2.3 * dt / BLINK.close_s
    assert np.abs(path[:, 0] - path[:, 1]).max() > 0.05
    assert np.abs(path[:, 0] - path[:, 1]).max() < 1 - LEAST + LATEST * 2.3 / BLINK.close_s


def test_any_rate_of_frames_shows_the_same_blinks() -> None:
    """The rate changes, and something happens, in between."""

    def path(parts: int) -> np.ndarray:
        blinks, seen = Blinks(BLINK, seed=2), []
        for tick in range(1200):
            if tick % 97 == 50:
                blinks.cause("speech ended", tick * TICK)
            for part in range(parts):
                now = (tick + (part + 1) / parts) * TICK
                closures = blinks.closure(now, 10.0 + tick // 300 * 8)
            seen.append(closures)
        return np.array(seen)

    assert path(1).max() > 0.9
    assert path(1) == pytest.approx(path(7), abs=1e-6)


def test_blinks_without_events_are_those_of_a_still_picture() -> None:
    blinks = Blinks(BLINK, seed=6)
    for t in np.arange(0, 60, TICK):
        shown, still = blinks.closure(t, RATE), blink_closure(BLINK, 6, t, RATE)
        assert shown == pytest.approx(still, abs=1e-9)


def test_a_rate_that_changes_moves_the_next_blinks_smoothly() -> None:
    """Twice the rate brings twice the blinks, and never a flurry of those that were missed."""
    blinks, counts, step = Blinks(ALIKE, seed=1), [], 0.05
    now, shut = 0.0, False
    for rate in (10.0, 20.0, 0.0, 20.0):
        count = 0
        for _ in range(round(300 / step)):
            now += step
            was, shut = shut, max(blinks.closure(now, rate)) > 0
            count += shut and not was
        counts.append(count)
    slow, fast, never, again = counts
    assert slow == pytest.approx(50, abs=15)
    assert fast == pytest.approx(100, abs=20)
    assert never <= 1
    assert again == pytest.approx(100, abs=20)


@pytest.mark.parametrize("why", sorted(CAUSES))
def test_blinks_come_with_events_as_often_as_people_do(why: str) -> None:
    """Most of them soon after the event, by the same events always the same."""

    def seen(seed: int) -> int:
        blinks, count = Blinks(BLINK, seed), 0
        for number in range(50):
            blinks.cause(why, number * 5.0)
            closures = [max(blinks.closure(number * 5.0 + t, 0.0)) for t in np.arange(0, 0.7, 0.05)]
            count += max(closures) > 0.3
        return count

    assert seen(1) == seen(1)
    share = sum(seen(seed) for seed in range(4)) / 200
    assert share == pytest.approx(CAUSES[why], abs=0.12)


def test_who_is_tired_blinks_slowly() -> None:
    def length(tired: float) -> float:
        blinks = [blink for n in range(200) for blink in begun(BLINK, 1, n, 0.0, tired)][:200]
        return float(np.median([b.close_s + b.hold_s + b.open_s for b in blinks]))

    assert length(0.0) == pytest.approx(BLINK.close_s + BLINK.hold_s + BLINK.open_s, rel=0.05)
    assert length(1.0) > 1.8 * length(0.0)
    assert length(0.0) < length(0.5) < length(1.0)


def test_a_tired_look_slows_the_blinks_of_a_face() -> None:
    lids = MODEL.channels.index("eyeBlinkLeft")

    def usual_length(look: Expression | None, arousal: float) -> float:
        animator = Animator(MODEL, seed=1)
        animator.feel(arousal)
        animator.express(look)
        path = np.array([animator.vector(n * TICK, TICK)[lids] for n in range(1200)])[120:]
        moves = path > np.median(path) + 0.1
        edges = np.flatnonzero(np.diff(np.concatenate([[0], moves, [0]])))
        return float(np.median(edges[1::2] - edges[::2]))

    awake = usual_length(None, 0.0)
    assert usual_length(Expression("tired"), 0.0) > 1.5 * awake
    assert usual_length(None, -0.9) > 1.5 * awake


def test_both_eyes_of_a_face_differ_a_little() -> None:
    left, right = (MODEL.channels.index("eyeBlink" + side) for side in ("Left", "Right"))
    animator = Animator(MODEL, seed=1)
    path = np.array([animator.vector(n * TICK, TICK) for n in range(1800)])
    apart = np.abs(path[:, left] - path[:, right])
    assert 0.05 < apart.max() < 0.7
    assert path[:, [left, right]].min() > -1e-6
    assert path[:, [left, right]].max() < 1 + 1e-6
