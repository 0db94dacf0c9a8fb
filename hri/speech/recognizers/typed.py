"""Hears the keyboard: every typed line is a piece of speech."""

from __future__ import annotations

import sys
import threading
from collections import deque

from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment


class TypedRecognizer(Recognizer):
    """Takes lines from code (`type_line`), and from standard input with source = "stdin"."""

    parameters = ("source",)

    def _open(self) -> None:
        source = self.description.text("source", "code")
        if source not in ("code", "stdin"):
            raise self.description.error("source", f'no source "{source}"', "write code or stdin")
        self._lines: deque[tuple[str, float | None]] = deque(maxlen=100)
        if source == "stdin":
            # A daemon: nobody can end a read from a terminal.
            threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in sys.stdin:
            self._lines.append((line.strip(), None))

    def type_line(self, text: str, now: float) -> None:
        """Let it hear a line, typed at `now` seconds."""
        self._lines.append((text, now))

    def start(self, grammar: Grammar) -> None:
        pass

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        segments = []
        while self._lines:
            text, when = self._lines.popleft()
            time = end if when is None else when
            if text:
                segments.append(Segment(time, time, text=text))
        return segments

    def flush(self) -> list[Segment]:
        return []

    def decode(self, segment: Segment) -> Hypothesis:
        return Hypothesis(segment.text.lower(), 1.0)
