"""A stage with scripted people, and detectors that know the script: the tracker's tests by heart.

Each person is a face on a colored body; who stands nearer covers whom they stand before. The mesh
takes whatever face is in the region it is given, as the real one does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from hri.core.signals import FaceBox, Frame, Image, Landmarks, People
from hri.vision.detectors.detector_choice import Detectors
from hri.vision.detectors.face import FoundFace
from hri.vision.detectors.mesh import FittedFace, Region
from hri.vision.detectors.search_squares import Square, whole
from hri.vision.head_pose import FACE, NUMBERS
from hri.vision.tracking.people import PeopleTracker

SIZE = (320, 240)
"""Pixels of the pictures."""


@dataclass(frozen=True)
class Spot:
    """Where a face is at a time: middle and height in pixels, how it is turned (radians)."""

    x: float
    y: float
    size: float = 50.0
    pitch: float = 0.0
    yaw: float = 0.0


Part = Callable[[float], Spot | None]
"""What somebody does: where they are at a time; None when they are not in the picture."""


@dataclass
class Player:
    part: Part
    skin: tuple[int, int, int] = (200, 150, 130)
    hair: tuple[int, int, int] = (60, 40, 30)
    shirt: tuple[int, int, int] = (40, 60, 160)


def standing(x: float = 160.0, y: float = 100.0, size: float = 50.0) -> Part:
    return lambda time: Spot(x, y, size)


def landmarks_at(spot: Spot) -> Landmarks:
    """A mesh of the average face, turned and placed; the chin and the rest form an oval."""
    steps = np.linspace(0, 2 * math.pi, 468, endpoint=False)
    mesh = np.stack([0.6 * np.cos(steps), 0.1 + 0.75 * np.sin(steps), 0 * steps - 0.3], axis=1)
    mesh[list(FEATURES)] = list(FEATURES.values())
    mesh[NUMBERS] = FACE
    cp, sp, cy, sy = (f(a) for a in (spot.pitch, spot.yaw) for f in (math.cos, math.sin))
    nod = np.array([[1, 0, 0], [0, cp, sp], [0, -sp, cp]])
    turn = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    turned = mesh @ (turn @ nod).T * (1, 1, -1) * spot.size / HEIGHT
    return (turned + np.array([spot.x, spot.y, 0.0])).astype(np.float32)


HEIGHT = 1.6
"""Of the mesh, in distances of the outer corners of the eyes."""
FEATURES = {
    152: (0.0, 0.85, 0.1),
    61: (-0.28, 0.55, 0.1),
    291: (0.28, 0.55, 0.1),
    0: (0.0, 0.50, 0.2),
    17: (0.0, 0.66, 0.2),
    105: (-0.36, -0.32, 0.1),
    334: (0.36, -0.32, 0.1),
    159: (-0.35, -0.13, 0.1),
    145: (-0.35, -0.05, 0.1),
    386: (0.35, -0.13, 0.1),
    374: (0.35, -0.05, 0.1),
}
"""Chin, mouth, brows and lids."""


@dataclass
class Stage:
    """Finder and mesh of the people on it; set `time` before they look."""

    players: Sequence[Player]
    time: float = 0.0
    has_mesh: bool = True
    searches: int = 0
    fits: int = 0
    phantoms: list[FaceBox] = field(default_factory=list)
    """What the finder takes for faces and the mesh does not."""

    def detectors(self) -> Detectors:
        return Detectors(self, self if self.has_mesh else None)  # type: ignore[arg-type]

    def squares(self, width: int, height: int) -> list[Square]:
        return [whole(width, height)]

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        self.searches += 1
        boxes = [_box(spot) for _, spot in self.on_view()] + self.phantoms
        return [FoundFace(box, 0.9) for box in boxes]

    def fit(self, image: Image, region: Region) -> FittedFace | None:
        self.fits += 1
        spots = [spot for _, spot in self.on_view()]
        away = [math.hypot(spot.x - region.x, spot.y - region.y) for spot in spots]
        nearest = int(np.argmin(away)) if away else -1
        if nearest < 0 or away[nearest] > 0.4 * region.side:
            return FittedFace(landmarks_at(Spot(region.x, region.y)), 0.1)
        return FittedFace(landmarks_at(spots[nearest]), 0.95)

    def on_view(self) -> list[tuple[Player, Spot]]:
        """Who can be seen: in the picture, and not behind a larger face."""
        spots = [(p, spot) for p in self.players if (spot := p.part(self.time)) is not None]
        inside = [(p, s) for p, s in spots if 0 <= s.x < SIZE[0] and 0 <= s.y < SIZE[1]]
        return [(p, s) for p, s in inside if not any(_covers(o, s) for _, o in inside)]

    def image(self) -> Image:
        picture = np.full((SIZE[1], SIZE[0], 3), 120, np.uint8)
        picture[::6, ::6] = 90
        spots = [(p, spot) for p in self.players if (spot := p.part(self.time)) is not None]
        for player, spot in sorted(spots, key=lambda pair: pair[1].size):
            _paint(picture, spot, 0.9, 0.62, 2.5, player.shirt)
            _paint(picture, spot, 0.38, -0.75, 0.0, player.hair)
            _paint(picture, spot, 0.36, -0.35, 0.5, player.skin)
            for eye in (-0.17, 0.17):
                _paint(
                    picture, Spot(spot.x + eye * spot.size, spot.y), 0.04, -0.14, -0.06, (9, 9, 9)
                )
        return picture

    def watch(
        self, tracker: PeopleTracker, duration: float, rate: float = 15.0, start: float = 0.0
    ) -> Iterator[People]:
        for index in range(round(duration * rate)):
            self.time = start + index / rate
            yield tracker.see(Frame(self.image(), self.time, index))


def _box(spot: Spot) -> FaceBox:
    return FaceBox(spot.x - spot.size / 2, spot.y - spot.size / 2, spot.size, spot.size)


def _covers(front: Spot, back: Spot) -> bool:
    away = math.hypot(front.x - back.x, front.y - back.y)
    return front.size > back.size and away < 0.55 * front.size


def _paint(
    picture: Image, spot: Spot, wide: float, top: float, bottom: float, color: tuple[int, int, int]
) -> None:
    left, right = (max(0, round(spot.x + side * wide * spot.size)) for side in (-1, 1))
    high, low = (max(0, round(spot.y + edge * spot.size)) for edge in (top, bottom))
    picture[high:low, left:right] = color
