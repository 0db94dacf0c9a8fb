"""The plot of a visit over time: heard, said, seen, mood, speed."""

from __future__ import annotations

import io
import itertools
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hri.core.writing import PRIVATE, write_bytes
from hri.robot.feeling_plot import MOOD_COLORS
from hri.robot.labels import placed

Line = dict[str, Any]

TITLE = "What happened, how the robot felt, and how fast it went"
LETTER = 0.0042
"""Width of a letter as a part of the frame's."""
LONGEST = 38
"""Letters of a sentence that are written."""
LEVELS = 5
"""Rows of words above each other, LIFT points apart."""
LIFT = 10.0
SIZE = 7
"""Points of a letter."""
SHORTEST_S = 1.0

_ROWS = ("seen, felt", "said", "ignored", "heard")
_MARKS = {
    # event: (row, color, the property that is written beside the mark, or a word for it)
    "speech.heard": (3, "#1f6fb4", "text", ""),
    "speech.rejected": (2, "#808080", "reason", ""),
    "speech.said": (1, "#2e8b57", "text", ""),
    "head.nodded": (0, "#c46210", "", "nod"),
    "head.shaken": (0, "#c46210", "", "shake"),
    "bumper.pressed": (0, "#b22222", "", "bumped"),
}
_STOPPED = "#b22222"
_MOOD_EVENTS = {
    # event: what it calls pleasure
    "emotion.changed": "valence",
    "mood.changed": "pleasure",
}


def plot_timeline(events: list[Line], path: Path) -> None:
    """Draw the events of a log to a PNG file. Raises HriError when it cannot be written."""
    picture = io.BytesIO()
    figure_of(events).savefig(picture, dpi=100, format="png", metadata={"Software": "hri"})
    write_bytes(path, picture.getvalue(), PRIVATE)


def figure_of(events: list[Line]) -> Figure:
    """The plot of the events of a log."""
    figure = Figure(figsize=(16, 10), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(TITLE)
    talk, mood, motion = figure.subplots(3, 1, sharex=True, height_ratios=[3, 2, 1.4])
    end = max((event["t"] for event in events), default=SHORTEST_S)
    motion.set_xlim(0, max(end, SHORTEST_S))
    motion.set_xlabel("seconds")
    _plot_talk(talk, events)
    _plot_mood(mood, events)
    _plot_motion(motion, events)
    return figure


def _plot_talk(axes: Axes, events: list[Line]) -> None:
    axes.set_yticks(range(len(_ROWS)), _ROWS)
    axes.set_ylim(-0.3, len(_ROWS))
    axes.grid(axis="x", alpha=0.3)
    for name, (row, color, _, _) in _MARKS.items():
        times = [event["t"] for event in events if event["event"] == name]
        axes.plot(times, [row] * len(times), "o", color=color, markersize=5)
    for row in range(len(_ROWS)):
        words = [
            (event["t"], (str(event.get(key, "")) if key else word)[:LONGEST], color)
            for event in events
            if event["event"] in _MARKS
            for at, color, key, word in [_MARKS[event["event"]]]
            if at == row
        ]
        color_at = {time: color for time, _, color in words}
        _write(axes, ((time, text) for time, text, _ in words), row, color_at)


def _write(
    axes: Axes, words: Iterable[tuple[float, str]], row: float, colors: dict[float, str]
) -> None:
    """Words above a row, in the colors of their times."""
    start, end = axes.get_xlim()
    for label in placed(words, start, end, LETTER, LEVELS):
        axes.annotate(
            label.text, (start + label.at * (end - start), row), (2, 5 + LIFT * label.level),
            textcoords="offset points", fontsize=SIZE, color=colors[label.time],
            parse_math=False,
        )  # fmt: skip


def _plot_mood(axes: Axes, events: list[Line]) -> None:
    axes.set_ylim(-1, 1.5)
    axes.set_yticks((-1, 0, 1))
    axes.set_ylabel("mood")
    moods = [event for event in events if event["event"] in _MOOD_EVENTS]
    if not moods:
        return
    times = [event["t"] for event in moods]
    for name, color in MOOD_COLORS.items():
        values = [
            event[_MOOD_EVENTS[event["event"]] if name == "pleasure" else name] for event in moods
        ]
        # The last value holds to the end of the visit.
        end = axes.get_xlim()[1]
        axes.plot([*times, end], [*values, values[-1]], color=color, label=name)
    labels, before = [], ""
    for event in moods:
        if event["event"] == "emotion.changed" and event["label"] != before:
            before = event["label"]
            axes.axvline(event["t"], ymax=0.8, color="#dddddd", zorder=0)
            labels.append((event["t"], before))
    _write(axes, labels, 1.0, dict.fromkeys(times, "#444444"))
    axes.legend(loc="lower right", fontsize=8, ncols=3)


def _plot_motion(axes: Axes, events: list[Line]) -> None:
    poses = [event for event in events if event["event"] == "odometry"]
    times, speeds = [], []
    for before, after in itertools.pairwise(poses):
        elapsed = after["t"] - before["t"]
        if elapsed > 0:
            step = math.hypot(after["x_cm"] - before["x_cm"], after["y_cm"] - before["y_cm"])
            times.append((before["t"] + after["t"]) / 2)
            speeds.append(step / 100 / elapsed)
    fastest = max(0.5, *speeds) if speeds else 0.5
    axes.set_ylim(0, 2 * fastest)
    axes.set_ylabel("speed, m/s")
    axes.fill_between(times, speeds, step="mid", color="#1f6fb4", alpha=0.5)
    stops = [(e["t"], str(e.get("reason", ""))) for e in events if e["event"] == "drive.stopped"]
    for time, _ in stops:
        axes.axvline(time, ymax=0.55, color=_STOPPED, alpha=0.6)
    words = ((time, f"stopped: {reason}") for time, reason in stops)
    _write(axes, words, 1.1 * fastest, {time: _STOPPED for time, _ in stops})
