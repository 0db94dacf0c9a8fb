"""Markers in a network."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError, NotAvailable
from hri.core.service import Service
from hri.core.signals import Frame, Marker, Markers, Pose2D
from hri.hal.camera import Camera
from hri.vision.behaviors import camera_of
from hri.vision.camera_view import CameraView
from hri.vision.markers.families import DEFAULT, check_families
from hri.vision.markers.marker_reader import SIDE, MarkerReader
from hri.vision.objects.object_presence import MEMORY, ObjectPresence


class MarkerFinder(Behavior):
    """Finds printed markers in the pictures of a camera, in a separate process.

    `markers` has all of them; the other outputs are of the nearest. A marker that is found in two
    of three pictures raises `marker.seen`, once, and `marker.lost` when it was not found for two
    seconds. `vision.failed` gives the `reason` when finding fails, which restarts by itself.
    """

    category = "vision"
    families = Param(DEFAULT, "apriltag_36h11, aruco_4x4_50, aruco_5x5_50, qr; with spaces between")
    side = Param(SIDE, "meters of the black square", minimum=0.005, maximum=5)
    camera_id = Param("camera", "id of the camera that takes the pictures; its pose is used")
    interval = Param(0.25, "seconds between two looks at least", minimum=0, maximum=60)
    looks_ahead = Param(False, "whether a camera on a neck looks ahead, not at people")
    latency = Param(0.05, "seconds that it takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "pictures; the newest is seen when there is no time for all")
    markers = Output[Markers]("markers", "all that were found, once for each picture seen")
    is_seen = Output[bool]("boolean", "whether a marker is there, or was two seconds ago")
    name = Output[str]("string", 'of the nearest, such as "apriltag_36h11:7"')
    marker_id = Output[float]("double", "of the nearest, in its family; -1 for a code with a text")
    text = Output[str]("string", "of the nearest, if it is a code: never opened or obeyed")
    range = Output[float]("double", "meters from the camera to it")
    bearing = Output[float]("double", "radians from the robot's straight ahead to the left")
    tilt = Output[float]("double", "radians by which it is turned from facing the camera")
    pose = Output[Pose2D]("pose", "on the robot's floor: where it is, and where it faces")

    def check(self) -> None:
        check_families(self.families.split())

    def start(self, context: Context) -> None:
        self._events, self._resources = context.events, context.resources
        self._camera: Camera | None = camera_of(context, self.camera_id)
        try:
            view = CameraView.of(self._camera) if self._camera else CameraView()
            if self._camera is not None and self.looks_ahead:
                self._camera.look_ahead(True)
            finding = Finding(tuple(self.families.split()), self.side, view)
            self._service: Service[Seen, Markers] = context.clock.service(finding, self.latency)
        except HriError:
            self._give_back()  # a behavior that fails to start is not stopped
            raise
        self._presence = ObjectPresence[Marker]()
        self._frame: Frame | None = None
        self._asked = self._reported = -math.inf
        self.last = Markers(-math.inf)
        """What was found last."""

    @property
    def present(self) -> tuple[Marker, ...]:
        """The markers that are there, as they were found last."""
        return self._presence.present

    def compute(self, now: float, dt: float) -> None:
        """Collect results, and hand over the newest picture."""
        self._collect(now)
        if now - self._reported > MEMORY:
            self._raise_lost(self._presence.forget(math.inf))
        self.is_seen.send(bool(self._presence.present))
        self._frame = self.image.value or self._frame
        if self._frame is None or self._service.is_busy or now - self._asked < self.interval:
            return
        pan = self._camera.pan(self._frame.time) if self._camera else 0.0
        self._service.ask(Seen(self._frame, pan))
        self._frame, self._asked = None, now

    def stop(self) -> None:
        self._service.close()
        self._give_back()

    def _collect(self, now: float) -> None:
        try:
            for markers in self._service.poll():
                self._report(markers, now)
        except NotAvailable as error:
            self._events.raise_event("vision.failed", reason=str(error))

    def _report(self, markers: Markers, now: float) -> None:
        self.last, self._reported = markers, now
        self.markers.send(markers)
        come, gone = self._presence.update(markers.time, markers.found)
        for one in come:
            self._events.raise_event("marker.seen", **told(one))
        self._raise_lost(gone)
        if markers.found:
            self._send(markers.found[0])

    def _send(self, one: Marker) -> None:
        self.name.send(one.name)
        self.marker_id.send(float(one.id))
        self.text.send(one.text)
        self.range.send(one.distance)
        self.bearing.send(one.bearing)
        self.tilt.send(one.tilt)
        self.pose.send(one.pose)

    def _raise_lost(self, names: list[str]) -> None:
        for name in names:
            self._events.raise_event("marker.lost", marker=name)

    def _give_back(self) -> None:
        if self._camera is not None:
            if self.looks_ahead:
                self._camera.look_ahead(False)
            self._resources.release(self._camera)
            self._camera = None


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """A picture, and how the camera was turned."""

    frame: Frame
    pan: float


@dataclass(frozen=True, slots=True)
class Finding:
    """Makes a reader of markers, where the work is done."""

    families: tuple[str, ...]
    side: float
    view: CameraView

    def __call__(self) -> Callable[[Seen], Markers]:
        reader = MarkerReader(self.families, self.side, self.view)
        return lambda seen: Markers(seen.frame.time, reader.find(seen.frame.image, seen.pan))


def told(one: Marker) -> dict[str, Any]:
    """The properties of an event about a marker."""
    known: dict[str, Any] = {"marker": one.name, "family": one.family}
    known |= {"text": one.text} if one.id < 0 else {"id": one.id}
    places = {"distance": one.distance, "bearing": one.bearing, "tilt": one.tilt}
    return known | {name: round(value, 3) for name, value in places.items()}
