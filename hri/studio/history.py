"""What the page shows of the last minutes, so that one that comes late sees it too: all bounded."""

from __future__ import annotations

import logging
import math
from collections import deque
from collections.abc import Callable

from hri.core.errors import HriError
from hri.core.signals import EmotionState, Pose2D
from hri.studio.topics import LogLine, Moods, Reason, Stop

MOST_MOODS = 300
"""Points of the mood, `MOOD_EVERY` seconds apart."""
MOOD_EVERY = 1.0
MOST_REASONS = 20
MOST_POINTS = 400
"""Points of the path, `STRIDE` meters apart."""
STRIDE = 0.05
MOST_STOPS = 20
MOST_TYPED = 20
"""Sentences that wait to be understood."""
MOST_LINES = 200
"""Lines of the log."""
LONGEST_LINE = 500
"""Letters."""


class MoodHistory:
    """The mood over time, and what began to cause the feelings."""

    def __init__(self) -> None:
        self._points: deque[list[float]] = deque(maxlen=MOST_MOODS)
        self._reasons: deque[Reason] = deque(maxlen=MOST_REASONS)
        self._newest = ("", "")

    def add(self, now: float, feeling: EmotionState, cause: str, why: str) -> None:
        """The feeling now, the name of its strongest cause, and the same in words."""
        if self._points and now - self._points[-1][0] < MOOD_EVERY:
            return
        parts = feeling.valence, feeling.arousal, feeling.dominance
        self._points.append([round(now, 1), *(round(part, 3) for part in parts)])
        # The words also say how long ago it was.
        if self._newest != (feeling.label, cause):
            self._newest = feeling.label, cause
            self._reasons.append({"t": round(now, 1), "label": feeling.label, "why": why})

    def told(self) -> Moods:
        """All that is kept, the oldest first."""
        return {"points": list(self._points), "reasons": list(self._reasons)}


class Trail:
    """Where the base was, and where it stopped and why."""

    def __init__(self) -> None:
        self._been: deque[list[float]] = deque(maxlen=MOST_POINTS)
        self._stops: deque[Stop] = deque(maxlen=MOST_STOPS)

    def add(self, pose: Pose2D) -> None:
        """The base is there now."""
        if not self._been or math.dist(self._been[-1], (pose.x, pose.y)) >= STRIDE:
            self._been.append([round(pose.x, 3), round(pose.y, 3)])

    def add_stop(self, time: float, reason: str, words: str) -> None:
        """It has stopped where it was last."""
        x, y = self._been[-1] if self._been else (0.0, 0.0)
        stop: Stop = {"t": round(time, 2), "x": x, "y": y, "reason": reason, "words": words}
        self._stops.append(stop)

    @property
    def been(self) -> list[list[float]]:
        """Points in meters, the oldest first."""
        return list(self._been)

    @property
    def stops(self) -> list[Stop]:
        """The oldest first."""
        return list(self._stops)


class Troubles:
    """What is wrong with devices, in the words that people were told."""

    def __init__(self) -> None:
        self._problems: dict[str, str] = {}

    def note(self, line: str) -> None:
        """A notice about a device: `camera: no picture for 2 s - ...`, or `camera: is back`."""
        id, _, words = line.partition(": ")
        if words == "is back":
            self._problems.pop(id, None)
        elif words:
            self._problems[id] = words[:LONGEST_LINE]

    def of(self, id: str) -> str:
        """The problem with a device, and its remedy; empty when there is no problem."""
        return self._problems.get(id, "")


class TypedSentences:
    """What was typed into the page and waits to be understood: words that a rejection may show."""

    def __init__(self) -> None:
        self._waiting: deque[str] = deque(maxlen=MOST_TYPED)

    def add(self, text: str) -> None:
        """Someone typed this."""
        self._waiting.append(text)

    def take(self, heard: str) -> str | None:
        """A sentence as it was typed, if these are its words; it waits no longer."""
        found = next((one for one in self._waiting if _words(one) == _words(heard)), None)
        if found is not None:
            self._waiting.remove(found)
        return found


def _words(text: str) -> list[str]:
    return text.casefold().split()


class LogLines(logging.Handler):
    """The last lines of the log of `hri`."""

    def __init__(self, now: Callable[[], float]) -> None:
        super().__init__(logging.INFO)
        self._now = now
        self._lines: deque[LogLine] = deque(maxlen=MOST_LINES)

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a line; one that cannot be written is left out, as logging does it."""
        try:
            words = record.getMessage()
        except (TypeError, ValueError, HriError):
            return
        self.add(record.levelname.lower(), record.name.removeprefix("hri."), words)

    def add(self, level: str, part: str, words: str) -> None:
        """A line from elsewhere."""
        text = words.strip()[:LONGEST_LINE]
        line: LogLine = {"t": round(self._now(), 2), "level": level, "part": part, "text": text}
        self._lines.append(line)

    def told(self) -> list[LogLine]:
        """All that is kept, the oldest first."""
        return list(self._lines)
