"""Idle life: blinks, small eye movements, breathing and sway.

All of it is a function of (seed, t) alone: time is cut into slots, and what happens in a slot is
drawn from a hash of seed, kind and number of the slot. No state, and any time can be asked for.
"""

from __future__ import annotations

import math
import zlib

from hri.core.signals import Gaze
from hri.face.settings import BlinkSettings, IdleSettings

BLINK_SLOT = 1.6
"""Seconds; at most one blink (or one double blink) begins in each."""
SACCADE_SLOT = 0.8
GLANCE_SLOT = 3.0
"""Seconds; at most one look away begins in each."""

_SACCADE_TIME = 0.05
"""Seconds a small eye movement takes (25 ms + 2.4 ms a degree: Lee, Badler & Badler 2002)."""
_SWAY_HZ = (0.07, 0.13, 0.23)
GLANCES = {False: 0.25, True: 0.5}
"""Share of slots with a look away: while listening or idle, and while talking."""


def chance(seed: int, kind: str, slot: int) -> float:
    """A number from 0 to 1 that looks random, always the same for the same arguments."""
    return zlib.crc32(f"{seed}/{kind}/{slot}".encode()) / 2**32


def lid_closure(blink: BlinkSettings, elapsed: float) -> float:
    """How far the lids are shut, 0 to 1, so many seconds after a blink began."""
    if elapsed <= 0:
        return 0.0
    if elapsed < blink.close_s:
        return _smooth(elapsed / blink.close_s)
    elapsed -= blink.close_s + blink.hold_s
    return 1.0 if elapsed < 0 else 1 - _smooth(elapsed / blink.open_s)


def blink_closure(blink: BlinkSettings, seed: int, t: float, rate: float | None = None) -> float:
    """How far the lids are shut by the blinks of idle life; `rate` a minute replaces the usual."""
    share = (blink.rate if rate is None else rate) * BLINK_SLOT / 60
    length = blink.close_s + blink.hold_s + blink.open_s
    slot = math.floor(t / BLINK_SLOT)
    closure = 0.0
    for number in (slot - 1, slot):
        if chance(seed, "blink", number) >= share:
            continue
        start = (number + 0.5 * chance(seed, "blink start", number)) * BLINK_SLOT
        closure = max(closure, lid_closure(blink, t - start))
        if chance(seed, "double", number) < blink.double:
            closure = max(closure, lid_closure(blink, t - start - length))
    return closure


def wandering(idle: IdleSettings, seed: int, t: float, is_talking: bool = False) -> Gaze:
    """Where the eyes drift around what they look at: small jumps, and now and then a look away."""
    slot = math.floor(t / SACCADE_SLOT)
    since = t - (slot + 0.3 * chance(seed, "saccade time", slot)) * SACCADE_SLOT
    share = _smooth(since / _SACCADE_TIME)
    old, new = _fixation(idle, seed, slot - 1), _fixation(idle, seed, slot)
    away = _glance(idle, seed, t, is_talking)
    return Gaze(
        old[0] + (new[0] - old[0]) * share + away[0],
        old[1] + (new[1] - old[1]) * share + away[1],
    )


def _fixation(idle: IdleSettings, seed: int, slot: int) -> tuple[float, float]:
    angle = 2 * math.pi * chance(seed, "saccade angle", slot)
    size = idle.saccade * chance(seed, "saccade size", slot)
    return size * math.cos(angle), 0.6 * size * math.sin(angle)


def _glance(idle: IdleSettings, seed: int, t: float, is_talking: bool) -> tuple[float, float]:
    """People look to the side or up while they think of words, seldom down."""
    slot = math.floor(t / GLANCE_SLOT)
    if chance(seed, "glance", slot) >= GLANCES[is_talking]:
        return 0.0, 0.0
    start = (slot + 0.4 * chance(seed, "glance start", slot)) * GLANCE_SLOT
    length = 0.4 + 0.8 * chance(seed, "glance length", slot)
    share = _smooth((t - start) / 0.09) * _smooth((start + length - t) / 0.09)
    side = 1 if chance(seed, "glance side", slot) < 0.5 else -1
    size = idle.aversion * (0.5 + 0.5 * chance(seed, "glance size", slot))
    height = 0.9 * chance(seed, "glance height", slot) - 0.2
    return side * size * share, height * size * share


def sway(idle: IdleSettings, seed: int, t: float) -> dict[str, float]:
    """How the head drifts and breathes: weights of its motions."""
    drift = {}
    for name, share in (("headX", 0.6), ("headY", 0.35), ("headRoll", 0.7)):
        waves = (
            math.sin(2 * math.pi * (hertz * t + chance(seed, name, number))) / (1 + number)
            for number, hertz in enumerate(_SWAY_HZ)
        )
        drift[name] = idle.sway * share * sum(waves)
    breath = math.sin(2 * math.pi * (idle.breaths / 60 * t + chance(seed, "breath", 0)))
    drift["headY"] -= 0.5 * idle.sway * breath
    drift["headSize"] = 0.6 * idle.sway * breath
    return drift


def _smooth(x: float) -> float:
    """0 below 0, 1 above 1, and a smooth step between."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)
