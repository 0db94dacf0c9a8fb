"""Measures a face from its pixels, at 480x480: one pixel is one unit of a drawing that large.

Where to look is read from the drawing (the boxes of its parts, blended as they are shown), what is
there from the picture alone. Any face serves whose parts have the names of the default one:
irisLeft, scleraLeft, browLeft, lipUpper, lipLower, mouthLine, mouthDark. "Left" is the face's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.face import load_face
from hri.face.drawing.baking import Item, Shape
from hri.face.drawing.paint import Solid
from hri.face.model import FaceModel
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.face.vocabulary import MOTIONS, TURNS

SIZE = (480, 480)
MODEL = load_face("astronaut")

Pixels = NDArray[np.int_]
"""Shape [height, width, 3]."""
Where = NDArray[np.bool_]
"""Shape [height, width]."""
Box = tuple[int, int, int, int]
"""Left, top, right, bottom; right and bottom lie outside."""


@dataclass(frozen=True)
class Shot:
    """A picture of a face, and where its parts are in it."""

    model: FaceModel
    image: Image
    boxes: Mapping[str, Box]

    def at(self, *ids: str) -> Pixels:
        """The pixels of the box around parts."""
        low = np.min([self.boxes[id][:2] for id in ids], axis=0)
        right, bottom = np.max([self.boxes[id][2:] for id in ids], axis=0)
        return self.image[low[1] : bottom, low[0] : right].astype(int)

    @property
    def mouth(self) -> Pixels:
        return self.at("lipUpper", "lipLower", "mouthLine")

    @property
    def dark_mouth(self) -> int:
        """Pixels of the inside of the mouth; the line of the lips may be as dark."""
        away = _away(self.mouth, _colors(self.model, "mouthDark"))
        line = _away(self.mouth, _colors(self.model, "mouthLine"))
        return int(((away < 30) & (away < line)).sum())

    @property
    def teeth(self) -> int:
        """White pixels in the mouth."""
        mouth = self.mouth
        return int(((mouth.min(axis=2) > 205) & (np.ptp(mouth, axis=2) < 24)).sum())

    @property
    def _line(self) -> Where:
        """The dark line of the lips, without empty columns at its ends."""
        line = _near(self.mouth, _colors(self.model, "mouthLine"), 45)
        columns = np.flatnonzero(line.any(axis=0))
        return line[:, columns[0] : columns[-1] + 1]

    @property
    def mouth_width(self) -> int:
        """Pixels from corner to corner."""
        return self._line.shape[1]

    @property
    def corners_up(self) -> float:
        """How far the corners of the mouth lie above its middle, pixels."""
        line = self._line
        rows = np.arange(len(line))
        ends = [float(rows[line[:, x]].mean()) for x in (2, -3)]
        return float(np.argmax(line[:, line.shape[1] // 2])) - sum(ends) / 2

    @property
    def iris(self) -> int:
        """Pixels of the left iris that are seen."""
        return int(self._iris.sum())

    @property
    def iris_center(self) -> tuple[float, float]:
        """Where the left iris is in the picture, x and y."""
        left, top, *_ = self.boxes["eyeLeft"]
        ys, xs = np.nonzero(self._iris)
        return left + float(xs.mean()), top + float(ys.mean())

    @property
    def _iris(self) -> Where:
        return _near(self.at("eyeLeft"), _colors(self.model, "irisLeft"), 30)

    @property
    def lid_gap(self) -> int:
        """Rows of white between the lids of the left eye, beside its iris."""
        eye = self.at("eyeLeft")
        width = eye.shape[1]
        beside = eye[:, round(0.78 * width) : max(round(0.94 * width), 1)]
        return int(_is_white(beside).sum(axis=0).max(initial=0))

    @property
    def white_above_iris(self) -> int:
        """Rows of white between the upper lid and the left iris."""
        left, top, right, _ = self.boxes["irisLeft"]
        middle = (left + right) // 2
        above = self.image[self.boxes["eyeLeft"][1] : top + 3, middle : middle + 8].astype(int)
        return int(_is_white(above).all(axis=1).sum())

    @property
    def brow_slope(self) -> float:
        """By how many pixels the inner end of the left brow is lower than its outer end."""
        brow = _near(self.at("browLeft"), _colors(self.model, "browLeft"), 40)
        rows = np.arange(len(brow))[:, None]
        width = brow.shape[1] // 4
        inner, outer = brow[:, 2:width], brow[:, -width:-2]
        return float((rows * inner).sum() / inner.sum() - (rows * outer).sum() / outer.sum())


def face(
    expression: str = "neutral",
    intensity: float = 1.0,
    model: FaceModel = MODEL,
    weights: Mapping[str, float] | None = None,
    **settings: object,
) -> Shot:
    """The face with the head held still, so that pictures differ only by what the face does."""
    held = dict(weights or {})
    for motion in (*MOTIONS, *TURNS):
        held[motion] = held.get(motion, 0.0) - intensity * model.expressions[expression].get(
            motion, 0.0
        )
    held = {name: weight for name, weight in held.items() if name in model.names}
    vector = still_vector(model, expression, intensity, weights=held, **settings)  # type: ignore[arg-type]
    points, _ = model.blend(vector)
    scale = SIZE[0] / max(model.display.width, model.display.height)
    boxes = {id: _box(shape, scale * points) for id, shape in _shapes(model.display.items)}
    return Shot(model, _renderer(model).render(vector), boxes)


@cache
def _renderer(model: FaceModel) -> Renderer:
    return Renderer(model, SIZE)


def _shapes(items: tuple[Item, ...]) -> Iterator[tuple[str, Shape]]:
    """Shapes by id; what clips the left sclera is called eyeLeft."""
    for item in items:
        if isinstance(item, Shape):
            yield item.id, item
            continue
        content = dict(_shapes(item.content))
        yield from content.items()
        name = item.clip.id
        for side in ("Left", "Right"):
            if f"sclera{side}" in content:
                name = f"eye{side}"
        yield name, item.clip


def _box(shape: Shape, points: NDArray[np.floating]) -> Box:
    corners = np.concatenate([points[start:stop] for start, stop, _ in shape.contours])
    left, top = np.floor(corners.min(axis=0)).astype(int) - 2
    right, bottom = np.ceil(corners.max(axis=0)).astype(int) + 2
    return max(left, 0), max(top, 0), right, bottom


def _colors(model: FaceModel, id: str) -> NDArray[np.float64]:
    """The colors that a part is painted with, [n, 3]."""
    paint = _parts(model)[id].paint
    if isinstance(paint, Solid):
        return np.array([paint.color], float)
    stops = np.array([stop.color for stop in paint.stops], float)
    steps = np.linspace(0, 1, 4)[:, None]
    return np.concatenate([a + (b - a) * steps for a, b in pairwise(stops)])


@cache
def _parts(model: FaceModel) -> Mapping[str, Shape]:
    return dict(_shapes(model.display.items))


def _away(pixels: Pixels, colors: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each pixel is from the nearest of some colors."""
    return np.asarray(np.linalg.norm(pixels[:, :, None] - colors, axis=3).min(axis=2))


def _near(pixels: Pixels, colors: NDArray[np.float64], distance: float) -> Where:
    return np.asarray(_away(pixels, colors) < distance)


def _is_white(pixels: Pixels) -> Where:
    return np.asarray((pixels.min(axis=2) > 120) & (np.ptp(pixels, axis=2) < 30))
