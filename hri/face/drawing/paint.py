"""What shapes are filled with: plain colors and gradients."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from hri.core.errors import did_you_mean
from hri.core.xml import Element
from hri.face.drawing.outline import (
    FARTHEST,
    Matrix,
    Outline,
    Points,
    apply,
    compose,
    parse_transform,
)

Color = tuple[int, int, int]
"""Red, green, blue, 0 to 255."""

MOST_STOPS = 32
"""No gradient has more."""
NAMED: dict[str, Color] = {"black": (0, 0, 0), "white": (255, 255, 255)}


@dataclass(frozen=True)
class Solid:
    """One color."""

    color: Color
    opacity: float = 1.0


@dataclass(frozen=True)
class Stop:
    """A color on the way of a gradient."""

    offset: float
    """0 to 1."""
    color: Color
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Gradient:
    """Colors along a line (two anchors: start, end) or outward (three: center and two radii)."""

    anchors: Points
    """Shape [2, 2], or [3, 2] for a radial gradient: center, end of either half-axis."""
    stops: tuple[Stop, ...]

    @property
    def is_radial(self) -> bool:
        return len(self.anchors) == 3


Paint = Solid | Gradient


def parse_color(text: str) -> Solid:
    """#rgb, #rrggbb, rgb(r, g, b), black or white. Raises ValueError for anything else."""
    text = text.strip().lower()
    if text in NAMED:
        return Solid(NAMED[text])
    if re.fullmatch(r"#[0-9a-f]{3}", text):
        text = "#" + "".join(digit * 2 for digit in text[1:])
    if re.fullmatch(r"#[0-9a-f]{6}", text):
        red, green, blue = bytes.fromhex(text[1:])
        return Solid((red, green, blue))
    match = re.fullmatch(r"rgb\(\s*(\d+)[\s,]+(\d+)[\s,]+(\d+)\s*\)", text)
    if match and all(int(value) <= 255 for value in match.groups()):
        return Solid((int(match[1]), int(match[2]), int(match[3])))
    raise ValueError(f'"{text}" is not a color')


def read_gradient(
    element: Element, stops: Element, opacity: float, outline: Outline, matrix: Matrix
) -> Gradient:
    """A gradient element with the stops of the element it may borrow them from.

    `outline` is what it fills and `matrix` the transform of that shape. Raises AuthoringError.
    """
    kind = element.tag.removeprefix("svg:")
    if kind not in ("linearGradient", "radialGradient"):
        what = f'"{element.get("id")}" is a <{kind}>'
        raise element.error(what, "fill with a color, a linear or a radial gradient")
    if element.get("spreadMethod", "pad") != "pad":
        raise element.error("spreadMethod is not supported", "take it off", "spreadMethod")
    frame = _frame(element, outline, matrix)
    anchors = _linear(element) if kind == "linearGradient" else _radial(element)
    drawn = [child for child in stops if _is_stop(child)]
    if len(drawn) > MOST_STOPS:
        raise element.error(f"the gradient has {len(drawn)} stops", f"keep to {MOST_STOPS}")
    found = tuple(_stop(child, opacity) for child in drawn)
    if not found:
        raise element.error("the gradient has no stops", "add two <stop> to it")
    placed = apply(frame, anchors) if kind == "radialGradient" else _upright(anchors, frame)
    if not np.all(np.abs(placed) <= 10 * FARTHEST):
        raise element.error("the gradient lies outside of any picture", "draw it again")
    return Gradient(placed, found)


def _is_stop(element: Element) -> bool:
    return element.tag.removeprefix("svg:") == "stop"


def _frame(element: Element, outline: Outline, matrix: Matrix) -> Matrix:
    """The transform from the gradient's own coordinates to those of the drawing."""
    try:
        own = parse_transform(element.get("gradientTransform", ""))
    except ValueError as error:
        remedy = "write translate, scale, rotate or matrix"
        raise element.error(str(error), remedy, "gradientTransform") from error
    units = element.get("gradientUnits", "objectBoundingBox")
    if units == "userSpaceOnUse":
        return compose(matrix, own)
    if units != "objectBoundingBox":
        remedy = did_you_mean(units, ("userSpaceOnUse", "objectBoundingBox"))
        raise element.error(f'gradientUnits is "{units}"', remedy, "gradientUnits")
    low, high = outline.points.min(axis=0), outline.points.max(axis=0)
    box = np.column_stack([np.diag(np.maximum(high - low, 1e-3)), low])
    return compose(box, own)


def _linear(element: Element) -> Points:
    x1, y1, x2, y2 = (_length(element, name, default) for name, default in _LINE.items())
    return np.array([[x1, y1], [x2, y2]])


def _radial(element: Element) -> Points:
    cx, cy, radius = (_length(element, name, "50%") for name in ("cx", "cy", "r"))
    for focus, center in (("fx", cx), ("fy", cy)):
        if focus in element.attributes and abs(_length(element, focus, "0") - center) > 0.01:
            remedy = "move it onto the center"
            raise element.error("a focus beside the center is not supported", remedy, focus)
    return np.array([[cx, cy], [cx + radius, cy], [cx, cy + radius]])


_LINE = {"x1": "0%", "y1": "0%", "x2": "100%", "y2": "0%"}


def _length(element: Element, name: str, default: str) -> float:
    text = element.get(name, default)
    is_percent = text.endswith("%")
    if is_percent and element.get("gradientUnits", "objectBoundingBox") == "userSpaceOnUse":
        raise element.error(f"{name} is {text}", "write it in the units of the drawing", name)
    try:
        value = float(text[:-1]) / 100 if is_percent else float(text)
    except ValueError:
        value = np.inf
    if not abs(value) <= FARTHEST:
        raise element.error(f'{name} is "{text}"', "write a number", name)
    return value


def _upright(anchors: Points, frame: Matrix) -> Points:
    """Start and end of a line of colors after a transform that may shear it."""
    start, end = anchors
    along = end - start
    linear = frame[:, :2]
    if not along.any() or abs(np.linalg.det(linear)) < 1e-12:
        return apply(frame, anchors)
    slope = np.linalg.solve(linear.T, along) / (along @ along)
    begin = apply(frame, start)
    return np.array([begin, begin + slope / (slope @ slope)])


def _stop(element: Element, opacity: float) -> Stop:
    values = dict(element.attributes)
    for entry in element.get("style", "").split(";"):
        name, _, value = entry.partition(":")
        values[name.strip()] = value.strip()
    try:
        color = parse_color(values.get("stop-color", "#000000")).color
        offset = _fraction(values.get("offset", "0"))
        own = _fraction(values.get("stop-opacity", "1"))
    except ValueError as error:
        raise element.error(f"stop: {error}", "write a color and numbers from 0 to 1") from error
    return Stop(offset, color, own * opacity)


def _fraction(text: str) -> float:
    value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    if not 0 <= value <= 1:
        raise ValueError(f"{text} is not between 0 and 1")
    return value
