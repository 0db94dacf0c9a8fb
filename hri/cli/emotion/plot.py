"""The plot of a simulation: mood, emotions, drives and events over time."""

from __future__ import annotations

import bisect
import io
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hri.core.signals import EmotionState
from hri.core.writing import write_bytes
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.robot.feeling_plot import MOOD_COLORS
from hri.robot.labels import placed

Named = tuple[float, str]
"""When something happens, in seconds, and what it is called."""

POINTS = 600
"""Number of evenly spaced samples; events are added."""
FADES_S = 60.0
"""Seconds drawn after the last event, so that its fading is visible."""
MOST_CURVES = 8
"""Most emotions drawn, the strongest ones."""
DPI = 100
"""Pixels per inch; the picture is 12 inches wide."""
ROWS = 5
"""Names of events, and of labels, above each other."""
LETTER = 0.0073
"""Width of a letter, of the plot's."""
LONGEST_NAME = 38
"""Most letters of an event's name."""


def plot_affects(
    dynamics: Dynamics, affects: Sequence[Affect], events: Sequence[Named], path: Path
) -> None:
    """Draw the feelings of a while to a PNG file. Raises HriError when it cannot be written."""
    figure = figure_of(dynamics, affects, events)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=DPI, format="png", metadata={"Software": "hri"})
    write_bytes(path, picture.getvalue())


def figure_of(dynamics: Dynamics, affects: Sequence[Affect], events: Sequence[Named]) -> Figure:
    """Mood, emotions and drives over time, with the events above."""
    figure = Figure(figsize=(12, 9), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    mood, emotions, drives = figure.subplots(3, 1, sharex=True, height_ratios=[2, 2, 1])
    times, states = _sampled(dynamics, affects, events)
    axes = {
        "pleasure": [state.valence for state in states],
        "arousal": [state.arousal for state in states],
        "dominance": [state.dominance for state in states],
    }
    for name, values in axes.items():
        mood.plot(times, values, color=MOOD_COLORS[name], label=name)
    _finish(mood, "mood", -1.05)
    _write(mood, _changes(times, states))
    for name in _strongest(states):
        emotions.plot(times, [state.emotions[name] for state in states], label=name)
    _finish(emotions, "emotions", -0.02)
    _write(emotions, ((time, name[:LONGEST_NAME]) for time, name in events))
    for name in states[0].drives if states else ():
        drives.plot(times, [state.drives[name] for state in states], label=name)
    _finish(drives, "drives", -0.02)
    drives.set_xlabel("seconds")
    return figure


def _sampled(
    dynamics: Dynamics, affects: Sequence[Affect], events: Sequence[Named]
) -> tuple[list[float], list[EmotionState]]:
    """States at even intervals and at all printed times, in order."""
    if not affects:
        return [], []
    first, last = affects[0].time, affects[-1].time
    if events and events[-1][0] == last:
        last += FADES_S
    even = [first + (last - first) * step / POINTS for step in range(POINTS + 1)]
    known = [affect.time for affect in affects]
    points = [(affect.time, affect) for affect in affects]
    for time in even:
        before = bisect.bisect_right(known, time) - 1
        points.append((time, dynamics.advance(affects[before], time)))
    points.sort(key=lambda point: point[0])
    return [time for time, _ in points], [dynamics.read(affect) for _, affect in points]


def _strongest(states: Sequence[EmotionState]) -> list[str]:
    peaks: dict[str, float] = {}
    for state in states:
        for name, intensity in state.emotions.items():
            peaks[name] = max(peaks.get(name, 0.0), intensity)
    felt = sorted((name for name, peak in peaks.items() if peak > 0), key=lambda n: -peaks[n])
    return felt[:MOST_CURVES]


def _changes(times: Sequence[float], states: Sequence[EmotionState]) -> Iterator[tuple[float, str]]:
    """When the label changes, and to what."""
    before = ""
    for time, state in zip(times, states, strict=True):
        if state.label != before:
            yield time, state.label
        before = state.label


def _write(axes: Axes, names: Iterable[tuple[float, str]]) -> None:
    """Names above a plot, at their times; names that do not fit are left out."""
    left, right = axes.get_xlim()
    for label in placed(names, left, right, LETTER, ROWS):
        axes.axvline(label.time, color="#dddddd", zorder=0)
        axes.annotate(
            label.text,
            xy=(label.at, 1.0),
            xycoords="axes fraction",
            xytext=(0, 2 + 10 * label.level),
            textcoords="offset points",
            fontsize=8,
            parse_math=False,
        )


def _finish(axes: Axes, title: str, bottom: float) -> None:
    axes.set_ylabel(title)
    axes.set_ylim(bottom, 1.05)
    axes.grid(alpha=0.3)
    if axes.lines:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8)
