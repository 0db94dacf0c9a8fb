"""Nods and shakes in a series of head poses: swings that follow each other and come back.

A swing leads from one turning point of an angle to the next. A gesture is a run of swings, each
quick and wide enough, of much the same width, of which each pair comes back to where it began,
while the other axis moves less. The swing under way counts, so a gesture is seen while it lasts.
Three swings are always taken for a gesture; two (a single nod) only while an answer is expected,
and within stricter limits: they look just like a glance.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hri.core.signals import HeadGesture, HeadPose


@dataclass(frozen=True, slots=True)
class Limits:
    """What a run of swings on one axis must satisfy to be a gesture."""

    kind: str
    """"nod" or "shake"."""
    axis: int
    """0 pitch, 1 yaw."""
    swings: int
    """How many in a row."""
    width: float
    """Radians, least of each swing."""
    duration: float
    """Seconds, most of each swing."""
    dominance: float
    """Least ratio of the movement on this axis to that on the other."""
    rest: float
    """Most that a pair of swings may miss its beginning by, as a part of its wider swing."""


NOD, SHAKE = "nod", "shake"
TURN = (math.radians(2.5), math.radians(4.0))
"""How far pitch and yaw must come back from an extreme to make it a turning point."""
ALWAYS = (
    Limits(NOD, 0, 3, math.radians(4.0), 0.55, 1.0, 0.75),
    Limits(SHAKE, 1, 3, math.radians(6.0), 0.55, 1.2, 0.75),
)
"""A talker's head beats time with up to 4 degrees: less is no nod that nobody waits for."""
PROMPTED = (
    Limits(NOD, 0, 3, TURN[0], 0.55, 1.0, 0.75),
    Limits(SHAKE, 1, 3, TURN[1], 0.55, 1.2, 0.75),
    Limits(NOD, 0, 2, math.radians(3.5), 0.6, 1.8, 0.5),
    Limits(SHAKE, 1, 2, math.radians(7.0), 0.4, 2.0, 0.4),
)
"""While an answer is expected."""

WIDTH_RATIO = 5.0
"""Most that the widest swing of a gesture exceeds the narrowest."""
NOISE_GAIN = 4.0
"""A swing is at least this many standard deviations of the noise wide."""
NOISE_WINDOW = 150
"""Poses from which the noise is measured."""
MAX_GAP = 0.3
"""Seconds; after a longer silence nothing that was seen before counts."""
QUIET = 0.7
"""Seconds without a swing that end a gesture, so that one long nod is reported once."""
HISTORY = 2.5
"""Seconds of poses that are kept."""


@dataclass(frozen=True, slots=True)
class Swing:
    """A movement from one turning point to the next, or up to now."""

    start: float
    """Seconds."""
    end: float
    width: float
    """Radians, with its sign."""


class ZigZag:
    """The turning points of one angle: a turn counts once the angle has come back by `least`."""

    _SLACK = 0.2
    """Part of `least`: so near to an extreme the head still rests there."""
    _KEPT = 4

    def __init__(self) -> None:
        self.last_turn = -math.inf
        self._turns: deque[tuple[float, float]] = deque(maxlen=self._KEPT)
        self._direction = 0
        self._low, self._high = (0.0, math.inf), (0.0, -math.inf)

    def update(self, time: float, value: float, least: float) -> None:
        """Take the next angle, in radians."""
        slack = self._SLACK * least
        if value >= self._high[1] - slack:
            self._high = (time, max(value, self._high[1]))
        if value <= self._low[1] + slack:
            self._low = (time, min(value, self._low[1]))
        if self._direction <= 0 and value - self._low[1] >= least:
            self._turn(self._low, 1, time)
            self._high = (time, value)
        elif self._direction >= 0 and self._high[1] - value >= least:
            self._turn(self._high, -1, time)
            self._low = (time, value)

    def _turn(self, extreme: tuple[float, float], direction: int, time: float) -> None:
        self._turns.append(extreme)
        self._direction, self.last_turn = direction, time

    def swings(self, count: int) -> list[Swing]:
        """The last swings, the one under way included; fewer when there were not so many."""
        if not self._direction:
            return []
        running = self._high if self._direction > 0 else self._low
        points = [*self._turns, running][-count - 1 :]
        return [Swing(start, end, last - first) for (start, first), (end, last) in pairwise(points)]


