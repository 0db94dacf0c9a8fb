"""Motion in a network."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections import deque
from functools import partial

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.signals import Frame, Motion, Pose2D
from hri.hal.camera import Camera
from hri.vision.behaviors import camera_of
from hri.vision.camera_view import CameraView
from hri.vision.motion.block_flow import mean_of
from hri.vision.motion.motion_finder import CameraMove, FoundMotion, MotionFinder
from hri.vision.tracking.egomotion import Egomotion

SEEN_IN, OF_PICTURES = 2, 3
"""Something moves when it does in this many of this many pictures in a row."""
MEMORY = 1.0
"""Seconds without motion after which it has ended."""


class _MovingPictures(Behavior):
    """Base of what compares pictures, off the robot loop."""

    category = "vision"
    camera_id = Param("camera", "id of the camera that takes the pictures; its pose is used")
    latency = Param(0.0, "seconds that it takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "pictures; the newest is seen when there is no time for all")
    place = Input[Pose2D](
        "pose", "of the odometry: what the robot's own motion makes is subtracted", is_optional=True
    )
    motion = Output[Motion]("motion", "how the picture moved, once for each that was seen")

    def start(self, context: Context) -> None:
        self._events, self._resources = context.events, context.resources
        self._camera: Camera | None = camera_of(context, self.camera_id)
        view = CameraView.of(self._camera) if self._camera else CameraView()
        self._finder = MotionFinder(view)
        self._worker: Worker[FoundMotion | None] = context.clock.worker(self.latency)
        self._frame: Frame | None = None
        self._pose, self._own = Pose2D(), Egomotion()

    def compute(self, now: float, dt: float) -> None:
        """Collect results, and hand over the newest picture."""
        self._pose = self.place.value or self._pose
        self._own.add(now, self._pose.heading)
        self._frame = self.image.value or self._frame
        self._collect(now)
        if self._frame is None or self._worker.is_busy:
            return
        frame, self._frame = self._frame, None
        pan = self._camera.pan(frame.time) if self._camera else 0.0
        heading = self._own.heading(frame.time) + pan
        place = CameraMove(heading, self._pose.x, self._pose.y)
        self._worker.submit(partial(self._finder.look, frame.image, frame.time, place, pan))
        self._collect(now)

    def stop(self) -> None:
        self._worker.close()
        if self._camera is not None:
            self._resources.release(self._camera)
            self._camera = None

    def _collect(self, now: float) -> None:
        for found in self._worker.poll():
            if found is not None:
                self.motion.send(found.motion)
                self._report(found)

    @abstractmethod
    def _report(self, found: FoundMotion) -> None:
        """Send what is special."""


class MotionFlow(_MovingPictures):
    """How the picture moves: a field of cells of 16 pixels, its mean, and how it grows.

    Cells of a plain wall show noise alone; each cell counts by its confidence.

    The robot's own turning and driving are subtracted from the field. The growth of the picture
    keeps the part caused by driving, since that part announces a collision.
    """

    x = Output[float]("double", "mean of the field, pixels a second to the right")
    y = Output[float]("double", "mean of the field, pixels a second down")
    expansion = Output[float]("double", "share of its size by which the picture grows in a second")
    time_to_contact = Output[float](
        "double",
        "seconds until the camera is where the scene is; nothing unless it surely comes nearer",
    )
    confidence = Output[float]("double", "mean of the field's, 0 to 1: how sure its motion is")

    def _report(self, found: FoundMotion) -> None:
        x, y = mean_of(found.motion.cells, found.motion.confidence)
        self.x.send(x)
        self.y.send(y)
        self.confidence.send(float(found.motion.confidence.mean()))
        self.expansion.send(found.expansion)
        if math.isfinite(found.time_to_contact):
            self.time_to_contact.send(found.time_to_contact)


class MotionDetector(_MovingPictures):
    """What moves, also while the robot itself does.

    The outputs beside `motion` are of the largest region. Raises `motion.started` (`bearing`) and
    `motion.ended`.
    """

    is_moving = Output[bool]("boolean", "whether something moves, or did a second ago")
    x = Output[float]("double", "of its center, pixels from the left")
    y = Output[float]("double", "of its center, pixels from the top")
    width = Output[float]("double", "of the box around it, pixels")
    height = Output[float]("double", "of the box around it, pixels")
    bearing = Output[float]("double", "radians from the robot's straight ahead to the left")

    def start(self, context: Context) -> None:
        super().start(context)
        self._recent: deque[bool] = deque(maxlen=OF_PICTURES)
        self._is_moving, self._seen = False, -math.inf

    def compute(self, now: float, dt: float) -> None:
        super().compute(now, dt)
        if self._is_moving and now - self._seen > MEMORY:
            self._is_moving = False
            self._events.raise_event("motion.ended")
        self.is_moving.send(self._is_moving)

    def _report(self, found: FoundMotion) -> None:
        regions = found.motion.regions
        self._recent.append(bool(regions))
        if not regions or sum(self._recent) < SEEN_IN:
            return
        largest, self._seen = regions[0], found.motion.time
        if not self._is_moving:
            self._is_moving = True
            self._events.raise_event("motion.started", bearing=round(largest.bearing, 3))
        self.x.send(largest.x)
        self.y.send(largest.y)
        self.width.send(largest.width)
        self.height.send(largest.height)
        self.bearing.send(largest.bearing)
