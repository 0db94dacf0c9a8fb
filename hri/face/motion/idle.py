"""Idle life: blinks, small eye movements, glances, breathing and sway.

All of it is a function of (seed, t) alone: time is cut into slots, and what happens in a slot is
drawn from a hash of seed, kind and number of the slot. No state, and any time can be asked for;
each kind draws for itself, so that one more does not shift the others.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from statistics import NormalDist

from hri.core.signals import Gaze
from hri.face.settings import BlinkSettings, IdleSettings

BLINK_SLOT = 1.2
"""Seconds; at most one blink (or one double blink) begins in each."""
SACCADE_SLOT = 0.8

_SACCADE_TIME = 0.05
"""Seconds a small eye movement takes (25 ms + 2.4 ms a degree: Lee, Badler & Badler 2002)."""
_GLANCE_TIME = 0.07
"""Seconds a look away takes, there or back: the same for 20 degrees."""
_SWAY_HZ = (0.07, 0.13, 0.23)


@dataclass(frozen=True, slots=True)
class Glances:
    """How long the eyes stay on someone and how long away: means and deviations, seconds."""

    stay: tuple[float, float]
    away: tuple[float, float]
    largest: float = 22.7
    """Degrees."""


@dataclass(frozen=True, slots=True)
class Life:
    """How a face lives in a state; shares of what its settings say."""

    blinks: float = 1.0
    glances: Glances | None = None
    saccades: float = 1.0
    sway: float = 1.0
    breaths: float = 1.0
    depth: float = 1.0
    """Of each breath."""


STATES: Mapping[str, Life] = {
    "resting": Life(glances=Glances((4.0, 2.5), (0.8, 0.4))),
    "attending": Life(blinks=0.3, glances=Glances((9.0, 2.0), (0.3, 0.1), 10.0), saccades=0.8),
    "listening": Life(blinks=0.8, glances=Glances((7.9, 1.57), (0.43, 0.23)), sway=0.8),
    "talking": Life(blinks=1.5, glances=Glances((3.13, 3.17), (0.93, 0.8), 27.5), sway=1.3),
    "thinking": Life(blinks=0.7, glances=Glances((1.6, 0.8), (0.9, 0.4)), sway=0.8, breaths=0.9),
    "asleep": Life(blinks=0.0, saccades=0.0, sway=0.35, breaths=0.6, depth=1.8),
    "error": Life(blinks=0.3, saccades=0.2, sway=0.15, breaths=0.5, depth=0.5),
}
"""What a robot does with its eyes and breath. Blinks: 17 a minute at rest, 26 in talk, 4.5 while
reading (Bentivoglio et al. 1997). Glances of listeners and talkers: Lee, Badler & Badler, "Eyes
Alive" (2002), whose frames are 1/30 s."""

_WAYS = (
    (0, 15.5), (45, 6.5), (90, 17.7), (135, 7.4), (180, 16.8), (225, 7.9), (270, 20.4), (315, 7.8),
)  # fmt: skip
"""Directions of looks away, degrees, and how many of a hundred go there (Eyes Alive)."""
_TYPICAL = 11.0
"""Degrees of a look away that is as large as the face's setting says."""


@lru_cache(maxsize=4096)
def chance(seed: int, kind: str, slot: int) -> float:
    """A number from 0 to 1 that looks random, always the same for the same arguments."""
    return zlib.crc32(f"{seed}/{kind}/{slot}".encode()) / 2**32


# --- blinks ---


def lid_closure(blink: BlinkSettings, elapsed: float) -> float:
    """How far the lids are shut, 0 to 1, at a time since the blink began, seconds."""
    if elapsed <= 0:
        return 0.0
    if elapsed < blink.close_s:
        return _smooth(elapsed / blink.close_s)
    elapsed -= blink.close_s + blink.hold_s
    return 1.0 if elapsed < 0 else 1 - _smooth(elapsed / blink.open_s)


def blink_length(blink: BlinkSettings) -> float:
    """Seconds from open to open."""
    return blink.close_s + blink.hold_s + blink.open_s


def blink_starts(blink: BlinkSettings, seed: int, slot: int, rate: float) -> tuple[float, ...]:
    """When blinks begin in a slot: none, one, or two for a double; `rate` is a minute."""
    if chance(seed, "blink", slot) >= rate * BLINK_SLOT / 60:
        return ()
    start = (slot + 0.5 * chance(seed, "blink start", slot)) * BLINK_SLOT
    if chance(seed, "double", slot) < blink.double:
        return start, start + blink_length(blink)
    return (start,)


