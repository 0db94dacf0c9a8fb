"""The last ten minutes of what a robot felt, as an SVG drawing that is written again as it lives.

It is text, so that no drawing library has to run beside the robot; any browser shows it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from hri.core.signals import EmotionState
from hri.core.writing import PRIVATE, write_text

Moment = tuple[float, EmotionState]
"""A time in seconds and the feelings then."""

SPAN_S = 600.0
"""Seconds that the drawing shows."""
SHORTEST_S = 60.0
"""At the beginning of a run it shows no less."""
MOST_EMOTIONS = 6
"""Curves of emotions: those that were strongest in the span."""
FELT = 0.01
"""An emotion that stays below this intensity gets no curve."""

TITLE = "What the robot felt"
STEPS_S, MOST_TICKS = (10.0, 30.0, 60.0), 12
"""Seconds from one tick to the next: the first with which there are not more."""

_LEFT, _WIDTH, _RIGHT, _BOTTOM = 70, 800, 110, 500
_MOOD_TOP, _MOOD_HEIGHT = 80, 200
_FELT_TOP, _FELT_HEIGHT = 305, 160
_APART = 14.0
"""Between two labels, in units of the drawing."""
MOOD_COLORS = {"pleasure": "#2e8b57", "arousal": "#c46210", "dominance": "#6a5acd"}
_FIELDS = {"pleasure": "valence", "arousal": "arousal", "dominance": "dominance"}
"""What a state calls the axes of the mood."""
_COLORS = ("#1f6fb4", "#b22222", "#e0a000", "#8b4fa8", "#3aa6a6", "#777777")


@dataclass(frozen=True, slots=True)
class _Time:
    """The axis to the right."""

    end: float
    """Seconds."""
    span: float

    def x(self, time: float) -> float:
        """Where a time lies in the drawing."""
        return _LEFT + _WIDTH * (1 - (self.end - time) / self.span)


def feeling_plot(moments: Sequence[Moment]) -> str:
    """Mood, emotions and labels over the last ten minutes before the last of some moments.

    The moments are in order of time; none gives empty frames, few a shorter time, from a minute on.
    """
    end = moments[-1][0] if moments else 0.0
    shown = [moment for moment in moments if moment[0] >= end - SPAN_S]
    time = _Time(end, max(SHORTEST_S, end - shown[0][0] if shown else 0.0))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" font-family="sans-serif" font-size="11"'
        f' viewBox="0 0 {_LEFT + _WIDTH + _RIGHT} {_BOTTOM}">',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<text x="{_LEFT + _WIDTH / 2:.0f}" y="16" text-anchor="middle" font-size="13">{TITLE}'
        "</text>",
        *_ticks(time),
        *_mood(shown, time),
        *_felt(shown, time),
        *_labels(shown, time),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def write_feeling_plot(moments: Sequence[Moment], path: Path) -> None:
    """Put the drawing in the place of the one before. Raises HriError."""
    write_text(path, feeling_plot(moments), PRIVATE)


def _mood(moments: Sequence[Moment], axis: _Time) -> Iterable[str]:
    yield from _frame("mood", (-1, 0, 1), _MOOD_TOP, _MOOD_HEIGHT)
    for row, (name, color) in enumerate(MOOD_COLORS.items()):
        points = [
            (axis.x(time), _MOOD_TOP + _MOOD_HEIGHT * (1 - getattr(state, _FIELDS[name])) / 2)
            for time, state in moments
        ]
        yield from _curve(name, points, color, _MOOD_TOP, row)


def _felt(moments: Sequence[Moment], axis: _Time) -> Iterable[str]:
    yield from _frame("emotions", (0, 1), _FELT_TOP, _FELT_HEIGHT)
    for row, name in enumerate(_strongest(moments)):
        points = [
            (axis.x(time), _FELT_TOP + _FELT_HEIGHT * (1 - state.emotions.get(name, 0.0)))
            for time, state in moments
        ]
        yield from _curve(name, points, _COLORS[row], _FELT_TOP, row)


def _strongest(moments: Sequence[Moment]) -> list[str]:
    """Names of the emotions to draw, the strongest first."""
    peaks: dict[str, float] = {}
    for _, state in moments:
        for name, value in state.emotions.items():
            peaks[name] = max(peaks.get(name, 0.0), value)
    felt = [name for name, peak in peaks.items() if peak >= FELT]
    return sorted(felt, key=lambda name: -peaks[name])[:MOST_EMOTIONS]


def _labels(moments: Sequence[Moment], axis: _Time) -> Iterable[str]:
    """The label where it changed; one that would be written over another is left out."""
    before, y, free = "", _MOOD_TOP - 6, 0.0
    for time, state in moments:
        x = axis.x(time)
        if state.label != before and x >= free:
            yield (
                f'<text x="{x:.1f}" y="{y}" transform="rotate(-35 {x:.1f} {y})"'
                f' fill="#444">{escape(state.label)}</text>'
            )
            before, free = state.label, x + _APART


def _ticks(axis: _Time) -> Iterable[str]:
    """The time below the frames, and fine lines through them."""
    step = next(step for step in STEPS_S if axis.span <= MOST_TICKS * step)
    first = max(0, math.ceil((axis.end - axis.span) / step))
    for number in range(first, int(axis.end // step) + 1):
        x, seconds = axis.x(step * number), step * number
        for top, height in ((_MOOD_TOP, _MOOD_HEIGHT), (_FELT_TOP, _FELT_HEIGHT)):
            yield f'<path d="M{x:.1f} {top}v{height}" stroke="#eee"/>'
        yield (
            f'<text x="{x:.1f}" y="{_FELT_TOP + _FELT_HEIGHT + 16}"'
            f' text-anchor="middle" fill="#444">{_clock(round(seconds))}</text>'
        )


def _clock(seconds: int) -> str:
    """A time: "40 s", "1 min", "1:30 min"."""
    minutes, rest = divmod(seconds, 60)
    if not rest:
        return f"{minutes} min"
    return f"{minutes}:{rest:02} min" if minutes else f"{rest} s"


def _frame(title: str, values: tuple[int, ...], top: int, height: int) -> Iterable[str]:
    yield f'<text x="6" y="{top + height / 2:.0f}" fill="#444">{title}</text>'
    for value in values:
        y = top + height * (values[-1] - value) / (values[-1] - values[0])
        yield (
            f'<path d="M{_LEFT} {y:.0f}h{_WIDTH}" stroke="#ccc"/>'
            f'<text x="{_LEFT - 6}" y="{y + 4:.0f}" text-anchor="end" fill="#444">{value}</text>'
        )


def _curve(
    name: str, points: Sequence[tuple[float, float]], color: str, top: int, row: int
) -> Iterable[str]:
    """A line through points of the drawing, and its name beside the frame."""
    through = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    yield f'<polyline points="{through}" fill="none" stroke="{color}" stroke-width="1.5"/>'
    x, y = _LEFT + _WIDTH + 8, top + 14 * (row + 1)
    yield f'<text x="{x}" y="{y}" fill="{color}">{escape(name)}</text>'
