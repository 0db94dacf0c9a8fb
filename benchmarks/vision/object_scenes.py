"""Pictures of things in rooms, as a webcam sees them: tilted, blurred, with noise, or in motion.

The rooms are photographs, `../shared/vision/stills`, beside the project.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.vision.stamps import Stamp
from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.signals import Frame, Image
from hri.hal.drivers.still_image import read_still
from hri.vision.camera_view import CameraView

SIZE = 640, 480
VIEW = CameraView(1.05)
ROLL, TILT = math.radians(30), math.radians(35)
"""At most, to each side."""
LIGHT = 0.7, 1.15
LENS_BLUR, NOISE = 0.7, 6.0
"""Pixels, and levels of 255."""
SMEAR = 4
"""Pixels by which motion smears a picture, less than that."""
GLARE = 0.35
"""Of the thing's longer side in the picture, how far a lamp that it mirrors spreads."""


@dataclass(frozen=True, slots=True)
class Conditions:
    """What makes a thing hard to recognize; as it is, what is usual."""

    roll: float = ROLL
    """Radians to each side at most, as `tilt`."""
    tilt: float = TILT
    light: tuple[float, float] = LIGHT
    blur: float = 0.0
    """Pixels at most by which the lens is out of focus, beside what it always blurs."""
    noise: float = NOISE
    smear: int = 0
    """Motion smears it by less than this many pixels."""
    hidden: tuple[float, float] = (0.0, 0.0)
    """Part of the thing that something else covers, from one side; between these two."""
    glares: float = 0.0
    """How often it mirrors a lamp, of 1."""


STEADY = Conditions(light=(0.95, 1.05))
"""Of a film: exposure changes a little."""
TURNED, TURN_S, SWAY = math.radians(35), 5.0, 0.01
"""To each side, seconds of turning to and fro, and meters by which a hand sways."""
USUAL, MOVING = Conditions(), Conditions(smear=SMEAR)


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture with one thing in it."""

    stamp: Stamp
    image: Image
    x: float
    y: float
    """Where its center is, pixels."""
    distance: float
    """Meters from the camera to it, when it is `width` wide."""

    def shows(self, x: float, y: float) -> bool:
        """Whether a place that was found is this thing's."""
        return math.hypot(x - self.x, y - self.y) < 25


@lru_cache(maxsize=1)
def rooms() -> tuple[Image, ...]:
    """The photographs, uint8, each large enough for a picture. Raises NotAvailable."""
    folder = paths.house().parent / "shared" / "vision" / "stills"
    found = sorted((*folder.glob("*.jpg"), *folder.glob("*.png")))
    if not found:
        raise NotAvailable(f"no photographs at {folder} - they are not part of the project")
    return tuple(_large_enough(read_still(path).image) for path in found)


def _large_enough(image: Image) -> Image:
    scale = max((part + 60) / side for part, side in zip(SIZE, image.shape[1::-1], strict=True))
    return np.asarray(cv2.resize(image, None, fx=scale, fy=scale), np.uint8)


def by_height(
    stamp: Stamp, part: float, dice: np.random.Generator, conditions: Conditions = USUAL
) -> Scene:
    """A thing whose longer side is this part of the picture's height."""
    longer = max(stamp.picture.shape[:2])
    focal = VIEW.focal_length(SIZE)
    return _scene(stamp, focal / (part * SIZE[1]) * longer, 1.0, dice, conditions)


def by_distance(
    stamp: Stamp,
    meters: float,
    width: float,
    dice: np.random.Generator,
    conditions: Conditions = USUAL,
) -> Scene:
    """A thing of a width, meters, its longer side, this many meters away."""
    longer = max(stamp.picture.shape[:2])
    return _scene(stamp, meters / width * longer, width / longer, dice, conditions)


def _scene(
    stamp: Stamp, depth: float, scale: float, dice: np.random.Generator, conditions: Conditions
) -> Scene:
    """`depth` is in pixels of the thing's picture, `scale` meters to one of them."""
    focal = VIEW.focal_length(SIZE)
    reach = max(stamp.picture.shape[:2]) * focal / depth / 2
    x, y = (side / 2 + dice.uniform(-1, 1) * max(0.0, side / 2 - 1.25 * reach) for side in SIZE)
    homography, center = _seen_from(stamp, x, y, depth, dice, conditions)
    thing, mask = (_warped(each, homography) for each in (stamp.picture, stamp.mask))
    cover = mask[..., None] / np.float32(255)
    image: NDArray[np.floating] = _room(dice) * (1 - cover) + thing * cover
    if conditions.glares and dice.random() < conditions.glares:
        image += _glare(mask, reach, dice)[..., None]
    if max(conditions.hidden) > 0:
        image = _hidden(image, mask, dice.uniform(*conditions.hidden), dice)
    seen = _photographed(image, dice, conditions)
    return Scene(stamp, seen, x, y, float(np.linalg.norm(center)) * scale)


def _hidden(
    image: NDArray[np.floating], mask: Image, part: float, dice: np.random.Generator
) -> NDArray[np.floating]:
    """With a part of the thing behind something that comes in from one side."""
    ys, xs = np.nonzero(mask > 127)
    if not len(xs):
        return image
    toward = dice.uniform(0, math.tau)
    depths = xs * math.cos(toward) + ys * math.sin(toward)
    down, across = np.indices(mask.shape)
    limit = np.quantile(depths, 1 - part)
    behind = across * math.cos(toward) + down * math.sin(toward) > limit
    near = cv2.dilate(mask, np.ones((31, 31), np.uint8)) > 127
    return np.where((behind & near)[..., None], _room(dice).astype(np.float32), image)


