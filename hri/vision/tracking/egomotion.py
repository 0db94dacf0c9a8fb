"""What the robot's own turning does to the pictures, taken out of the motion of a face.

When the camera turns to the left everything in the picture moves to the right, which looks as if
everyone turned the head. Poses from the face mesh are free of it: the mesh is turned against
the way to the camera. Where the camera looked is asked for at the time when the picture was taken.
"""

from __future__ import annotations

import bisect
import math
from collections import deque
from dataclasses import replace

from hri.core.signals import Person
from hri.vision.camera_view import FACE_SIZE
from hri.vision.gestures.optical_flow_swing import FADE, RADIUS

USUAL_DISTANCE = 1.0
"""Meters, of someone whose distance is unknown."""
FASTEST = 0.5
"""Sizes of the face a second; above, pictures are blurred and nothing in them is believed."""
REMEMBERED = 2.0
"""Seconds for which it is known where the camera looked."""
MOST = 1000
"""Headings that are kept."""


class Egomotion:
    """Where the camera looked lately."""

    def __init__(self) -> None:
        self._times: deque[float] = deque(maxlen=MOST)
        self._headings: deque[float] = deque(maxlen=MOST)

    def add(self, time: float, heading: float) -> None:
        """Take the camera's heading at a time: radians to the left, of any full turns."""
        if not math.isfinite(time) or not math.isfinite(heading):
            return
        if self._times and time <= self._times[-1]:
            if time < self._times[-1]:
                self._times.clear()
                self._headings.clear()
            else:
                return
        if self._headings:
            heading = self._headings[-1] + math.remainder(heading - self._headings[-1], math.tau)
        self._times.append(time)
        self._headings.append(heading)
        while time - self._times[0] > REMEMBERED:
            self._times.popleft()
            self._headings.popleft()

    def turned(self, start: float, end: float) -> float:
        """Radians by which the camera turned to the left; 0 where nothing is known of it."""
        return self.heading(end) - self.heading(start)

    def heading(self, time: float) -> float:
        """The heading at a time; that of the nearest known time beyond them, else 0."""
        if not self._times:
            return 0.0
        after = bisect.bisect_left(self._times, time)
        if after == 0:
            return self._headings[0]
        if after == len(self._times):
            return self._headings[-1]
        before, now = self._times[after - 1], self._times[after]
        part = (time - before) / (now - before)
        return self._headings[after - 1] + part * (
            self._headings[after] - self._headings[after - 1]
        )


class Steadied:
    """One person without the robot's own motion."""

    def __init__(self, own: Egomotion) -> None:
        self._own = own
        self._time = -math.inf
        self._yaw = 0.0

    def update(self, person: Person) -> Person | None:
        """The person as a camera at rest would see them; None while it turns too fast for that."""
        told = person.pose if person.motion is None else person.motion
        time = max(told.time, person.pose.time)
        elapsed = time - self._time
        if not elapsed > 0:
            return person
        self._time = time
        if elapsed == math.inf:
            return person
        distance = person.distance if math.isfinite(person.distance) else USUAL_DISTANCE
        shift = self._own.turned(time - elapsed, time) * distance / FACE_SIZE
        # The head motion seen in the picture falls back to 0; so does this part of it.
        self._yaw = self._yaw * math.exp(-elapsed / FADE) + shift / RADIUS
        if abs(shift) > FASTEST * elapsed:
            return None
        steady = replace(told, yaw=told.yaw - self._yaw)
        if person.motion is not None:
            return replace(person, motion=steady)
        # Without a mesh the pose itself comes from the motion of the picture.
        return replace(person, pose=steady) if person.landmarks is None else person
