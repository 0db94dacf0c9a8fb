"""Colors in a network."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.signals import ColorBlob, ColorBlobs, Frame, People
from hri.hal.camera import Camera
from hri.vision.behaviors import camera_of
from hri.vision.camera_view import CameraView
from hri.vision.color.color_mixture import FEWEST, ColorTable
from hri.vision.color.color_model import find_color
from hri.vision.color.segmentation import ColorSegmenter, tables_of
from hri.vision.color.skin import SKIN, skin_samples, skin_table

SKIN_EVERY = 2.0
"""Seconds between two looks at the color of faces."""
LEARNING_S = 0.05
"""What learning it takes on a fake clock."""


class ColorSegmentation(Behavior):
    """Finds the blobs of learned colors in the pictures of a camera, in any light.

    `blobs` has all of them; the other outputs are of the largest one that is likelier than not, or
    else of the largest. With `skin`, the skin of the faces that are seen now is a color, too.
    """

    category = "vision"
    colors = Param("red_ball", "names of colors, or paths of their files, with spaces between")
    skin = Param(False, 'whether the skin of the people who are seen is a color, named "skin"')
    width = Param(0.0, "meters, of what has the color; 0: its distance stays unknown", minimum=0)
    camera_id = Param("camera", "id of the camera that takes the pictures; its pose is used")
    looks_ahead = Param(False, "whether a camera on a neck looks ahead, not at people")

    image = Input[Frame]("image", "pictures")
    people = Input[People]("people", "whose skin is a color; only with `skin`", is_optional=True)
    blobs = Output[ColorBlobs]("blobs", "all of them, the largest first, once for each picture")
    name = Output[str]("string", "color of the largest; nothing when there is none")
    x = Output[float]("double", "of its center, pixels from the left")
    y = Output[float]("double", "of its center, pixels from the top")
    area = Output[float]("double", "its pixels, 0 to 1 of the picture; 0 when there is none")
    bearing = Output[float]("double", "radians from the robot's straight ahead to the left")
    range = Output[float]("double", "meters to it; nothing when its width is not known")

    def check(self) -> None:
        self._tables = tables_of([find_color(name) for name in self.colors.split()])
        if not (self._tables or self.skin):
            raise HriError("no color to look for - name some in `colors`, or set `skin`")

    def start(self, context: Context) -> None:
        self._resources = context.resources
        self._camera: Camera | None = camera_of(context, self.camera_id)
        self._view = CameraView.of(self._camera) if self._camera else CameraView()
        if self._camera is not None and self.looks_ahead:
            self._camera.look_ahead(True)
        self._segmenter = ColorSegmenter(self._tables)
        self._worker: Worker[ColorTable] = context.clock.worker(LEARNING_S)
        self._learned = -math.inf

    def compute(self, now: float, dt: float) -> None:
        """Look at a picture."""
        for table in self._worker.poll():
            self._segmenter.learn(SKIN, table)
        if (frame := self.image.value) is None:
            return
        if self.skin:
            self._learn_skin(frame, self.people.value, now)
        size = frame.width, frame.height
        pan = self._camera.pan(frame.time) if self._camera else 0.0
        found = tuple(
            self._placed(blob, size, pan) for blob in self._segmenter.segment(frame.image)
        )
        blobs = ColorBlobs(frame.time, found)
        self.blobs.send(blobs)
        if (largest := blobs.largest()) is not None:
            self._send(largest, size)
        else:
            self.area.send(0.0)

    def stop(self) -> None:
        self._worker.close()
        if self._camera is not None:
            if self.looks_ahead:
                self._camera.look_ahead(False)
            self._resources.release(self._camera)
            self._camera = None

    def _learn_skin(self, frame: Frame, people: People | None, now: float) -> None:
        if people is None or self._worker.is_busy or now - self._learned < SKIN_EVERY:
            return
        faces = [p.pose.box for p in people.persons if p.is_visible and p.pose.box is not None]
        skin, background = skin_samples(frame.image, faces)
        if min(len(skin), len(background)) >= FEWEST:
            self._learned = now
            self._worker.submit(partial(skin_table, skin, background))

    def _placed(self, blob: ColorBlob, size: tuple[int, int], pan: float) -> ColorBlob:
        bearing, elevation = self._view.toward(blob.x, blob.y, size)
        return replace(blob, bearing=math.remainder(bearing + pan, math.tau), elevation=elevation)

    def _send(self, blob: ColorBlob, size: tuple[int, int]) -> None:
        self.name.send(blob.name)
        self.x.send(blob.x)
        self.y.send(blob.y)
        self.area.send(blob.area / (size[0] * size[1]))
        self.bearing.send(blob.bearing)
        if self.width:
            away = self._view.distance(blob.x, blob.y, blob.width, self.width, size)
            self.range.send(away)
