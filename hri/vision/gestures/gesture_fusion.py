"""Gestures of one person, recognized from two signals that fail in different ways.

The pose from the face mesh jitters while a person walks or comes nearer; the motion of the picture
within the face takes translation for turning. What both call a nod is one. The pose decides; the
motion, which lags and drifts, needs one swing less.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from hri.core.signals import HeadGesture, Person
from hri.vision.gestures.gesture_patterns import AXES, Pattern
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

AGAIN = 1.25
"""Seconds after which a signal may report a continuing gesture again: the other may have been late,
and people who nod along nod again and again."""
NEAR = 0.3
"""Seconds by which the movements in the two signals may miss each other."""
ROLL = AXES.index("roll")
"""Invisible in the motion, so that the pose alone decides."""


class GestureFusion:
    """Takes one person as they were seen in each picture."""

    def __init__(self, patterns: Iterable[Pattern]) -> None:
        patterns = tuple(patterns)
        self._by_pose_alone = {pattern.gesture for pattern in patterns if pattern.axis == ROLL}
        self._of_pose = GestureRecognizer(patterns, AGAIN)
        self._of_motion = GestureRecognizer(map(_with_less, patterns), AGAIN)
        self._by_pose: HeadGesture | None = None
        self._by_motion: HeadGesture | None = None
        self._has_motion = False

    def update(self, person: Person, prompted: bool = False) -> HeadGesture | None:
        """The gesture that is complete now, if any. `prompted`: an answer is expected.

        For a person without any motion so far the pose alone decides.
        """
        found = self._of_pose.update(person.pose, prompted)
        if person.motion is not None:
            self._has_motion = True
            self._by_motion = self._of_motion.update(person.motion, prompted) or self._by_motion
        if self._has_motion and not (found and found.kind in self._by_pose_alone):
            self._by_pose = found or self._by_pose
            found = _agreed(self._by_pose, self._by_motion)
        if found is None:
            return None
        self._by_pose = self._by_motion = None
        return replace(found, person=person.id)


def _with_less(pattern: Pattern) -> Pattern:
    """A pattern for the motion: each row with one swing less, which may still be under way."""
    rows = (
        replace(row, swings=max(1, row.swings - 1), slowing=1.0, score=None) for row in pattern.rows
    )
    return replace(pattern, rows=tuple(rows))


def _agreed(pose: HeadGesture | None, motion: HeadGesture | None) -> HeadGesture | None:
    """The gesture in which both agree, if their movements overlap: as sure as the pose, from the
    earlier onset.
    """
    if pose is None or motion is None or pose.kind != motion.kind:
        return None
    onsets = pose.time - pose.latency, motion.time - motion.latency
    if max(onsets) > min(pose.time, motion.time) + NEAR:
        return None
    time, onset = max(pose.time, motion.time), min(onsets)
    return HeadGesture(pose.kind, time, pose.confidence, latency=time - onset)