def blink_closure(blink: BlinkSettings, seed: int, t: float, rate: float | None = None) -> float:
    """How far the lids are shut by the blinks of idle life; `rate` a minute replaces the usual."""
    rate = blink.rate if rate is None else rate
    slot = math.floor(t / BLINK_SLOT)
    closures = (
        lid_closure(blink, t - start)
        for number in (slot - 2, slot - 1, slot)
        for start in blink_starts(blink, seed, number, rate)
    )
    return max(closures, default=0.0)


# --- eyes ---


def wandering(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> Gaze:
    """Where the eyes drift around what they look at: small jumps, and now and then a look away."""
    life = STATES[state]
    slot = math.floor(t / SACCADE_SLOT)
    since = t - (slot + 0.3 * chance(seed, "saccade time", slot)) * SACCADE_SLOT
    share = _smooth(since / _SACCADE_TIME)
    old, new = _fixation(idle, seed, slot - 1), _fixation(idle, seed, slot)
    x, y = _glance(idle, life.glances, seed, t) if life.glances else (0.0, 0.0)
    return Gaze(
        life.saccades * (old[0] + (new[0] - old[0]) * share) + x,
        life.saccades * (old[1] + (new[1] - old[1]) * share) + y,
    )


def _fixation(idle: IdleSettings, seed: int, slot: int) -> tuple[float, float]:
    angle = 2 * math.pi * chance(seed, "saccade angle", slot)
    size = idle.saccade * chance(seed, "saccade size", slot)
    return size * math.cos(angle), 0.6 * size * math.sin(angle)


def _glance(idle: IdleSettings, glances: Glances, seed: int, t: float) -> tuple[float, float]:
    """Each slot is one stay and one look away."""
    length = glances.stay[0] + glances.away[0]
    slot = math.floor(t / length)
    away = _drawn(glances.away, seed, "glance length", slot)
    away = min(max(away, 3 * _GLANCE_TIME), 0.6 * length)
    spread = min(glances.stay[1] / glances.stay[0], 1.0)
    start = slot * length + (length - away) * (0.5 + spread * (chance(seed, "glance", slot) - 0.5))
    share = _smooth((t - start) / _GLANCE_TIME) * _smooth((start + away - t) / _GLANCE_TIME)
    if share == 0.0:
        return 0.0, 0.0
    # Magnitudes of Eyes Alive: most looks away are short ones. Those below 3 degrees are left out,
    # since small movements happen all the time anyway.
    degrees = -6.9 * math.log(max(10 * chance(seed, "glance size", slot), 1e-6) / 15.7)
    size = share * idle.aversion * min(degrees, glances.largest) / _TYPICAL
    angle = math.radians(_way(chance(seed, "glance way", slot)))
    return size * math.cos(angle), size * math.sin(angle)


def _drawn(of: tuple[float, float], seed: int, kind: str, slot: int) -> float:
    """Normally distributed with a mean and a deviation."""
    share = min(max(chance(seed, kind, slot), 1e-6), 1 - 1e-6)
    return NormalDist(*of).inv_cdf(share)


def _way(share: float) -> float:
    """One of the directions, as often as each is taken."""
    share *= sum(weight for _, weight in _WAYS)
    for degrees, weight in _WAYS:
        share -= weight
        if share < 0:
            return degrees
    return 0


# --- the body ---


def sway(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> dict[str, float]:
    """How the head drifts and breathes: weights of its motions."""
    life = STATES[state]
    drift = {
        name: life.sway * idle.sway * share * _waves(seed, name, t)
        for name, share in (("headX", 0.6), ("headY", 0.35), ("headRoll", 0.7))
    }
    breath = breathing(idle, seed, t, life)
    drift["headY"] -= 0.5 * idle.sway * breath
    drift["headSize"] = 0.6 * idle.sway * breath
    return drift


def turning(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> tuple[float, float]:
    """How a head that turns drifts: weights of headYaw and headPitch."""
    size = STATES[state].sway * idle.sway
    return 0.5 * size * _waves(seed, "headYaw", t), 0.35 * size * _waves(seed, "headPitch", t)


def breathing(idle: IdleSettings, seed: int, t: float, life: Life) -> float:
    """-1 (out) to 1 (in), times the depth of a breath."""
    rate = idle.breaths * life.breaths / 60
    return life.depth * math.sin(2 * math.pi * (rate * t + chance(seed, "breath", 0)))


def _waves(seed: int, name: str, t: float) -> float:
    """A few slow waves that never repeat together."""
    return sum(
        math.sin(2 * math.pi * (hertz * t + chance(seed, name, number))) / (1 + number)
        for number, hertz in enumerate(_SWAY_HZ)
    )


def _smooth(x: float) -> float:
    """0 below 0, 1 above 1, and a smooth step between."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)
