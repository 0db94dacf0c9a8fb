"""Outlines as cubic Bezier curves: path data and the simple shapes of SVG.

Everything becomes curves, straight lines too, so that a node that is straight in one drawing and
curved in another still morphs.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
"""Shape [n, 2]: x to the right, y down, in the units of the drawing."""

Matrix = NDArray[np.float64]
"""Shape [2, 3]: an affine transform."""

IDENTITY: Matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
FARTHEST = 1e5
"""No coordinate may lie farther out than this."""
MOST_NODES = 4000
"""No single path may have more."""

TO_CURVES = "turn it into nodes and curves (Inkscape: Path > Object to Path)"
"""The remedy for a shape that has none."""

_CIRCLE = 0.5522847498307936
"""Length of the handles of a quarter circle of radius 1 drawn as one cubic curve."""
_TOKEN = re.compile(
    r"\s*,?\s*(?:([A-Za-z])|([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?))|\s*(\S)\s*"
)
_COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2}


class OutlineError(ValueError):
    """An outline that cannot be used, with its fault and the remedy in the editor."""

    def __init__(self, what: str, remedy: str = "fix its numbers, or draw it again") -> None:
        super().__init__(what)
        self.remedy = remedy


@dataclass(frozen=True, eq=False)
class Contour:
    """One stroke of the pen."""

    curves: NDArray[np.float64]
    """Shape [n, 4, 2]: start, two handles, end; each starts where the one before ends."""
    is_closed: bool

    @property
    def nodes(self) -> int:
        """Nodes as an editor counts them."""
        return len(self.curves) + (not self.is_closed)


@dataclass(frozen=True, eq=False)
class Outline:
    """All contours of a shape."""

    contours: tuple[Contour, ...]

    @property
    def nodes(self) -> int:
        return sum(contour.nodes for contour in self.contours)

    @property
    def structure(self) -> tuple[tuple[int, bool], ...]:
        """What two drawings of a part must share: nodes and closedness of each contour."""
        return tuple((contour.nodes, contour.is_closed) for contour in self.contours)

    @property
    def points(self) -> Points:
        """All nodes and handles."""
        return np.concatenate([contour.curves.reshape(-1, 2) for contour in self.contours])

    def transformed(self, matrix: Matrix) -> Outline:
        return Outline(tuple(Contour(apply(matrix, c.curves), c.is_closed) for c in self.contours))


def apply(matrix: Matrix, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points [..., 2] under an affine transform."""
    return points @ matrix[:, :2].T + matrix[:, 2]


def compose(outer: Matrix, inner: Matrix) -> Matrix:
    """The transform that does `inner` first."""
    linear = outer[:, :2] @ inner[:, :2]
    return np.column_stack([linear, apply(outer, inner[:, 2])])


def ellipse(cx: float, cy: float, rx: float, ry: float) -> Outline:
    """An ellipse of four nodes."""
    k = _CIRCLE
    quarter = np.array([[1, 0], [1, k], [k, 1], [0, 1]])
    turn = np.array([[0, 1], [-1, 0]])
    curves = np.array([quarter @ np.linalg.matrix_power(turn, n) for n in range(4)])
    return Outline((Contour(curves * [rx, ry] + [cx, cy], True),))


def rectangle(x: float, y: float, width: float, height: float) -> Outline:
    """A rectangle of four nodes."""
    corners = np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])
    return polygon(corners, is_closed=True)


def polygon(corners: Points, is_closed: bool) -> Outline:
    """Straight lines through the corners."""
    ends = np.roll(corners, -1, axis=0) if is_closed else corners[1:]
    lines = [_straight(a, b) for a, b in zip(corners, ends, strict=False)]
    return Outline((Contour(np.array(lines), is_closed),))


def parse_path(data: str) -> Outline:
    """The outline of an SVG path. Raises OutlineError."""
    pen = _Pen()
    tokens = _tokens(data)
    at = 0
    command = ""
    while at < len(tokens):
        token = tokens[at]
        if isinstance(token, str):
            command, at = token, at + 1
            if command in "Zz":
                pen.close()
                continue
            if command in "Aa":
                raise OutlineError("it has an elliptical arc, which cannot morph", TO_CURVES)
            if command.upper() not in _COUNTS:
                raise OutlineError(f'"{command}" is not a path command')
        elif command in ("", "Z", "z"):
            raise OutlineError(f"the number {token:g} follows no command")
        count = _COUNTS[command.upper()]
        numbers = tokens[at : at + count]
        if len(numbers) < count or any(isinstance(number, str) for number in numbers):
            raise OutlineError(f'"{command}" needs {count} numbers')
        pen.draw(command, [float(number) for number in numbers])
        at += count
        command = {"M": "L", "m": "l"}.get(command, command)
    return pen.outline()


def _tokens(data: str) -> list[str | float]:
    found: list[str | float] = []
    for token in _TOKEN.finditer(data):
        letter, number, junk = token.groups()
        if junk:
            raise OutlineError(f'"{junk}" has no place in a path')
        if letter:
            found.append(letter)
            continue
        value = float(number)
        if not abs(value) <= FARTHEST:
            raise OutlineError(f"{number} lies outside of any picture")
        found.append(value)
        if len(found) > MOST_NODES * 6:
            raise _too_long()
    return found


