"""The figure of how feelings are heard: a panel for each measure, a row for each emotion.

python -m benchmarks.speech.feelings_figure docs/feelings.svg
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from html import escape
from pathlib import Path

from benchmarks.speech.feelings import MEASURES, PUBLISHED, differences
from hri.core.writing import write_text

INTENSITIES = (0.25, 0.5, 0.75, 1.0)
UNITS = {
    "pitch": ("pitch, semitones", 12.0, 4.0),
    "range": ("pitch range, octaves", 1.0, 0.8),
    "rate": ("rate, octaves", 1.0, 0.6),
    "loudness": ("loudness, dB", 1.0, 3.0),
}
"""Of each measure: its title, what one of its unit is in the figure's, and the end of its axis."""
LEFT, TOP, WIDTH, ROW, GAP = 90, 48, 150, 26, 52
INK, FAINT = "#222", "#ddd"
ARROWS = {
    1: ("#c2410c", "M-5 4L0 -4L5 4"),
    -1: ("#1d4ed8", "M-5 -4L0 4L5 -4"),
    0: ("#666", "M-5 0L5 0"),
}
"""The color and the mark of a direction; a line where the sources differ."""

Measured = Mapping[float, Mapping[str, Mapping[str, float]]]
"""What is heard, by intensity, emotion and measure."""


def drawn(heard: Measured) -> str:
    """The figure as SVG: dots for rising intensity, an arrow for each published direction."""
    emotions = list(next(iter(heard.values())))
    width = LEFT + len(UNITS) * (WIDTH + GAP)
    height = TOP + len(emotions) * ROW + 30
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        f'font-family="sans-serif" font-size="13" fill="{INK}">',
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        *(_text(LEFT - 8, _y(row), name, "end") for row, name in enumerate(emotions)),
    ]
    for number, measure in enumerate(UNITS):
        parts += _panel(LEFT + number * (WIDTH + GAP), measure, heard, emotions)
    return "\n".join([*parts, "</svg>", ""])


def _panel(left: float, measure: str, heard: Measured, emotions: list[str]) -> list[str]:
    title, unit, end = UNITS[measure]
    middle, bottom = left + WIDTH / 2, _y(len(emotions)) - ROW / 2
    parts = [_text(middle, 24, title, "middle")]
    for share, label in ((-1, f"-{end:g}"), (0, "0"), (1, f"+{end:g}")):
        x = middle + share * WIDTH / 2
        parts.append(f'<path d="M{x:g} {TOP - 8}V{bottom:g}" stroke="{FAINT}"/>')
        parts.append(_text(x, bottom + 16, label, "middle"))
    for row, name in enumerate(emotions):
        direction = PUBLISHED[name][MEASURES.index(measure)]
        color, arrow = ARROWS[direction]
        place = f"translate({left + WIDTH + 14} {_y(row):g})"
        parts.append(f'<path d="{arrow}" transform="{place}" fill="none" stroke="{color}"/>')
        for intensity, found in heard.items():
            x = middle + found[name][measure] * unit / end * WIDTH / 2
            parts.append(
                f'<circle cx="{x:.1f}" cy="{_y(row):g}" r="4" fill="{color}" '
                f'fill-opacity="{0.2 + 0.8 * intensity:g}"/>'
            )
    return parts


def _y(row: int) -> float:
    return TOP + (row + 0.5) * ROW


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:g}" y="{y + 4:g}" text-anchor="{anchor}">{escape(text)}</text>'


if __name__ == "__main__":
    write_text(Path(sys.argv[1]), drawn({share: differences(share) for share in INTENSITIES}))
