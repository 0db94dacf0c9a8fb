"""Seeing in a network: where a person is, whether they nod or shake the head."""

from __future__ import annotations

import math

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.events import EventBus
from hri.core.signals import FaceBox, Frame, Gaze, HeadGesture, HeadPose
from hri.vision.gesture import NOD, SHAKE, GestureRecognizer
from hri.vision.tracking import HeadFinder

ABSENCE = 3.0
"""Seconds without a face after which a person is gone."""
MEMORY = 1.0
"""Seconds for which a face counts as seen after it was seen last."""
EVENTS = {NOD: "head.nodded", SHAKE: "head.shaken"}


class HeadTracker(Behavior):
    """Follows a person's head; raises `person.seen` and, once they are away, `person.lost`."""

    category = "vision"

    latency = Param(0.05, "seconds that seeing takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "pictures; the newest is seen when there is no time for all")
    pose = Output[HeadPose]("headpose", "the head, once for each picture it is seen in")
    gaze = Output[Gaze]("gaze", "where the robot's eyes must look to meet those of the person")
    is_seen = Output[bool]("boolean", "true while a face is there, or was a second ago")

    def start(self, context: Context) -> None:
        self._worker: Worker[tuple[HeadPose | None, Gaze]] = context.clock.worker(self.latency)
        self._finder = HeadFinder()
        self._frame: Frame | None = None
        self._gaze = Gaze()
        self._presence = Presence(context.events)

    def compute(self, now: float, dt: float) -> None:
        """Take what was seen, say so, and hand over the newest picture."""
        for pose, gaze in self._worker.poll():
            if pose is not None:
                self._gaze = gaze
                self._presence.see(now)
                self.pose.send(pose)
        self._presence.pass_time(now)
        is_seen = self._presence.is_recent(now)
        self.is_seen.send(is_seen)
        if is_seen:
            self.gaze.send(self._gaze)
        self._frame = self.image.value or self._frame
        if self._frame is not None and not self._worker.is_busy:
            frame, self._frame = self._frame, None
            self._worker.submit(lambda: self._see(frame))

    def stop(self) -> None:
        self._worker.close()

    def _see(self, frame: Frame) -> tuple[HeadPose | None, Gaze]:
        pose = self._finder.see(frame)
        if pose is None or pose.box is None:
            return None, Gaze()
        height, width = frame.image.shape[:2]
        return pose, gaze_at(pose.box, width, height)


class Presence:
    """Whether somebody is there, told by events when it changes."""

    def __init__(self, events: EventBus) -> None:
        self._events = events
        self._last = -math.inf
        self._is_there = False

    def see(self, now: float) -> None:
        """A face is there now."""
        self._last = now
        if not self._is_there:
            self._is_there = True
            self._events.raise_event("person.seen")

    def pass_time(self, now: float) -> None:
        if self._is_there and now - self._last >= ABSENCE:
            self._is_there = False
            self._events.raise_event("person.lost")

    def is_recent(self, now: float) -> bool:
        return now - self._last <= MEMORY


class HeadGestures(Behavior):
    """Takes nods and shakes from poses; raises `head.nodded` and `head.shaken`."""

    category = "vision"

    pose = Input[HeadPose]("headpose", "the poses of one head")
    prompted = Input[bool](
        "boolean", "true while an answer is expected: a single nod will do", is_optional=True
    )
    gesture = Output[HeadGesture]("gesture", "the nod or shake, while it is made")

    def start(self, context: Context) -> None:
        self._events = context.events
        self._recognizer = GestureRecognizer()

    def compute(self, now: float, dt: float) -> None:
        if (pose := self.pose.value) is None:
            return
        gesture = self._recognizer.update(pose, any(self.prompted.values))
        if gesture is not None:
            self.gesture.send(gesture)
            self._events.raise_event(EVENTS[gesture.kind], confidence=round(gesture.confidence, 2))


def gaze_at(box: FaceBox, width: int, height: int) -> Gaze:
    """Where a face on a screen beside the camera must look to meet a face in the picture.

    Camera and screen look the same way, at the person. Who stands at the left of the picture
    stands at the robot's left, and that is to the right of somebody who looks at the screen; so
    x changes its sign. A face at the edge of the picture asks for all the way, 1.
    """
    x = 1 - 2 * (box.x + box.width / 2) / width
    y = 1 - 2 * (box.y + box.height / 2) / height
    return Gaze(min(1.0, max(-1.0, x)), min(1.0, max(-1.0, y)))