def _too_long() -> OutlineError:
    remedy = "simplify it (Inkscape: Path > Simplify)"
    return OutlineError(f"it has more than {MOST_NODES} nodes", remedy)


def _straight(a: Points, b: Points) -> Points:
    return np.array([a, a + (b - a) / 3, b - (b - a) / 3, b])


class _Pen:
    """Draws path commands into contours."""

    def __init__(self) -> None:
        self.contours: list[Contour] = []
        self.curves: list[Points] = []
        self.here = np.zeros(2)
        self.start = np.zeros(2)
        self.handle = np.zeros(2)
        """The last handle, which S and T reflect."""
        self.last = ""
        self.count = 0

    def draw(self, command: str, numbers: list[float]) -> None:
        kind = command.upper()
        origin = self.here if command.islower() else np.zeros(2)
        if kind == "H":
            points = np.array([[numbers[0] + origin[0], self.here[1]]])
        elif kind == "V":
            points = np.array([[self.here[0], numbers[0] + origin[1]]])
        else:
            points = np.array(numbers).reshape(-1, 2) + origin
        if kind == "M":
            self._finish(False)
            self.here = self.start = points[0]
        else:
            if not self.contours and not self.curves and not self.last:
                raise OutlineError("it does not begin with M")
            self._add(_DRAW[kind](self, points))
        self.last = kind

    def close(self) -> None:
        if self.curves and np.abs(self.here - self.start).max() > 1e-3:
            self._add(_straight(self.here, self.start))
        self._finish(True)
        self.here = self.start
        self.last = "Z"

    def outline(self) -> Outline:
        self._finish(False)
        if not self.contours:
            raise OutlineError("it draws nothing", "draw it, or delete it")
        return Outline(tuple(self.contours))

    def line(self, points: Points) -> Points:
        return _straight(self.here, points[0])

    def cubic(self, points: Points) -> Points:
        self.handle = points[1]
        return np.array([self.here, *points])

    def smooth_cubic(self, points: Points) -> Points:
        return self.cubic(np.array([self._reflected("CS"), *points]))

    def quadratic(self, points: Points) -> Points:
        self.handle, end = points
        inner = (self.handle - self.here) * 2 / 3, (self.handle - end) * 2 / 3
        return np.array([self.here, self.here + inner[0], end + inner[1], end])

    def smooth_quadratic(self, points: Points) -> Points:
        return self.quadratic(np.array([self._reflected("QT"), points[0]]))

    def _reflected(self, kinds: str) -> Points:
        return 2 * self.here - self.handle if self.last and self.last in kinds else self.here

    def _add(self, curve: Points) -> None:
        self.count += 1
        if self.count > MOST_NODES:
            raise _too_long()
        if not np.all(np.abs(curve) <= FARTHEST):
            raise OutlineError("it leaves any picture")
        self.curves.append(curve)
        self.here = curve[3]

    def _finish(self, is_closed: bool) -> None:
        if self.curves:
            self.contours.append(Contour(np.array(self.curves), is_closed))
        self.curves = []


_DRAW: dict[str, Callable[[_Pen, Points], Points]] = {
    "L": _Pen.line,
    "H": _Pen.line,
    "V": _Pen.line,
    "C": _Pen.cubic,
    "S": _Pen.smooth_cubic,
    "Q": _Pen.quadratic,
    "T": _Pen.smooth_quadratic,
}

_TRANSFORM = re.compile(r"\s*,?\s*(\w+)\s*\(([^)]*)\)")


def parse_transform(text: str) -> Matrix:
    """An SVG transform. Raises ValueError that says what is wrong."""
    matrix = IDENTITY
    rest = _TRANSFORM.sub("", text).strip()
    if rest:
        raise ValueError(f'cannot read "{rest[:20]}"')
    for name, inside in _TRANSFORM.findall(text):
        try:
            numbers = [float(word) for word in inside.replace(",", " ").split()]
            step = _TRANSFORMS[name](*numbers)
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"cannot read {name}({inside})") from error
        if not np.all(np.abs(step) <= FARTHEST):
            raise ValueError(f"{name}({inside}) leaves any picture")
        matrix = compose(matrix, step)
    return matrix


def _matrix(
    a: float,
    b: float,
    c: float,
    d: float,
    e: float,
    f: float,
) -> Matrix:
    return np.array([[a, c, e], [b, d, f]])


def _rotate(degrees: float, x: float = 0.0, y: float = 0.0) -> Matrix:
    angle = math.radians(degrees)
    sine, cosine = math.sin(angle), math.cos(angle)
    return _matrix(
        cosine, sine, -sine, cosine, x - cosine * x + sine * y, y - sine * x - cosine * y
    )


def _scale(x: float, y: float | None = None) -> Matrix:
    return _matrix(x, 0, 0, x if y is None else y, 0, 0)


def _translate(x: float, y: float = 0.0) -> Matrix:
    return _matrix(1, 0, 0, 1, x, y)


_TRANSFORMS: dict[str, Callable[..., Matrix]] = {
    "matrix": _matrix,
    "rotate": _rotate,
    "scale": _scale,
    "translate": _translate,
}
