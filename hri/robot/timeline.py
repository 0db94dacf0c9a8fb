"""The plot of a visit over time: heard, said, emotion, speed."""

from __future__ import annotations

import io
import itertools
import math
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hri.core.writing import PRIVATE, write_bytes

Line = dict[str, Any]

_ROWS = {
    # event: (row, color, what to write beside the mark)
    "speech.heard": (3, "#1f6fb4", "text"),
    "speech.rejected": (2, "#b0b0b0", "reason"),
    "speech.said": (1, "#2e8b57", "text"),
    "head.nodded": (0, "#c46210", None),
    "head.shaken": (0, "#c46210", None),
    "bumper.pressed": (0, "#b22222", None),
}
_MOOD = {"valence": "#2e8b57", "arousal": "#c46210", "dominance": "#6a5acd"}


def plot_timeline(events: list[Line], path: Path) -> None:
    """Draw the events of a log to a PNG file. Raises HriError when it cannot be written."""
    figure = Figure(figsize=(16, 10), layout="constrained")
    FigureCanvasAgg(figure)
    talk, mood, motion = figure.subplots(3, 1, sharex=True, height_ratios=[3, 2, 1.4])
    _plot_talk(talk, events)
    _plot_mood(mood, events)
    _plot_motion(motion, events)
    end = max((event["t"] for event in events), default=1.0)
    motion.set_xlim(0, max(end, 1.0))
    motion.set_xlabel("seconds")
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100, format="png", metadata={"Software": "hri"})
    write_bytes(path, picture.getvalue(), PRIVATE)


def _plot_talk(axes: Axes, events: list[Line]) -> None:
    count = 0
    for event in events:
        if event["event"] not in _ROWS:
            continue
        row, color, key = _ROWS[event["event"]]
        axes.plot(event["t"], row, "o", color=color, markersize=5)
        label = str(event.get(key, "")) if key else event["event"].split(".")[1]
        # Neighbors take turns on four heights, so that sentences do not cover each other.
        lift = 5 + 10 * (count % 4)
        axes.annotate(
            label[:38], (event["t"], row), (2, lift), textcoords="offset points",
            fontsize=7, color=color, parse_math=False,
        )  # fmt: skip
        count += 1
    axes.set_yticks(range(4), ["seen, felt", "said", "rejected", "heard"])
    axes.set_ylim(-0.4, 3.9)
    axes.grid(axis="x", alpha=0.3)


def _plot_mood(axes: Axes, events: list[Line]) -> None:
    changes = [event for event in events if event["event"] == "emotion.changed"]
    if not changes:
        return
    end = max(event["t"] for event in events)
    times = [event["t"] for event in changes]
    for name, color in _MOOD.items():
        values = [event[name] for event in changes]
        # The last value holds to the end of the visit.
        axes.step([*times, end], [*values, values[-1]], where="post", color=color, label=name)
    label = ""
    for event in changes:
        if event["label"] != label:
            label = event["label"]
            axes.axvline(event["t"], color="#dddddd", zorder=0)
            axes.text(event["t"], 0.98, label, fontsize=8, rotation=35, ha="left", va="bottom")
    axes.set_ylim(-1, 1.35)
    axes.set_ylabel("mood")
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
    axes.fill_between(times, speeds, step="mid", color="#1f6fb4", alpha=0.5)
    for event in events:
        if event["event"] == "drive.stopped":
            axes.axvline(event["t"], color="#b22222", alpha=0.6)
            axes.text(event["t"], 0.02, f" {event.get('reason', '')}", fontsize=7, color="#b22222")
    axes.set_ylabel("speed, m/s")
    axes.set_ylim(0, max(0.5, *speeds) * 1.1 if speeds else 0.5)
