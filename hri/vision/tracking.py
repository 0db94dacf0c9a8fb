"""One person's head, found and followed through the pictures of a camera.

A cascade finds the face now and then; between, points in it are followed. Their motion, as a part
of the width of the face, gives the swings of the head. The angles tell movements, not where the
head has turned to stay: they fall back to 0 within seconds, so that errors do not add up and a
step aside is not taken for a turned head.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hri.core.signals import FaceBox, Frame, HeadPose
from hri.vision.detectors.flow import FaceFlow, Shift
from hri.vision.detectors.haar import HaarDetector
from hri.vision.detectors.picture import Gray, gray_picture

RADIUS = 0.59
"""Distance from the joint of the head to the points of the face, in widths of the box."""
FADE = 1.5
"""Seconds in which an angle falls to a third."""
MAX_ANGLE = math.radians(60)
"""Angles stay within; flow alone cannot follow a head any further."""
SEARCH_INTERVAL = 0.09
"""Seconds between two searches of the whole picture while no face is known."""
CHECK_INTERVAL = 0.3
"""Seconds between two searches where the face should be."""
MAX_UNCONFIRMED = 1.5
"""Seconds without success of those searches after which the face counts as lost."""
MAX_GAP = 0.5
"""Seconds between two pictures; more, or time that goes back, starts a new search."""
WALK_SMOOTHING = 0.4
"""Seconds over which the motion of the whole person is averaged."""
WALK_SPEED = 0.8
"""Widths of the face a second; above, the person walks and the swings are not those of a head."""
WALK_GROWTH = 0.25
"""Relative growth of the face a second, likewise."""


class HeadFinder:
    """Sees frames one by one, in the order they were taken; the same frames give the same poses."""

    def __init__(self) -> None:
        self._detector = HaarDetector()
        self._flow = FaceFlow()
        self._swing = Swinging()
        self._face: FaceBox | None = None
        self._candidate: FaceBox | None = None
        self._time = -math.inf
        self._checked = self._confirmed = -math.inf
        self._shape: tuple[int, ...] = ()

    def see(self, frame: Frame) -> HeadPose | None:
        """The pose of the head at the time of the frame; None when no face is seen.

        A frame that is no picture is passed over.
        """
        picture = gray_picture(frame.image)
        if picture is None or not math.isfinite(frame.time):
            return None
        elapsed = frame.time - self._time
        self._time = frame.time
        if not 0 < elapsed <= MAX_GAP or picture.gray.shape != self._shape:
            self._lose()
            self._shape, self._checked = picture.gray.shape, -math.inf
        self._swing.fade(elapsed)
        if self._face is None:
            self._search(picture.gray)
        else:
            self._follow(picture.gray, self._face, elapsed)
        if self._face is None:
            return None
        box = _scaled(self._face, picture.scale)
        return HeadPose(frame.time, self._swing.pitch, self._swing.yaw, 0.0, box)

    def _search(self, gray: Gray) -> None:
        """Two findings at the same place make a face: a cascade alone errs now and then."""
        if self._time - self._checked < SEARCH_INTERVAL:
            return
        self._checked = self._time
        found, before = self._detector.largest(gray), self._candidate
        self._candidate = found
        if found is not None and before is not None and _overlap(found, before):
            self._face, self._confirmed = found, self._time
            self._flow.start(gray, found)

    def _follow(self, gray: Gray, face: FaceBox, elapsed: float) -> None:
        shift = self._flow.follow(gray)
        if shift is None:
            return self._lose()
        self._swing.move(shift, face.width, elapsed)
        self._face = replace(face, x=face.x + shift.x, y=face.y + shift.y)
        if self._time - self._checked >= CHECK_INTERVAL:
            self._check(gray, self._face)
        if self._time - self._confirmed > MAX_UNCONFIRMED:
            self._lose()

    def _check(self, gray: Gray, face: FaceBox) -> None:
        """Take the box anew, and with it the points; the angles go on without a jump."""
        self._checked = self._time
        found = self._detector.near(gray, face)
        if found is not None:
            self._face, self._confirmed = found, self._time
        self._flow.start(gray, self._face or face)

    def _lose(self) -> None:
        self._face = self._candidate = None
        self._swing.rest()


@dataclass
class Swinging:
    """Pitch and yaw of a head from the motion of its face, without the walk of the person."""

    pitch: float = 0.0
    yaw: float = 0.0
    _speed_x: float = 0.0
    _speed_y: float = 0.0
    _growth: float = 0.0

    def fade(self, elapsed: float) -> None:
        """Let the angles fall back as they do in so many seconds."""
        part = math.exp(-max(0.0, elapsed) / FADE)
        self.pitch *= part
        self.yaw *= part

    def move(self, shift: Shift, width: float, elapsed: float) -> None:
        """Take the motion of a face so many pixels wide."""
        x, y = shift.x / width, shift.y / width
        blend = min(1.0, elapsed / WALK_SMOOTHING)
        self._speed_x += (x / elapsed - self._speed_x) * blend
        self._speed_y += (y / elapsed - self._speed_y) * blend
        self._growth += (shift.growth / elapsed - self._growth) * blend
        speed = math.hypot(self._speed_x, self._speed_y)
        if speed < WALK_SPEED and abs(self._growth) < WALK_GROWTH:
            self.yaw = _clamped(self.yaw + x / RADIUS)
            self.pitch = _clamped(self.pitch + y / RADIUS)

    def rest(self) -> None:
        """Forget how fast the person was."""
        self._speed_x = self._speed_y = self._growth = 0.0


def _clamped(angle: float) -> float:
    return min(MAX_ANGLE, max(-MAX_ANGLE, angle))


def _scaled(box: FaceBox, scale: float) -> FaceBox:
    return FaceBox(box.x * scale, box.y * scale, box.width * scale, box.height * scale)


def _overlap(first: FaceBox, second: FaceBox) -> bool:
    """Whether the middle of one box lies well inside of the other, at about the same size."""
    away_x = abs(first.x + first.width / 2 - second.x - second.width / 2)
    away_y = abs(first.y + first.height / 2 - second.y - second.height / 2)
    reach = 0.4 * min(first.width, second.width)
    return max(away_x, away_y) < reach and 0.6 < first.width / second.width < 1.6
