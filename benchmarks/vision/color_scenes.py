"""Colored balls in rooms, in the light in which they were learned and in others.

The rooms are photographs, `../shared/vision/stills`, beside the project.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still
from hri.vision.color.color_model import Box, ColorModel, learn_color

SIZE = 640, 480
COLORS = {
    "orange": (235, 120, 25),
    "magenta": (205, 40, 130),
    "green": (40, 165, 70),
    "blue": (40, 80, 200),
}
RADIUS = 32, 48
"""Pixels, of a ball."""
NOISE = 3.0
"""Levels of 255, of the camera, whatever the light."""
AMBIENT = 0.45
"""Part of the light that comes from everywhere, and so reaches the shaded side of a ball."""
LAMP = np.array([-0.45, -0.6, 0.66])
"""Where the lamp is: at the upper left, before the ball."""
SHININESS, SHINE = 20.0, 0.8
"""Of Phong's highlight."""
LEARNED_IN = (1.0, 0.7)
"""Light of the pictures that a color is learned from."""

Light = Callable[[NDArray[np.float64]], NDArray[np.float64]]
"""What it makes of a picture, 0 to 255."""


def _tint(red: float, green: float, blue: float) -> Light:
    return lambda image: image * np.array([red, green, blue])


LIGHTS: dict[str, Light] = {
    "the same": _tint(1, 1, 1),
    "gain 1.4": _tint(1.4, 1.4, 1.4),
    "mild warm": _tint(1.1, 1.0, 0.85),
    "strong warm": _tint(1.25, 1.0, 0.65),
    "mild cold": _tint(0.88, 1.0, 1.1),
    "strong cold": _tint(0.7, 0.95, 1.25),
    "half": _tint(0.5, 0.5, 0.5),
    "gamma 1.8": lambda image: 255 * (image / 255) ** 1.8,
    "0.3": _tint(0.3, 0.3, 0.3),
}


@dataclass(frozen=True, slots=True)
class Ball:
    """Where a ball is in a picture, pixels."""

    color: str
    x: int
    y: int
    radius: int

    def shows(self, x: float, y: float) -> bool:
        """Whether a place is on the ball."""
        return math.hypot(x - self.x, y - self.y) < self.radius


@dataclass(frozen=True, slots=True)
class ColorScene:
    """A picture of a room with a ball of each color."""

    image: Image
    balls: tuple[Ball, ...]


@lru_cache(maxsize=1)
def rooms() -> dict[str, Image]:
    """The photographs by name, each of `SIZE`. Raises NotAvailable."""
    folder = paths.house().parent / "shared" / "vision" / "stills"
    found = sorted((*folder.glob("*.jpg"), *folder.glob("*.png")))
    if not found:
        raise NotAvailable(f"no photographs at {folder} - they are not part of the project")
    return {path.stem: _filling(read_still(path).image) for path in found}


def _filling(image: Image) -> Image:
    """Its middle, large enough for a picture."""
    scale = max(part / side for part, side in zip(SIZE, image.shape[1::-1], strict=True))
    large = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    top, left = (large.shape[0] - SIZE[1]) // 2, (large.shape[1] - SIZE[0]) // 2
    return np.asarray(large[top : top + SIZE[1], left : left + SIZE[0]], np.uint8)


def photographed(room: Image, light: Light, dice: np.random.Generator) -> Image:
    """A room in a light, with the noise of a camera."""
    lit = light(room.astype(np.float64)) + dice.normal(0, NOISE, room.shape)
    return np.asarray(np.clip(np.rint(lit), 0, 255), np.uint8)


def scene(room: Image, light: Light, dice: np.random.Generator) -> ColorScene:
    """A room with a ball of each color, each in its quarter of the picture."""
    image, balls = room.astype(np.float64), []
    quarters = dice.permutation(4)
    for quarter, (color, albedo) in zip(quarters, COLORS.items(), strict=True):
        radius = int(dice.integers(*RADIUS))
        column, row = quarter % 2, quarter // 2
        x = int(dice.integers(radius + 10, SIZE[0] // 2 - radius - 10)) + column * SIZE[0] // 2
        y = int(dice.integers(radius + 10, SIZE[1] // 2 - radius - 10)) + row * SIZE[1] // 2
        balls.append(Ball(color, x, y, radius))
        _draw(image, balls[-1], np.array(albedo, float))
    return ColorScene(photographed(np.asarray(image), light, dice), tuple(balls))


def _draw(image: NDArray[np.float64], ball: Ball, albedo: NDArray[np.float64]) -> None:
    """Shaded as Lambert's law has it, with a highlight of Phong's."""
    y, x = np.mgrid[: image.shape[0], : image.shape[1]]
    across, down = (x - ball.x) / ball.radius, (y - ball.y) / ball.radius
    beyond = np.hypot(across, down)
    normal = np.dstack([across, down, np.sqrt(np.clip(1 - beyond**2, 0, 1))])
    lamp = LAMP / np.linalg.norm(LAMP)
    facing = np.clip(normal @ lamp, 0, 1)
    mirrored = np.clip((2 * facing[..., None] * normal - lamp)[..., 2], 0, 1)
    shaded = albedo * (AMBIENT + (1 - AMBIENT) * facing)[..., None]
    shaded = shaded + 255 * SHINE * (mirrored**SHININESS)[..., None] * (facing > 0)[..., None]
    cover = np.clip((1 - beyond) * ball.radius + 0.5, 0, 1)[..., None]
    image[:] = image * (1 - cover) + np.minimum(shaded, 255) * cover


def learned(names: tuple[str, str], seed: int) -> dict[str, ColorModel]:
    """The colors as boxes in two rooms teach them, in full and in weaker light."""
    dice = np.random.default_rng(seed)
    scenes = [
        scene(rooms()[name], _tint(gain, gain, gain), dice)
        for name, gain in zip(names, LEARNED_IN, strict=True)
    ]
    return {
        color: learn_color(color, [(one.image, [_box(one, color)]) for one in scenes])
        for color in COLORS
    }


def _box(made: ColorScene, color: str) -> Box:
    """As a person draws it: well within the ball."""
    ball = next(one for one in made.balls if one.color == color)
    half = round(0.6 * ball.radius)
    return ball.x - half, ball.y - half, 2 * half, 2 * half


def scenes(names: Iterable[str], light: Light, seed: int) -> Iterator[ColorScene]:
    """A scene of each room."""
    dice = np.random.default_rng(seed)
    for name in names:
        yield scene(rooms()[name], light, dice)
