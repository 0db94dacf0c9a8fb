"""One face, followed from picture to picture: by its mesh, and by the motion of its points.

The mesh is fitted where the mesh before was, moved along with the points; so no search is needed
as long as a face is there. Without a mesh the box moves along with the points, and a search must
find the face there again now and then.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hri.core.signals import FaceBox, HeadPose, Image, Landmarks
from hri.vision.detectors.face import FoundFace
from hri.vision.detectors.flow import FaceFlow, Shift
from hri.vision.detectors.mesh import (
    MARGIN,
    FaceMesh,
    FittedFace,
    Region,
    region_of,
    region_of_landmarks,
)
from hri.vision.detectors.preprocessing import Gray
from hri.vision.gestures.optical_flow_swing import OpticalFlowSwing
from hri.vision.head_pose import head_pose
from hri.vision.tracking.place import Place

PRESENT = 0.5
"""Presence above which the mesh says that a face is there."""
GRACE = 0.25
"""Seconds that a face may be without a fitting mesh; a hand before it, a blur."""
UNCONFIRMED = 1.5
"""Seconds that it may be without being found, when there is no mesh."""
RENEWAL = 0.3
"""Seconds after which the points to follow are chosen again."""
MAX_GAP = 0.5
"""Seconds between two pictures; over more, no motion is reported."""
JUMP = 0.5
"""Part of its side by which the region of a face may move beyond the motion of its points."""
GROWTH = 1.6
"""Ratio by which a region may grow or shrink from one picture to the next."""
SMALLEST = 14.0
"""Pixels of a face, below which a mesh is a guess: about 7 m before a common webcam."""


FRONTAL = math.radians(35)
"""A head turned further does not show how someone looks."""
FAR_SMALLER = 0.5
"""Part of the size of a face; what is smaller is far behind it."""
NECK_AND_CHEST = (0.5, (0.4, 1.5))
"""Sizes of a face to each side of its middle, and from where to where below it."""


@dataclass(frozen=True, slots=True)
class Sight:
    """A picture, made ready to follow faces in it."""

    image: Image
    gray: Gray
    """Gray and small."""
    scale: float
    """Pixels of the image for each of `gray`."""
    time: float
    """Seconds, when it was taken."""
    elapsed: float
    """Seconds since the picture before; infinite for the first."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the image in pixels."""
        return self.image.shape[1], self.image.shape[0]


class FaceTrack:
    """A face from when it was found until it is lost."""

    def __init__(self, sight: Sight, found: FoundFace, landmarks: Landmarks | None) -> None:
        """`landmarks` are those fitted to what was found; None where there is no mesh."""
        self.landmarks: Landmarks | None = None
        self.box, self.region = found.box, region_of(found)
        self.confirmed = sight.time
        """Seconds, when the mesh fitted, or the face was found, last."""
        self.pose = HeadPose(sight.time, 0.0, 0.0, 0.0, self.box)
        self.motion: HeadPose | None = None
        self._flow, self._swinging = FaceFlow(), OpticalFlowSwing()
        if landmarks is not None:
            self._take(landmarks, sight.time)
        self._renew(sight)

    @property
    def breadth(self) -> float:
        """Pixels from chin to hairline: the size of the face, however it is turned."""
        return self.region.side / MARGIN

    @property
    def middle(self) -> tuple[float, float]:
        """Pixels."""
        return self.region.x, self.region.y

    @property
    def is_frontal(self) -> bool:
        """Whether it is turned so little that it shows how someone looks."""
        return math.hypot(self.pose.pitch, self.pose.yaw) < FRONTAL

    @property
    def place(self) -> Place:
        """Where it is."""
        return Place(self.region.x, self.region.y, self.breadth)

    def hides(self, found: FoundFace) -> bool:
        """Whether a face that was found is not one, because this person's neck or chest is there.

        A much smaller one would be behind them, where it is invisible.
        """
        region, (aside, (begins, ends)) = region_of(found), NECK_AND_CHEST
        x, y = (region.x - self.region.x) / self.breadth, (region.y - self.region.y) / self.breadth
        is_there = abs(x) < aside and begins < y < ends
        return is_there and region.side < FAR_SMALLER * self.region.side

    def follow(self, sight: Sight) -> None:
        """Move along with the points of the face."""
        shift = self._flow.follow(sight.gray)
        self._swinging.fade(sight.elapsed)
        self.motion = None
        if shift is not None and 0 < sight.elapsed <= MAX_GAP:
            self._swinging.move(shift, self.breadth / sight.scale, sight.elapsed)
            self._move(shift, sight)
            pitch, yaw = self._swinging.pitch, self._swinging.yaw
            self.motion = HeadPose(sight.time, pitch, yaw, 0.0, self.box)
        if shift is None or sight.time - self._renewed >= RENEWAL:
            self._renew(sight)
        if self.landmarks is None:
            self.pose = self.motion or HeadPose(sight.time, 0.0, 0.0, 0.0, self.box)
            self.motion = None
            if shift is None and sight.elapsed <= MAX_GAP:
                self.confirmed = -math.inf  # the points are gone, and the face with them

    def fit(self, sight: Sight, mesh: FaceMesh) -> None:
        """Fit the mesh where the face should be; it stays as it is where none fits."""
        fitted = mesh.fit(sight.image, self.region)
        if fitted is not None and is_face(fitted, self.region):
            self._take(fitted.landmarks, sight.time)
            self.confirmed = sight.time

    def find_again(self, found: FoundFace, sight: Sight) -> None:
        """Take the box that a search has found; for a face without a mesh."""
        self.box, self.region, self.confirmed = found.box, region_of(found), sight.time

    def is_lost(self, time: float) -> bool:
        """Whether it has been unconfirmed for too long."""
        patience = UNCONFIRMED if self.landmarks is None else GRACE
        return time - self.confirmed > patience

    def _take(self, landmarks: Landmarks, time: float) -> None:
        self.landmarks = landmarks
        self.region = region_of_landmarks(landmarks)
        left, top = landmarks[:, :2].min(axis=0).tolist()
        right, bottom = landmarks[:, :2].max(axis=0).tolist()
        self.box = FaceBox(left, top, right - left, bottom - top)
        self.pose = HeadPose(time, *head_pose(landmarks), self.box)

    def _move(self, shift: Shift, sight: Sight) -> None:
        x, y = shift.x * sight.scale, shift.y * sight.scale
        self.box = replace(self.box, x=self.box.x + x, y=self.box.y + y)
        self.region = replace(self.region, x=self.region.x + x, y=self.region.y + y)

    def _renew(self, sight: Sight) -> None:
        """Choose the points to follow; the angles go on without a jump."""
        self._renewed = sight.time
        box, scale = self.box, sight.scale
        small = FaceBox(box.x / scale, box.y / scale, box.width / scale, box.height / scale)
        self._flow.start(sight.gray, small)


def is_face(fitted: FittedFace, region: Region) -> bool:
    """Whether a mesh has found a face, and that of this region: it must lie well within."""
    if fitted.presence < PRESENT or not np.isfinite(fitted.landmarks).all():
        return False
    now = region_of_landmarks(fitted.landmarks)
    away = math.hypot(now.x - region.x, now.y - region.y)
    return (
        now.side >= MARGIN * SMALLEST
        and away <= JUMP * region.side
        and 1 / GROWTH <= now.side / region.side <= GROWTH
    )