def _glare(mask: Image, reach: float, dice: np.random.Generator) -> NDArray[np.floating]:
    """The light of a lamp that the thing mirrors."""
    ys, xs = np.nonzero(mask > 127)
    if not len(xs):
        return np.zeros(mask.shape)
    place = int(dice.integers(len(xs)))
    down, across = np.indices(mask.shape)
    away = np.hypot(across - xs[place], down - ys[place]) / (2 * reach * GLARE)
    return np.asarray(255 * np.exp(-(away**2)) * (mask > 127))


def _seen_from(
    stamp: Stamp,
    x: float,
    y: float,
    depth: float,
    dice: np.random.Generator,
    conditions: Conditions,
) -> tuple[NDArray[np.float64], NDArray[np.floating]]:
    """How its picture comes into the camera's, and where its center is, in its pixels."""
    focal, toward = VIEW.focal_length(SIZE), dice.uniform(0, math.tau)
    roll, _ = cv2.Rodrigues(np.array([0.0, 0.0, dice.uniform(-conditions.roll, conditions.roll)]))
    axis = np.array([math.cos(toward), math.sin(toward), 0.0])
    tilt, _ = cv2.Rodrigues(axis * dice.uniform(-conditions.tilt, conditions.tilt))
    turned = tilt @ roll
    middle = np.array([SIZE[0] / 2, SIZE[1] / 2])
    center = np.append((np.array([x, y]) - middle) / focal, 1.0) * depth
    return _placed(stamp, turned, center), center


def _placed(
    stamp: Stamp, turned: NDArray[np.floating], center: NDArray[np.floating]
) -> NDArray[np.float64]:
    """How its picture comes into the camera's, from a rotation and a place in its pixels."""
    height, width = stamp.picture.shape[:2]
    focal, middle = VIEW.focal_length(SIZE), (SIZE[0] / 2, SIZE[1] / 2)
    camera = np.array([[focal, 0, middle[0]], [0, focal, middle[1]], [0, 0, 1]])
    centered = np.array([[1, 0, -width / 2], [0, 1, -height / 2], [0, 0, 1]])
    return np.asarray(camera @ np.c_[turned[:, 0], turned[:, 1], center] @ centered)


def _warped(image: Image, homography: NDArray[np.float64]) -> Image:
    """Drawn at twice the size and averaged, as a pixel of a camera averages."""
    double = np.diag((2.0, 2.0, 1.0)) @ homography
    large = cv2.warpPerspective(image, double, (2 * SIZE[0], 2 * SIZE[1]))
    return np.asarray(cv2.resize(large, SIZE, interpolation=cv2.INTER_AREA), np.uint8)


def _room(dice: np.random.Generator) -> Image:
    room = rooms()[dice.integers(len(rooms()))]
    top, left = (
        dice.integers(have - want + 1)
        for have, want in zip(room.shape[:2], SIZE[::-1], strict=True)
    )
    return room[top : top + SIZE[1], left : left + SIZE[0]]


def _photographed(
    image: NDArray[np.floating], dice: np.random.Generator, conditions: Conditions
) -> Image:
    """With the light, the blur, and the noise of a webcam."""
    length, toward = int(dice.integers(max(1, conditions.smear))), dice.uniform(0, math.tau)
    kernel = np.zeros((7, 7), np.float32)
    end = 3 + length * math.cos(toward), 3 + length * math.sin(toward)
    cv2.line(kernel, (3, 3), (int(end[0]), int(end[1])), 1.0)
    seen = cv2.filter2D(image * dice.uniform(*conditions.light), -1, kernel / kernel.sum())
    blur = LENS_BLUR + (dice.uniform(0, conditions.blur) if conditions.blur else 0.0)
    seen = cv2.GaussianBlur(seen, (0, 0), blur) + dice.normal(0, conditions.noise, seen.shape)
    return np.asarray(np.clip(seen, 0, 255), np.uint8)


def turned_before_room(
    stamp: Stamp,
    meters: float,
    width: float,
    seconds: float,
    every: float,
    dice: np.random.Generator,
) -> Iterator[Image]:
    """A film of a thing that is turned to and fro before a room that stands still."""
    room = _room(dice).astype(np.float32)
    scale = width / max(stamp.picture.shape[:2])
    start = dice.uniform(0, math.tau)
    for time in np.arange(0, seconds, every).tolist():
        yaw, roll = TURNED * math.sin(time * math.tau / TURN_S + start), 0.1 * math.sin(1.3 * time)
        turned = cv2.Rodrigues(np.array([0, yaw, 0]))[0] @ cv2.Rodrigues(np.array([0, 0, roll]))[0]
        center = (
            np.array([SWAY * math.sin(2.1 * time), SWAY * math.cos(1.7 * time), meters]) / scale
        )
        homography = _placed(stamp, turned, center)
        thing, mask = (_warped(each, homography) for each in (stamp.picture, stamp.mask))
        cover = mask[..., None] / np.float32(255)
        yield _photographed(room * (1 - cover) + thing * cover, dice, STEADY)


def empty_room(seconds: float, every: float, dice: np.random.Generator) -> Iterator[Image]:
    """A film of a room in which nothing moves."""
    room = _room(dice).astype(np.float32)
    for _ in np.arange(0, seconds, every):
        yield _photographed(room, dice, STEADY)


def film(
    stamps: list[Stamp], seconds: float, rate: float, dice: np.random.Generator
) -> Iterator[Frame]:
    """Room after room of ten seconds; in every other one things are held up, each for a second."""
    for number in range(round(seconds * rate)):
        time = number / rate
        if int(time / 10) % 2 or not stamps:
            image = _photographed(_room(dice).astype(np.float32), dice, MOVING)
        else:
            stamp = stamps[int(time) % len(stamps)]
            image = by_height(stamp, dice.uniform(0.2, 0.6), dice, MOVING).image
        yield Frame(image, time, number)
