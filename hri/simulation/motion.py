"""How people move their heads: angles as functions of time."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

Angles = tuple[float, float, float]
"""Pitch, yaw, roll as in HeadPose, radians."""

SWAY = (
    ((0.9, 0.11), (0.5, 0.29)),
    ((1.6, 0.07), (0.8, 0.23)),
    ((0.8, 0.09), (0.3, 0.31)),
)
"""Waves of pitch, yaw and roll of a head at rest: degrees and hertz; too slow for a gesture."""


SWING_HZ = 1.8
SWINGS = 2.0
NOD_TIME = SHAKE_TIME = SWINGS / SWING_HZ
"""Seconds that a nod or a shake takes when it is not told otherwise."""
GLANCE_TIME = 2.0
GLANCE_TURN = 0.5
"""Seconds of a glance to the side, and of its way there."""


def nod_angles(
    time: float,
    *,
    amplitude: float = math.radians(9),
    frequency: float = SWING_HZ,
    cycles: float = SWINGS,
) -> Angles:
    """A nod that begins at time 0 with the head going down; radians, hertz, ups and downs."""
    return _swings(time, amplitude, frequency, cycles), 0.0, 0.0


def shake_angles(
    time: float,
    *,
    amplitude: float = math.radians(14),
    frequency: float = SWING_HZ,
    cycles: float = SWINGS,
) -> Angles:
    """A shake of the head that begins at time 0 to the person's left."""
    return 0.0, _swings(time, amplitude, frequency, cycles), 0.0


def glance_angles(time: float) -> Angles:
    """A glance to the person's left and a little down, and back."""
    turned = eased(min(time, GLANCE_TIME - time) / GLANCE_TURN)
    return math.radians(6) * turned, math.radians(26) * turned, 0.0


def eased(part: float) -> float:
    """0 to 1 with a soft start and end; what is beyond stays at the end."""
    part = min(1.0, max(0.0, part))
    return part * part * (3 - 2 * part)


def idle_angles(time: float, seed: int = 0) -> Angles:
    """The small sway of a head at rest at a time; each seed sways in its own way."""
    phases = _phases(seed)
    pitch, yaw, roll = (
        sum(
            math.radians(degrees) * math.sin(2 * math.pi * hertz * time + phase)
            for (degrees, hertz), phase in zip(waves, row, strict=True)
        )
        for waves, row in zip(SWAY, phases, strict=True)
    )
    return pitch, yaw, roll


@lru_cache(maxsize=16)
def _phases(seed: int) -> tuple[tuple[float, ...], ...]:
    drawn = np.random.default_rng(seed).uniform(0, 2 * math.pi, (3, 2))
    return tuple(tuple(float(phase) for phase in row) for row in drawn)


def _swings(time: float, amplitude: float, frequency: float, cycles: float) -> float:
    """A sine that swells and fades within a quarter of a cycle."""
    phase = time * frequency
    return amplitude * eased(4 * min(phase, cycles - phase)) * math.sin(2 * math.pi * phase)
