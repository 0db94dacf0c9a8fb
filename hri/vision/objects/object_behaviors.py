"""Object recognition in a network."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.service import Service
from hri.core.signals import FoundObject, Frame, Objects
from hri.core.writing import Mark, mark_of
from hri.hal.camera import Camera
from hri.vision.behaviors import camera_of
from hri.vision.camera_view import CameraView
from hri.vision.objects.embedding import Embedding
from hri.vision.objects.local_features import ORB, SIFT
from hri.vision.objects.model_file import find_models, load_models
from hri.vision.objects.object_model import ModelSet
from hri.vision.objects.object_presence import MEMORY, ObjectPresence
from hri.vision.objects.recognizer import ObjectRecognizer

CENTIMETERS = 100.0
CHECK_EVERY = 1.0
"""Seconds between two looks at whether the set has changed."""


class ObjRecRecognizer(Behavior):
    """Recognizes the objects of a model set in the pictures of a camera, in a separate process.

    `objects` has all of them. `model_name` and what belongs to it are of one object: when several
    are in view, they take turns, picture by picture. Raises the events `object.seen` and
    `object.lost`; and `vision.failed` with the `reason` when recognition fails, which restarts by
    itself.
    """

    category = "vision"
    modelset = Param("default.mdl", "a model set, its path or name; objects.mdl is your own")
    field_of_view = Param(0.0, "radians; 0 is that of the camera", minimum=0.0, maximum=3.0)
    only = Param("", "name of the one object to look for; empty looks for all of them")
    camera_id = Param("camera", "id of the camera that takes the pictures; its pose is used")
    features = Param(SIFT, "of a list of names; orb is for weak machines", among=(SIFT, ORB))
    embedding = Param(
        "", "an ONNX network that describes pictures, for plain objects; empty for none"
    )
    interval = Param(0.0, "seconds between two looks at least", minimum=0, maximum=60)
    looks_ahead = Param(True, "whether a camera on a neck looks ahead, not at people")
    latency = Param(0.05, "seconds that it takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "pictures; the newest is seen when there is no time for all")
    objects = Output[Objects]("objects", "all that were recognized, once for each picture seen")
    model_name = Output[str]("string", "name of the object; nothing when none is in view")
    x = Output[float]("double", "of its center, pixels from the left")
    y = Output[float]("double", "of its center, pixels from the top")
    distance = Output[float](
        "double", "centimeters from the camera to it; nothing when its size is unknown"
    )
    range = Output[float]("double", "the distance in meters; nothing when its size is unknown")
    bearing = Output[float]("double", "radians from the robot's straight ahead to the left")
    confidence = Output[float]("double", "0 to 1")

    _service: Service[Frame, Objects] | None
    """None without a set."""
    _mark: Mark | None
    """Of the set as it was read last."""
    _checked: float

    def check(self) -> None:
        path = find_models(self.modelset)
        network = Path(self.embedding) if self.embedding else None
        self._recognizing = Recognizing(path, self.only, self.features, CameraView(), network)
        if network is not None:
            Embedding(network)
        if _mark(path) is not None:
            self._recognizing.models()

    def start(self, context: Context) -> None:
        self._events, self._resources = context.events, context.resources
        self._clock, self._service = context.clock, None
        self._camera: Camera | None = camera_of(context, self.camera_id)
        try:
            view = CameraView.of(self._camera) if self._camera else CameraView()
            if self.field_of_view:
                view = replace(view, field_of_view=self.field_of_view)
            if self._camera is not None and self.looks_ahead:
                self._camera.look_ahead(True)
            self._recognizing = replace(self._recognizing, view=view)
            self._begin()
        except HriError:
            self._give_back()  # a behavior that fails to start is not stopped
            raise
        self._presence = ObjectPresence[FoundObject]()
        self._frame: Frame | None = None
        self.newest: Frame | None = None
        """The newest picture."""
        self._pan, self._turn = 0.0, 0
        self._reported = self._asked = -math.inf
        self.last = Objects(-math.inf)
        """What was recognized last."""

    @property
    def present(self) -> tuple[FoundObject, ...]:
        """The objects that are there, as they were found last."""
        return self._presence.present

    def compute(self, now: float, dt: float) -> None:
        """Collect results, and hand over the newest picture."""
        if now - self._checked >= CHECK_EVERY:
            self._checked = now
            if _mark(self._recognizing.path) != self._mark:
                self._end()
                self._begin()
        self._collect(now)
        if now - self._reported > MEMORY:
            # Without pictures nothing is there that can be pointed at.
            self._raise_lost(self._presence.forget(math.inf))
        if self.image.value is not None:
            self._frame = self.newest = self.image.value
        if self._service is None or self._frame is None or self._service.is_busy:
            return
        if now - self._asked >= self.interval:
            self._pan = self._camera.pan(self._frame.time) if self._camera else 0.0
            self._service.ask(self._frame)
            self._frame, self._asked = None, now

    def stop(self) -> None:
        self._end()
        self._give_back()

    def _begin(self) -> None:
        """Start to recognize with the set as it is now; nothing where there is none yet."""
        self._checked = self._clock.now()
        self._mark = _mark(self._recognizing.path)
        if self._mark is not None:
            self._service = self._clock.service(self._recognizing, self.latency)

    def _end(self) -> None:
        if self._service is not None:
            self._service.close()
            self._service = None

    def _collect(self, now: float) -> None:
        if self._service is None:
            return
        try:
            for objects in self._service.poll():
                self._report(_panned(objects, self._pan), now)
        except NotAvailable as error:
            self._events.raise_event("vision.failed", reason=str(error))

    def _give_back(self) -> None:
        if self._camera is not None:
            if self.looks_ahead:
                self._camera.look_ahead(False)
            self._resources.release(self._camera)
            self._camera = None

    def _report(self, objects: Objects, now: float) -> None:
        self.last, self._reported = objects, now
        self.objects.send(objects)
        come, gone = self._presence.update(objects.time, objects.found)
        for one in come:
            more = {} if math.isnan(one.distance) else {"distance": round(one.distance, 2)}
            self._events.raise_event(
                "object.seen", object=one.name, bearing=round(one.bearing, 3), **more
            )
        self._raise_lost(gone)
        if objects.found:
            known = sorted(objects.found, key=lambda one: one.name)
            self._send(known[self._turn % len(known)])
            self._turn += 1

    def _raise_lost(self, names: list[str]) -> None:
        for name in names:
            self._events.raise_event("object.lost", object=name)

    def _send(self, one: FoundObject) -> None:
        self.model_name.send(one.name)
        self.x.send(one.x)
        self.y.send(one.y)
        self.bearing.send(one.bearing)
        self.confidence.send(one.confidence)
        if not math.isnan(one.distance):
            self.distance.send(one.distance * CENTIMETERS)
            self.range.send(one.distance)


@dataclass(frozen=True, slots=True)
class Recognizing:
    """Makes a recognizer of a model set, where the work is done."""

    path: Path
    only: str
    method: str
    view: CameraView
    network: Path | None = None
    """Of the embedding."""

    def models(self) -> ModelSet:
        """The set, or the one object of it. Raises HriError."""
        models = load_models(self.path, self.method)
        if not self.only:
            return models
        model = models.find(self.only)
        if model is None:
            remedy = did_you_mean(self.only, [one.name for one in models.objects])
            raise HriError(f'{self.path.name} has no "{self.only}" - {remedy}')
        return ModelSet(models.method, (model,))

    def __call__(self) -> Callable[[Frame], Objects]:
        embedding = Embedding(self.network) if self.network is not None else None
        recognizer = ObjectRecognizer(self.models(), self.view, embedding)
        return lambda frame: Objects(frame.time, recognizer.recognize(frame.image))


def _mark(path: Path) -> Mark | None:
    """By which a file is known again; None where there is none, or none that can be looked at."""
    try:
        return mark_of(path.stat())
    except OSError:
        return None


def _panned(objects: Objects, pan: float) -> Objects:
    """The same objects, seen by a camera turned to the left by an angle, radians."""
    if not pan:
        return objects
    turned = (
        replace(one, bearing=math.remainder(one.bearing + pan, math.tau)) for one in objects.found
    )
    return replace(objects, found=tuple(turned))
