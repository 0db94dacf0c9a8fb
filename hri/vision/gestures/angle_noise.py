"""How noisy the angles of a head are, measured while they arrive, and how to steady them."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

Angles = tuple[float, float, float]
"""Pitch, yaw and roll, radians."""

WINDOW = 148
"""Second differences from which the noise is measured: the latest."""
QUIET_PART = 0.25
"""Below the measure lies this part of them: those from moments when the head hardly moved."""
SCALE = 0.319 * math.sqrt(6)
"""Leads from that quartile to a standard deviation: 0.319 is the one of |x| of a normal x, and
second differences of white noise have 6 times its variance."""
ASSUMED = math.radians(0.4)
"""Standard deviation before there is anything to measure it from."""
ASSUMED_WEIGHT = 8
"""Second differences that the assumption counts for."""
STEADY = math.radians(0.35)
"""Standard deviation that is left alone."""
LONGEST = 0.08
"""Seconds; steadying over more would flatten a quick nod."""


class Noise:
    """The noise of three angles.

    Second differences remove any steady movement, so that what is left of them while the head
    hardly moves is noise.
    """

    def __init__(self) -> None:
        self._angles: deque[Angles] = deque(maxlen=3)
        self._bends = np.zeros((3, WINDOW))
        """Second differences of each angle, without their sign; the newest replaces the oldest."""
        self._count = 0

    def add(self, angles: Angles) -> None:
        """Take the next pitch, yaw and roll."""
        self._angles.append(angles)
        if len(self._angles) == 3:
            series = zip(*self._angles, strict=True)
            bends = [abs((now - last) - (last - first)) for first, last, now in series]
            self._bends[:, self._count % WINDOW] = bends
            self._count += 1

    def deviations(self) -> Angles:
        """Standard deviations of pitch, yaw and roll, radians."""
        count = min(self._count, WINDOW)
        if count == 0:
            return ASSUMED, ASSUMED, ASSUMED
        # As numpy.percentile has it, in a tenth of the time.
        place = QUIET_PART * (count - 1)
        low, high = math.floor(place), math.ceil(place)
        ordered = np.partition(self._bends[:, :count], (low, high), axis=1)
        measured = ordered[:, low] + (ordered[:, high] - ordered[:, low]) * (place - low)
        pitch, yaw, roll = (
            (count * deviation / SCALE + ASSUMED_WEIGHT * ASSUMED) / (count + ASSUMED_WEIGHT)
            for deviation in measured.tolist()
        )
        return pitch, yaw, roll


class Steadying:
    """Smooths noisy angles, the more the noisier; quiet ones stay as they are.

    A low-pass of first order with time constant T leaves of white noise, sampled every dt, the
    part sqrt(dt / (2 T + dt)) of its deviation. T is chosen so that `STEADY` is left.
    """

    def __init__(self) -> None:
        self._time = -math.inf
        self._angles: Angles = (0.0, 0.0, 0.0)

    def update(self, time: float, angles: Angles, deviations: Angles) -> tuple[Angles, Angles]:
        """The steadied angles, and the deviations that are left in them."""
        step = time - self._time
        self._time = time
        if not math.isfinite(step):
            self._angles = angles
            return angles, deviations
        # One time constant for all, else one angle would lag behind the other.
        noisiest = max(deviations[:2])
        wanted = step / 2 * ((noisiest / STEADY) ** 2 - 1)
        constant = min(LONGEST, max(0.0, wanted))
        blend = 1 - math.exp(-step / constant) if constant > 0 else 1.0
        pitch, yaw, roll = (
            before + blend * (now - before)
            for before, now in zip(self._angles, angles, strict=True)
        )
        self._angles = pitch, yaw, roll
        left = math.sqrt(step / (2 * constant + step))
        return self._angles, (deviations[0] * left, deviations[1] * left, deviations[2] * left)
