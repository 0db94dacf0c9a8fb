"""Draws a laid-out network as PNG."""

from __future__ import annotations

import io
import math
from itertools import pairwise
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from hri.behavior.behavior import Behavior
from hri.behavior.network_layout import LINE, PADDING, TITLE, Layout, Node
from hri.behavior.network_svg import COLORS, FAINT, FONT, INK, curve, look_of, stroke_of
from hri.core.writing import write_bytes

SCALE = 2
"""Pixels of the picture per unit of the layout."""
FINER = 2
"""Supersampling factor, so that nearly level lines have no steps."""
MOST_PIXELS = 60_000_000
DASH = 5
"""Length of a dash, and of the gap behind it."""
STEPS = 24
"""Straight segments of a curve."""


def write_png(layout: Layout, out: Path) -> None:
    """Write the picture; a very large network is drawn smaller. Raises HriError."""
    area = layout.width * layout.height
    scale = min(FINER * SCALE, (MOST_PIXELS / area) ** 0.5)
    size = (round(layout.width * scale), round(layout.height * scale))
    image = Image.new("RGB", size, COLORS["paper"])
    pen = _Pen(ImageDraw.Draw(image), scale)
    for name, x, y in layout.headings:
        pen.text(x, y, name, "ls", INK)
    for wire in layout.wires:
        color, dashes = stroke_of(wire)
        for piece in curve(wire.points):
            pen.line(strokes(piece), color, is_dashed=bool(dashes))
    linked = {(wire.link.source, wire.link.output) for wire in layout.wires}
    linked |= {(wire.link.target, wire.link.input) for wire in layout.wires}
    for box in layout.boxes:
        _draw_box(pen, box, linked)
    picture = io.BytesIO()
    image.reduce(FINER).save(picture, "PNG")
    write_bytes(out, picture.getvalue())


def _evenly(points: list[tuple[float, float]], step: float) -> list[tuple[float, float]]:
    """Points along a line, a step apart."""
    found = points[:1]
    for (x0, y0), (x1, y1) in pairwise(points):
        count = max(1, round(math.dist((x0, y0), (x1, y1)) / step))
        found += [
            (x0 + (x1 - x0) * part / count, y0 + (y1 - y0) * part / count)
            for part in range(1, count + 1)
        ]
    return found


class _Pen:
    """Draws in the units of the layout."""

    def __init__(self, draw: ImageDraw.ImageDraw, scale: float) -> None:
        self.draw = draw
        self.scale = scale
        self.font = ImageFont.load_default(FONT * scale)

    def line(self, points: list[tuple[float, float]], color: str, is_dashed: bool = False) -> None:
        scaled = [(x * self.scale, y * self.scale) for x, y in points]
        thickness = round(1.8 * self.scale)
        if not is_dashed:
            self.draw.line(scaled, color, thickness, joint="curve")
        for pair in list(pairwise(_evenly(scaled, DASH * self.scale)))[::2] if is_dashed else ():
            self.draw.line(pair, color, thickness)

    def box(self, x: float, y: float, width: float, height: float, fill: str, line: str) -> None:
        corners = [v * self.scale for v in (x, y, x + width, y + height)]
        radius = 6 * self.scale
        self.draw.rounded_rectangle(corners, radius, fill, line, round(self.scale))

    def dot(self, x: float, y: float, color: str) -> None:
        self.draw.ellipse([v * self.scale for v in (x - 3, y - 3, x + 3, y + 3)], color)

    def text(self, x: float, y: float, text: str, anchor: str, color: str) -> None:
        position = (x * self.scale, y * self.scale)
        self.draw.text(position, text, color, self.font, anchor=anchor)


def strokes(piece: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    """The points of a segment of a curve."""
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = piece
    if y0 == y3:
        return [piece[0], piece[-1]]  # Rounding would break a level line into pieces.
    points = []
    for step in range(STEPS + 1):
        t = step / STEPS
        a, b, c, d = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
        points.append((a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3))
    return points


def _draw_box(pen: _Pen, box: Node, linked: set[tuple[Behavior, str]]) -> None:
    assert box.behavior is not None, "bends are not drawn"
    fill, line, dashes = look_of(box)
    pen.box(box.x, box.y, box.width, box.height, fill, fill if dashes else line)
    if dashes:
        right, low = box.x + box.width, box.y + box.height
        corners = [(box.x, box.y), (right, box.y), (right, low), (box.x, low), (box.x, box.y)]
        pen.line(corners, line, is_dashed=True)
    middle = box.x + box.width / 2
    pen.text(middle, box.y + 14, box.behavior.id, "mm", INK)
    pen.text(middle, box.y + 30, box.kind, "mm", FAINT)
    right = box.x + box.width
    sides = (
        (box.inputs, box.x, box.x + PADDING, "lm"),
        (box.outputs, right, right - PADDING, "rm"),
    )
    for names, edge, x, anchor in sides:
        for row, name in enumerate(names):
            color = INK if (box.behavior, name) in linked else FAINT
            y = box.y + TITLE + (row + 0.5) * LINE
            pen.dot(edge, y, color)
            pen.text(x, y, name, anchor, color)
