"""The track of one person: what stays theirs while faces come and go."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hri.core.signals import Person
from hri.vision.blendshapes import PUPILS, Expressiveness
from hri.vision.camera_view import EYE_DISTANCE, FACE_SIZE, CameraView
from hri.vision.engagement import Engagement, Zones
from hri.vision.eye_contact import EyeContact, looking_score
from hri.vision.tracking.body_track import BodyTrack
from hri.vision.tracking.clothes import Clothes
from hri.vision.tracking.face_track import FaceTrack
from hri.vision.tracking.identity import Identity
from hri.vision.tracking.place import Place

DISTANCE_SMOOTHING = 0.25
"""Seconds over which the distance is averaged."""
WALKED_AWAY = 2.0
"""Seconds from behind; others who pass cover a face for less."""
DEPTH_LEARNING = 0.2
"""Part of how far away someone is, for the size of the face, that each picture makes up."""


class PersonTrack:
    """Who they are, which face is theirs now, and what they are doing."""

    def __init__(self, number: int, time: float, zones: Zones) -> None:
        self.number = number
        self.id = f"p{number}"
        self.face: FaceTrack | None = None
        self.identity = Identity()
        self.clothes, self.body = Clothes(), BodyTrack()
        self.dressed = -math.inf
        """Seconds, when their clothes were learned last."""
        self.faced = time
        """Seconds, when the face came that they have."""
        self._since = time
        self.seen = time
        """Seconds, when they were in sight last."""
        self.learned = -math.inf
        self.fitted = -math.inf
        self.person: Person | None = None
        self._distance, self._depth = math.nan, 1.0
        self._distance_time = time
        self._looking, self._engagement = EyeContact(), Engagement(zones)
        self._expressiveness = Expressiveness()

    @property
    def went_away(self) -> bool:
        """Whether they were seen from behind last, not their face."""
        return self.body.seen > self.body.rested

    @property
    def walked_away(self) -> bool:
        """Whether they were followed from behind for longer than others cover a face."""
        return self.body.seen - self.body.rested > WALKED_AWAY

    def describe(self, time: float, size: tuple[int, int], view: CameraView) -> Person:
        """The person as they are now, or as they were last while they are out of sight."""
        if self.face is not None:
            self.person = self._visible(time, self.face, size, view)
        elif self.body.place is not None and self.body.seen == time:
            self.person = self._from_behind(time, self.body.place, size, view)
        else:
            self.person = self._hidden(time)
        return self.person

    def _visible(
        self, time: float, face: FaceTrack, size: tuple[int, int], view: CameraView
    ) -> Person:
        x, y, pixels, meters = _gauge(face)
        measured = view.distance(x, y, pixels, meters, size)
        distance = self._smoothed(time, measured)
        if face.is_frontal:
            depth = measured / view.distance(x, y, face.breadth, FACE_SIZE, size)
            self._depth += DEPTH_LEARNING * (depth - self._depth) if math.isfinite(depth) else 0.0
        bearing, elevation = view.toward(x, y, size)
        score = looking_score(face.pose.pitch, face.pose.yaw)
        is_looking = self._looking.update(time, score)
        landmarks = face.landmarks
        return Person(
            self.id,
            face.pose,
            face.motion,
            distance=distance,
            bearing=bearing,
            elevation=elevation,
            looking=score,
            is_looking=is_looking,
            engagement=self._engagement.update(time, distance, is_looking),
            countenance=None if landmarks is None else self._expressiveness.update(time, landmarks),
            landmarks=landmarks,
            since=self._since,
        )

    def _from_behind(
        self, time: float, place: Place, size: tuple[int, int], view: CameraView
    ) -> Person:
        assert self.person is not None
        measured = view.distance(place.x, place.y, place.breadth, FACE_SIZE, size)
        distance = self._smoothed(time, self._depth * measured)
        bearing, elevation = view.toward(place.x, place.y, size)
        is_looking = self._looking.update(time, 0.0)
        return replace(
            self.person,
            pose=replace(self.person.pose, box=None),
            motion=None,
            is_visible=True,
            distance=distance,
            bearing=bearing,
            elevation=elevation,
            looking=0.0,
            is_looking=is_looking,
            engagement=self._engagement.update(time, distance, is_looking),
            countenance=None,
            landmarks=None,
            hands=(),
            has_face=False,
            body=place.body,
        )

    def _hidden(self, time: float) -> Person:
        assert self.person is not None
        is_looking = self._looking.update(time, 0.0)
        return replace(
            self.person,
            is_visible=False,
            has_face=False,
            body=None,
            motion=None,
            looking=0.0,
            is_looking=is_looking,
            engagement=self._engagement.update(time, self.person.distance, is_looking),
        )

    def _smoothed(self, time: float, distance: float) -> float:
        elapsed, self._distance_time = time - self._distance_time, time
        if not math.isfinite(self._distance) or elapsed > 1.0:
            self._distance = distance
        elif math.isfinite(distance):
            part = 1 - math.exp(-max(0.0, elapsed) / DISTANCE_SMOOTHING)
            self._distance += (distance - self._distance) * part
        return self._distance


def number_of(id: str) -> int:
    """The number in the id of someone."""
    return int(id[1:])


def _gauge(face: FaceTrack) -> tuple[float, float, float, float]:
    """Where the eyes are, in pixels, and a length to measure the distance by: pixels and meters.

    With a mesh it is the distance of the pupils in all three directions, which turning the head
    does not shorten; else the size of the face.
    """
    if face.landmarks is None:
        x, y = face.middle
        return x, y, face.breadth, FACE_SIZE
    right, left = (face.landmarks[list(eye)].mean(axis=0) for eye in PUPILS)
    x, y = ((right + left) / 2)[:2].tolist()
    return x, y, float(np.linalg.norm(left - right)), EYE_DISTANCE