class Noise:
    """The noise of the angles, measured while they arrive.

    Second differences remove any steady movement; their 25th percentile comes from moments
    when the head hardly moved (0.319 and the root of 6 lead from it to a standard deviation).
    """

    _PERCENTILE = 25
    _SCALE = 0.319 * math.sqrt(6)

    def __init__(self) -> None:
        self._angles: deque[tuple[float, float]] = deque(maxlen=NOISE_WINDOW)

    def add(self, angles: tuple[float, float]) -> None:
        """Take the next pitch and yaw."""
        self._angles.append(angles)

    def deviations(self) -> tuple[float, float]:
        """Standard deviations of pitch and yaw, radians; 0 before the first three poses."""
        if len(self._angles) < 3:
            return 0.0, 0.0
        bends = np.abs(np.diff(np.array(self._angles), 2, axis=0))
        pitch, yaw = np.percentile(bends, self._PERCENTILE, axis=0) / self._SCALE
        return float(pitch), float(yaw)


class Movement:
    """What a head has done since it began to be watched."""

    def __init__(self, noise: Noise) -> None:
        self.noise = noise
        self._angles: deque[tuple[float, float, float]] = deque()
        self._zigzags = ZigZag(), ZigZag()
        self._least = list(TURN)

    def add(self, time: float, angles: tuple[float, float]) -> None:
        """Take the next pitch and yaw."""
        self._angles.append((time, *angles))
        while time - self._angles[0][0] > HISTORY:
            self._angles.popleft()
        self.noise.add(angles)
        self._least = [
            max(turn, NOISE_GAIN * deviation)
            for turn, deviation in zip(TURN, self.noise.deviations(), strict=True)
        ]
        for zigzag, angle, least in zip(self._zigzags, angles, self._least, strict=True):
            zigzag.update(time, angle, least)

    @property
    def last_turn(self) -> float:
        """Seconds; when either angle turned."""
        return max(zigzag.last_turn for zigzag in self._zigzags)

    def gesture(self, time: float, table: Sequence[Limits]) -> HeadGesture | None:
        """The gesture of the first row that the latest swings satisfy."""
        for limits in table:
            swings = self._zigzags[limits.axis].swings(limits.swings)
            least = max(limits.width, self._least[limits.axis])
            if len(swings) < limits.swings or time - swings[-1].start > limits.duration:
                continue
            dominance = self._dominance(swings[0].start, limits.axis)
            if dominance >= limits.dominance and fits(swings, limits, least):
                return HeadGesture(limits.kind, time, confidence(swings, least))
        return None

    def _dominance(self, start: float, axis: int) -> float:
        """How much more this axis has moved than the other since the start."""
        moved = np.ptp([angles for time, *angles in self._angles if time >= start], axis=0)
        return float(moved[axis] / max(moved[1 - axis], 1e-9))


class GestureRecognizer:
    """Takes the poses of one head, one by one, at 10 a second or more.

    A pose with NaN, or of the same time as the one before, is passed over. After a gap, or when
    time goes back, it starts anew.
    """

    def __init__(self) -> None:
        self._movement = Movement(Noise())
        self._time = -math.inf
        self._is_in_gesture = False

    def update(self, pose: HeadPose, prompted: bool = False) -> HeadGesture | None:
        """The gesture that this pose completes, if any. `prompted`: an answer is expected."""
        time, angles = pose.time, (pose.pitch, pose.yaw)
        if not all(map(math.isfinite, (time, *angles))) or time == self._time:
            return None
        if not 0 < time - self._time <= MAX_GAP:
            self._movement, self._is_in_gesture = Movement(Noise()), False
        self._time = time
        self._movement.add(time, angles)
        if self._is_in_gesture:
            self._end_gesture(time)
            return None
        gesture = self._movement.gesture(time, PROMPTED if prompted else ALWAYS)
        self._is_in_gesture = gesture is not None
        return gesture

    def _end_gesture(self, time: float) -> None:
        """Once the head rests, what it did before counts no more."""
        if time - self._movement.last_turn > QUIET:
            self._movement, self._is_in_gesture = Movement(self._movement.noise), False


def fits(swings: Sequence[Swing], limits: Limits, least: float) -> bool:
    """Whether swings are wide, quick, even, and come back."""
    widths = [abs(swing.width) for swing in swings]
    return (
        min(widths) >= least
        and max(widths) <= WIDTH_RATIO * min(widths)
        and all(swing.end - swing.start <= limits.duration for swing in swings)
        and all(
            abs(out.width + back.width) <= limits.rest * max(abs(out.width), abs(back.width))
            for out, back in pairwise(swings)
        )
    )


def confidence(swings: Sequence[Swing], least: float) -> float:
    """0.5 for two swings that just suffice, rising to 1 with their width and number."""
    return 1 - least / sum(abs(swing.width) for swing in swings)
