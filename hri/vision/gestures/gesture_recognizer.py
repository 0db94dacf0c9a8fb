"""Gestures in a series of head poses: swings that follow each other and come back.

A swing leads from one turning point of an angle to the next. A gesture is a run of swings, each
quick and wide enough, of much the same width, of which each pair comes back to where it began,
while the other angles move less. The swing under way counts, so a gesture is seen while it lasts.
Three swings are always taken for a nod or a shake; two (a single nod) only while an answer is
expected, and within stricter limits: they look just like a glance. The limits are rows of
`config/gestures.toml`, for other gestures, too.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise

from hri.core.signals import HeadGesture, HeadPose
from hri.vision.gestures.angle_noise import Angles, Noise, Steadying
from hri.vision.gestures.gesture_patterns import AXES, Pattern, PatternRow
from hri.vision.gestures.oscillation import Swing, ZigZag, resting, slowing
from hri.vision.gestures.swing_score import Features, features

TURN: Angles = (math.radians(2.5), math.radians(4.0), math.radians(3.0))
"""How far pitch, yaw and roll must come back from an extreme to make it a turning point."""
NOISE_GAIN = 4.0
"""A swing is at least this many standard deviations of the noise wide."""
MAX_GAP = 0.3
"""Seconds; after a longer silence nothing that was seen before counts."""
QUIET = 0.7
"""Seconds without a turn that end a gesture, so that one long nod is reported once."""
HISTORY = 3.0
"""Seconds of poses that are kept."""
CROSSING = (AXES.index("yaw"), AXES.index("pitch"), AXES.index("yaw"))
"""The angle that the score of a row compares with, by axis."""
LARGEST = 100.0
"""Radians; larger values are not angles."""
STILL = 0.2
"""Seconds without a movement after which no gesture goes on; a slow nod stays so long at a turn."""
LEAP, LEAP_S = 0.75, 0.075
"""Part of a swing that no head makes between two poses, and seconds up to which they are that near:
where it does, one picture was switched for another. The quickest nods make 0.6 at 15 a second."""
MOST_POSES = 600
"""Poses that are kept, whatever their rate."""


class GestureRecognizer:
    """Takes the poses of one head, one by one, at 10 to 100 a second.

    A gesture is reported once, however long it lasts, or again every `again` seconds while it goes
    on and no answer is expected. A nod that turns into a shake is reported as both. A pose with
    NaN, or of the same time as the one before, is ignored. After a gap, or when time goes back, it
    starts again.
    """

    def __init__(self, patterns: Iterable[Pattern], again: float = math.inf) -> None:
        self._patterns = tuple(patterns)
        self._again = again
        self._movement = Movement(Noise())
        self._time = -math.inf
        self._axes = {pattern.gesture: pattern.axis for pattern in self._patterns}
        self._axis: int | None = None
        """Of the current gesture; None when there is none."""
        self._told = -math.inf
        """Seconds, when it was reported."""

    def update(self, pose: HeadPose, prompted: bool = False) -> HeadGesture | None:
        """The gesture that this pose completes, if any. `prompted`: an answer is expected."""
        time, angles = pose.time, (pose.pitch, pose.yaw, pose.roll)
        if not _is_sound(time, angles) or time == self._time:
            return None
        if not 0 < time - self._time <= MAX_GAP:
            self._movement, self._axis = Movement(Noise()), None
        self._time = time
        self._movement.add(time, angles)
        if self._axis is not None and time - self._movement.last_turn > QUIET:
            # The head rests: what it did before counts no more.
            self._movement, self._axis = Movement(self._movement.noise), None
            return None
        since = partial(self._counted_from, prompted)
        gesture = self._movement.gesture(self._patterns, prompted, since)
        if gesture is None or self._goes_on(gesture):
            return None
        self._axis, self._told = self._axes[gesture.kind], time
        return gesture

    def _counted_from(self, prompted: bool, axis: int) -> float:
        """Seconds from which on swings of an angle count: reported swings do not count again. An
        answer is given once; it needs so few swings that steps of a walk would be reported often.
        """
        if axis != self._axis:
            return -math.inf
        return math.inf if prompted or math.isinf(self._again) else self._told

    def _goes_on(self, gesture: HeadGesture) -> bool:
        """Whether a gesture is still the one that was reported a short time ago."""
        is_same = self._axes[gesture.kind] == self._axis
        onset = gesture.time - gesture.latency
        return is_same and onset <= self._told and gesture.time - self._told < self._again


class Movement:
    """What a head has done since it began to be watched."""

    def __init__(self, noise: Noise) -> None:
        self.noise = noise
        self._steadying = Steadying()
        self._times: deque[float] = deque(maxlen=MOST_POSES)
        self._angles: deque[Angles] = deque(maxlen=MOST_POSES)
        self._seen: deque[Angles] = deque(maxlen=MOST_POSES)
        """The angles before they were steadied."""
        self._zigzags = ZigZag(), ZigZag(), ZigZag()
        self._least = TURN
        self._last: Angles = (0.0, 0.0, 0.0)

    def add(self, time: float, angles: Angles) -> None:
        """Take the next pitch, yaw and roll; half a turn either way is the same place."""
        pitch, yaw, roll = map(unwrapped, angles, self._last)
        self._last = angles = pitch, yaw, roll
        self.noise.add(angles)
        steady, left = self._steadying.update(time, angles, self.noise.deviations())
        self._times.append(time)
        self._angles.append(steady)
        self._seen.append(angles)
        while time - self._times[0] > HISTORY:
            self._times.popleft()
            self._angles.popleft()
            self._seen.popleft()
        pitch, yaw, roll = (
            max(turn, NOISE_GAIN * deviation) for turn, deviation in zip(TURN, left, strict=True)
        )
        self._least = pitch, yaw, roll
        for zigzag, angle, least in zip(self._zigzags, steady, self._least, strict=True):
            zigzag.update(time, angle, least)

    @property
    def last_turn(self) -> float:
        """Seconds; when any angle turned."""
        return max(zigzag.last_turn for zigzag in self._zigzags)

    def swings(self, axis: int) -> list[Swing]:
        """The latest swings of an angle, the one under way last."""
        return self._zigzags[axis].swings()

    def gesture(
        self,
        patterns: Iterable[Pattern],
        prompted: bool,
        counted_from: Callable[[int], float] = lambda axis: -math.inf,
    ) -> HeadGesture | None:
        """The gesture of the first row that the latest swings satisfy.

        `counted_from` gives the time, seconds, from which on the swings of an angle count.
        """
        for pattern in patterns:
            since = counted_from(pattern.axis)
            for row in pattern.rows:
                if prompted in row.prompted and self.makes(row, pattern.axis, since):
                    return self._found(pattern, row)
        return None

    def makes(self, row: PatternRow, axis: int, since: float = -math.inf) -> bool:
        """Whether the latest swings of an angle, all begun after some seconds, satisfy a row."""
        swings = self.swings(axis)[-row.swings :]
        if not swings or swings[0].start < since or not row.fits(swings, self._least[axis]):
            return False
        *before, running = swings
        if since > -math.inf and self._held(running, axis) >= STILL:
            return False
        held = self._held(running, axis) if row.hold else 0.0
        now = self._times[-1]
        return (
            held >= row.hold
            and now - held - running.start <= row.duration
            and all(swing.end - swing.start <= row.duration for swing in before)
            and self._dominates(row, axis, swings)
            and (row.slowing >= 1 or slowing(*self._since(running.start, axis)) <= row.slowing)
            and (row.score is None or row.score(self.features(swings, axis)) > 0)
            and 2 * sum(self._leaps(swing, axis) for swing in swings) <= len(swings)
        )

    def features(self, swings: Sequence[Swing], axis: int) -> Features:
        """The features of the latest swings of an angle, two at least."""
        ends = [*(swing.end for swing in swings[:-1]), self._times[-1]]
        seconds = [end - swing.start for swing, end in zip(swings, ends, strict=True)]
        covers = [(cover[axis], cover[CROSSING[axis]]) for cover in self._covers(swings)]
        return features([swing.width for swing in swings], seconds, covers)

    def _found(self, pattern: Pattern, row: PatternRow) -> HeadGesture:
        swings = self.swings(pattern.axis)
        now, least = self._times[-1], max(row.width, self._least[pattern.axis])
        onset = swings[-row.swings].start
        for swing in reversed(swings[: -row.swings]):
            if onset - swing.start > row.duration or abs(swing.width) < least:
                break
            onset = swing.start
        sure = confidence(swings[-row.swings :], least)
        return HeadGesture(pattern.gesture, now, sure, latency=now - onset)

    def _dominates(self, row: PatternRow, axis: int, swings: Sequence[Swing]) -> bool:
        """Whether the other angles move little enough during each swing.

        During each by itself: who nods while the head turns to the side nods all the same.
        """
        return all(
            cover[axis] >= ratio * cover[AXES.index(other)]
            for cover in self._covers(swings)
            for other, ratio in row.dominance.items()
        )

    def _covers(self, swings: Sequence[Swing]) -> Iterator[list[float]]:
        """How far each angle moves during each of the latest swings, radians."""
        for number, swing in enumerate(swings, start=1):
            end = swing.end if number < len(swings) else math.inf
            yield [_range(self._between(swing.start, end, axis)) for axis in range(len(AXES))]

    def _leaps(self, swing: Swing, axis: int) -> bool:
        """Whether most of a swing lies between two poses in a row."""
        seen = [
            (time, angles[axis])
            for time, angles in zip(self._times, self._seen, strict=True)
            if swing.start <= time <= swing.end
        ]
        steps = [
            abs(angle - before)
            for (begun, before), (time, angle) in pairwise(seen)
            if time - begun <= LEAP_S
        ]
        width = _range([angle for _, angle in seen])
        return max(steps, default=0.0) >= LEAP * width > 0.0

    def _held(self, swing: Swing, axis: int) -> float:
        """Seconds that the head has stayed where a swing led it."""
        return resting(*self._since(swing.start, axis), slack=self._least[axis])

    def _since(self, start: float, axis: int) -> tuple[list[float], list[float]]:
        """Times and values of an angle since a time, the latest at least."""
        times = [time for time in self._times if time >= start] or [self._times[-1]]
        return times, [row[axis] for row in list(self._angles)[-len(times) :]]

    def _between(self, start: float, end: float, axis: int) -> list[float]:
        """The values of an angle between two times, ends included; the one before, at least."""
        times, angles = self._since(start, axis)
        return angles[: max(1, sum(time <= end for time in times))]


def confidence(swings: Sequence[Swing], least: float) -> float:
    """0.5 for two swings that just suffice, rising to 1 with their width and number.

    A single swing that suffices has 0; it rises likewise.
    """
    return max(0.0, 1 - least / sum(abs(swing.width) for swing in swings))


def unwrapped(angle: float, before: float) -> float:
    """The angle, with as many full turns as bring it next to the one before."""
    return before + math.remainder(angle - before, math.tau)


def _is_sound(time: float, angles: Angles) -> bool:
    return math.isfinite(time) and all(abs(angle) <= LARGEST for angle in angles)


def _range(angles: Sequence[float]) -> float:
    return max(angles) - min(angles)
