"""Measures the default face from its pixels, at 480x480: one pixel is one unit of the drawing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.face import load_face, render_face

SIZE = (480, 480)
MODEL = load_face("robot")

MOUTH = (slice(275, 372), slice(150, 330))
LEFT_EYE = (slice(150, 275), slice(250, 365))
LEFT_BROW = (slice(110, 190), slice(262, 346))


def face(expression: str = "neutral", intensity: float = 1.0, **settings: object) -> Image:
    """The face with the head held still, so that parts stay where they are measured."""
    weights = dict(settings.pop("weights", {}))  # type: ignore[call-overload]
    for motion in ("headX", "headY", "headRoll", "headSize"):
        weights[motion] = -intensity * MODEL.expressions[expression].get(motion, 0.0)
    return render_face(MODEL, expression, intensity, weights=weights, size=SIZE, **settings)  # type: ignore[arg-type]


def _near(image: Image, color: tuple[int, int, int], distance: float) -> NDArray[np.bool_]:
    return np.linalg.norm(image.astype(float) - color, axis=2) < distance


def dark_mouth(image: Image) -> int:
    """Pixels of the inside of the mouth."""
    inside = image[MOUTH].astype(int)
    return int(((inside.sum(axis=2) < 165) & (inside[..., 0] > inside[..., 1] + 20)).sum())


def teeth(image: Image) -> int:
    """White pixels in the mouth."""
    inside = image[MOUTH].astype(int)
    return int(((inside.min(axis=2) > 205) & (np.ptp(inside, axis=2) < 22)).sum())


def lip_line(image: Image) -> dict[str, float]:
    """Height of the dark line of the lips at the left and right end and in the middle, y down."""
    line = _near(image[MOUTH], (124, 47, 44), 45)
    columns = np.flatnonzero(line.any(axis=0))
    first, last = columns[0] + 3, columns[-1] - 3
    middle = (first + last) // 2
    top = {
        name: float(np.argmax(line[:, x]))
        for name, x in (("left", first), ("middle", middle), ("right", last))
    }
    return {**top, "width": float(last - first)}


def corners_up(image: Image) -> float:
    """How far the corners of the mouth lie above its middle, pixels."""
    line = lip_line(image)
    return line["middle"] - (line["left"] + line["right"]) / 2


def iris(image: Image) -> int:
    """Pixels of an iris that are seen."""
    eye = image[LEFT_EYE].astype(int)
    return int(((eye[..., 1] > eye[..., 0] + 30) & (eye[..., 2] > eye[..., 0] + 20)).sum())


def white_above_iris(image: Image) -> int:
    """Rows of white between upper lid and iris, in the middle of the eye."""
    column = image[LEFT_EYE][:, 50:62].astype(int)
    colored = ((column[..., 1] > column[..., 0] + 15) & (column[..., 0] < 80)).any(axis=1)
    above = column[: int(np.argmax(colored))]
    return int(((above.min(axis=2) > 140) & (np.ptp(above, axis=2) < 45)).all(axis=1).sum())


def iris_center(image: Image) -> tuple[float, float]:
    """Where the iris is in the picture of the eye."""
    eye = image[LEFT_EYE].astype(int)
    ys, xs = np.nonzero((eye[..., 1] > eye[..., 0] + 30) & (eye[..., 2] > eye[..., 0] + 20))
    return float(xs.mean()), float(ys.mean())


def lid_gap(image: Image) -> int:
    """Rows in which something of the iris or of the white is seen, in the middle of the eye."""
    column = image[LEFT_EYE][:, 50:62].astype(int)
    white = (column.min(axis=2) > 200) & (np.ptp(column, axis=2) < 18)
    colored = column[..., 1] > column[..., 0] + 15
    return int((white | colored).any(axis=1).sum())


def brow_slope(image: Image) -> float:
    """Of the brow on the right of the picture: above 0 when its inner end is the lower one."""
    brow = image[LEFT_BROW].astype(int)
    dark = (brow.sum(axis=2) < 330) & (brow[..., 0] > brow[..., 2])
    tops = np.argmax(dark, axis=0)
    return float(tops[16:26].mean() - tops[52:62].mean())
