"""Pictures of printed markers: drawn as a pinhole camera sees them, before a photograph.

The paper is rendered with four times four samples a pixel, then blurred, put half into shadow,
given the noise of a camera and the losses of a JPEG. That proves nothing about creased paper, glare
and motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from hri.core.geometry import Matrix
from hri.core.signals import Image
from hri.vision.camera_view import CameraView
from hri.vision.markers.families import Family

SIZE = WIDTH, HEIGHT = 640, 480
FOCAL = CameraView().focal_length(SIZE)
SIDE = 0.1
"""Meters of the black square."""
SAMPLES = 4
"""Of a pixel, to each side."""
CELL = 16
"""Pixels of the drawing."""
PAPER, INK = 225.0, 25.0
NOISE, JPEG = 3.0, 85
SHADOW, SOFT = 0.35, 1.5
"""What is left of the light there, and how soft its edge is, pixels."""
EDGE = 12
"""Pixels that a marker keeps from the edge of the picture."""


@dataclass(frozen=True, slots=True)
class Condition:
    """How markers are shown."""

    pixels: float = 34.0
    """Side of a marker that faces the camera."""
    tilt: tuple[float, float] = (0.0, 0.0)
    """Degrees between its normal and the line of sight, from and to."""
    blur: float = 0.5
    """Standard deviation, pixels."""
    is_shaded: bool = False
    noise: float = NOISE


@dataclass(frozen=True, eq=False)
class Shown:
    """A picture with one marker, and where that is."""

    picture: Image
    id: int
    rotation: Matrix
    """Its columns are the marker's right, up and normal in the camera's axes: right, down, away."""
    place: Matrix
    """Of its center in the camera's axes, meters."""


def shown(
    family: Family, id: int, ground: Image, condition: Condition, draw: np.random.Generator
) -> Shown:
    """A marker somewhere in a picture."""
    rotation, place = _pose(condition, draw)
    picture = painted(ground, family.cells(id), rotation, place, condition, draw)
    return Shown(picture, id, rotation, place)


def painted(
    ground: Image,
    cells: Matrix,
    rotation: Matrix,
    place: Matrix,
    condition: Condition,
    draw: np.random.Generator,
) -> Image:
    """A marker in the light of a picture; `cells` with their white margin are 0 or 1."""
    count = len(cells) - 2
    look = np.asarray(np.kron(cells, np.ones((CELL, CELL))) * (PAPER - INK) + INK, np.float64)
    reach = SIDE / 2 * (count + 2) / count
    corners = np.array([(-1, 1, 0), (1, 1, 0), (1, -1, 0), (-1, -1, 0)]) * reach
    at = (rotation @ corners.T).T + place
    pixels = FOCAL * at[:, :2] / at[:, 2:] + [WIDTH / 2, HEIGHT / 2]
    picture = _covered(ground, look, np.asarray(pixels, np.float64))
    if condition.is_shaded:
        picture *= _shadow(pixels.mean(axis=0), draw)[..., None]
    if condition.blur:
        picture = np.asarray(cv2.GaussianBlur(picture, (0, 0), condition.blur), np.float64)
    picture = picture + draw.normal(0, condition.noise, picture.shape)
    clean = np.clip(picture, 0, 255).astype(np.uint8)
    _, packed = cv2.imencode(".jpg", clean[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, JPEG])
    opened = cv2.imdecode(packed, cv2.IMREAD_COLOR)
    assert opened is not None
    return np.asarray(opened[..., ::-1], np.uint8)


def _covered(ground: Image, look: Matrix, pixels: Matrix) -> Matrix:
    """A picture with a drawing in it whose corners are there."""
    low = np.maximum(np.floor(pixels.min(axis=0)).astype(int) - 1, 0)
    high = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 1, SIZE)
    part = slice(low[1], high[1]), slice(low[0], high[0])
    size = len(look)
    ends = np.array([(0, 0), (size, 0), (size, size), (0, size)], np.float32) - 0.5
    warp = cv2.getPerspectiveTransform(ends, ((pixels - low) * SAMPLES - 0.5).astype(np.float32))
    large = [int(side) for side in (high - low) * SAMPLES]
    ink, cover = (
        cv2.resize(
            cv2.warpPerspective(a, warp, large),
            None,
            fx=1 / SAMPLES,
            fy=1 / SAMPLES,
            interpolation=cv2.INTER_AREA,
        )[..., None]
        for a in (look.astype(np.float32), np.ones(look.shape, np.float32))
    )
    picture = ground.astype(np.float64)
    picture[part] = picture[part] * (1 - cover) + ink
    return picture


def _shadow(center: Matrix, draw: np.random.Generator) -> Matrix:
    """The light of each pixel when the edge of a shadow goes about through a place."""
    angle = draw.uniform(0, math.tau)
    rows, columns = np.mgrid[:HEIGHT, :WIDTH]
    across = (columns - center[0]) * math.cos(angle) + (rows - center[1]) * math.sin(angle)
    across += draw.uniform(-6, 6)
    light: Matrix = SHADOW + (1 - SHADOW) / (1 + np.exp(-across / SOFT))
    return light


def _pose(condition: Condition, draw: np.random.Generator) -> tuple[Matrix, Matrix]:
    away = FOCAL * SIDE / condition.pixels
    margin = EDGE + 0.9 * condition.pixels
    x, y = draw.uniform(margin, WIDTH - margin), draw.uniform(margin, HEIGHT - margin)
    line = np.array([(x - WIDTH / 2) / FOCAL, (y - HEIGHT / 2) / FOCAL, 1.0])
    unit = line / np.linalg.norm(line)
    tilt = math.radians(draw.uniform(*condition.tilt))
    aside = np.cross(unit, draw.normal(size=3))
    aside /= np.linalg.norm(aside)
    normal = -unit * math.cos(tilt) + aside * math.sin(tilt)
    up = np.cross(normal, [1.0, 0.0, 0.0])
    up /= np.linalg.norm(up)
    up = up if up[1] < 0 else -up  # the camera's second axis points down
    right = np.cross(up, normal)
    turn = draw.uniform(0, math.tau) if draw.random() < 0.5 else draw.normal(0, 0.2)
    across = right * math.cos(turn) + up * math.sin(turn)
    rotation = np.stack([across, np.cross(normal, across), normal], axis=1)
    return rotation, line * away


def grounds(pictures: Sequence[Image]) -> list[Image]:
    """Photographs in the size of the camera's."""
    return [
        np.asarray(cv2.resize(p, SIZE, interpolation=cv2.INTER_AREA), np.uint8) for p in pictures
    ]
