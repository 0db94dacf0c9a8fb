"""Draws a laid-out network as SVG."""

from __future__ import annotations

import zlib
from html import escape
from itertools import pairwise

from hri.behavior.behavior import Behavior
from hri.behavior.board import BoardSink, BoardSource
from hri.behavior.network_layout import LINE, PADDING, TITLE, Layout, Node, Wire

FONT = 12
COLORS = {
    "paper": "#ffffff",
    "box": "#f4f6f8",
    "edge": "#5b6770",
    "sensor": "#e6f2ea",
    "board": "#fbf3dc",
}
INK = "#1d252b"
FAINT = "#9aa5ad"
WIRES = ("#2f6fb3", "#b5562b", "#3c8a4e", "#8a4fa3", "#a3343f", "#4a7d86", "#8a7420")
"""A wire's color is that of its datatype."""


SHADES = {
    "added": ("#d9f2dd", "#1a7f37", ""),
    "removed": ("#fbe3e1", "#b3261e", "6 4"),
    "changed": ("#fff1cc", "#9a6700", ""),
    "same": ("#f4f6f8", "#a8b1b8", ""),
}
"""In a comparison, by what became of a part: its fill, its line, and the dashes of that."""


def stroke_of(wire: Wire) -> tuple[str, str]:
    """The color of a wire, and its dashes."""
    if wire.shade:
        _, line, dashes = SHADES[wire.shade]
        return line, dashes
    return wire_color(wire.link.datatype), ""


def look_of(box: Node) -> tuple[str, str, str]:
    """The fill of a box, its line, and the dashes of that."""
    assert box.behavior is not None, "bends are not drawn"
    return SHADES[box.shade] if box.shade else (fill_of(box.behavior), COLORS["edge"], "")


def wire_color(datatype: str) -> str:
    """Always the same color for a datatype."""
    return WIRES[zlib.crc32(datatype.encode()) % len(WIRES)]


def fill_of(behavior: Behavior) -> str:
    """The color of a box."""
    if isinstance(behavior, BoardSource | BoardSink):
        return COLORS["board"]
    return COLORS["sensor" if behavior.is_sensor else "box"]


def curve(points: list[tuple[float, float]]) -> list[tuple[tuple[float, float], ...]]:
    """Cubic Bezier pieces (start, two controls, end) that leave and enter each point level."""
    pieces: list[tuple[tuple[float, float], ...]] = []
    for (x0, y0), (x1, y1) in pairwise(points):
        middle = (x0 + x1) / 2
        pieces.append(((x0, y0), (middle, y0), (middle, y1), (x1, y1)))
    return pieces


def to_svg(layout: Layout) -> str:
    """The drawing as the text of an SVG file."""
    width, height = f"{layout.width:.0f}", f"{layout.height:.0f}"
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
        f' viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="{FONT}">',
        f'<rect width="{width}" height="{height}" fill="{COLORS["paper"]}"/>',
    ]
    lines.extend(_text(x, y, name, "start", INK, "bold") for name, x, y in layout.headings)
    lines.extend(_wire(wire) for wire in layout.wires)
    linked = {(wire.link.source, wire.link.output) for wire in layout.wires}
    linked |= {(wire.link.target, wire.link.input) for wire in layout.wires}
    for box in layout.boxes:
        lines.extend(_box(box, linked))
    return "\n".join([*lines, "</svg>", ""])


def _wire(wire: Wire) -> str:
    (x, y), *_ = wire.points
    path = f"M{x:.1f},{y:.1f}" + "".join(
        "C" + " ".join(f"{px:.1f},{py:.1f}" for px, py in piece[1:]) for piece in curve(wire.points)
    )
    color, dashes = stroke_of(wire)
    title = f"<title>{escape(str(wire.link))}</title>"
    stroke = f'stroke="{color}" stroke-width="1.8"{_dashed(dashes)}'
    return f'<path d="{path}" fill="none" {stroke}>{title}</path>'


def _dashed(dashes: str) -> str:
    return f' stroke-dasharray="{dashes}"' if dashes else ""


def _box(box: Node, linked: set[tuple[Behavior, str]]) -> list[str]:
    assert box.behavior is not None, "bends are not drawn"
    fill, line, dashes = look_of(box)
    left, top = box.x, box.y
    lines = [
        f'<rect x="{left:.1f}" y="{top:.1f}" width="{box.width:.1f}" height="{box.height:.1f}"'
        f' rx="6" fill="{fill}" stroke="{line}"{_dashed(dashes)}/>',
        _text(left + box.width / 2, top + 18, box.behavior.id, "middle", INK, "bold"),
        _text(left + box.width / 2, top + 33, box.kind, "middle", FAINT),
    ]
    sides = (
        (box.inputs, left, left + PADDING, "start"),
        (box.outputs, left + box.width, left + box.width - PADDING, "end"),
    )
    for names, edge, x, anchor in sides:
        for row, name in enumerate(names):
            color = INK if (box.behavior, name) in linked else FAINT
            y = top + TITLE + (row + 0.5) * LINE
            lines.append(f'<circle cx="{edge:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>')
            lines.append(_text(x, y + 4, name, anchor, color))
    return lines


def _text(x: float, y: float, text: str, anchor: str, color: str, weight: str = "normal") -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}"'
        f' font-weight="{weight}">{escape(text)}</text>'
    )
