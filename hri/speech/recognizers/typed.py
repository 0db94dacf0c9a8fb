"""Hears the keyboard: every typed line is a piece of speech.

A line need not be a sentence to the letter: little words too many or too few are forgiven, at the
price that `hri.speech.grammar.tolerance` puts on them. All that may be forgiven at once halves the
confidence.
"""

from __future__ import annotations

import sys
import threading
from collections import deque
from collections.abc import Collection

from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.speech.grammar import Grammar as WrittenGrammar
from hri.speech.grammar.tolerance import MOST_COST, nearest


class TypedRecognizer(Recognizer):
    """Takes lines from code (`type_line`), and from standard input with source = "stdin"."""

    parameters = ("source",)

    def _open(self) -> None:
        source = self.description.text("source", "code")
        if source not in ("code", "stdin"):
            raise self.description.error("source", f'no source "{source}"', "write code or stdin")
        self._grammar: WrittenGrammar | None = None
        self._lines: deque[tuple[str, float | None]] = deque(maxlen=100)
        if source == "stdin":
            # A daemon: nobody can end a read from a terminal.
            threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in sys.stdin:
            self._lines.append((line.strip(), None))
        self._is_closed = True

    _is_closed = False

    @property
    def has_ended(self) -> bool:
        """True when all lines were heard and no further one can come (the end of the input)."""
        return self._is_closed and not self._lines

    def type_line(self, text: str, now: float) -> None:
        """Let it hear a line, typed at `now` seconds."""
        self._lines.append((text, now))

    def start(self, grammar: Grammar) -> None:
        self._grammar = grammar if isinstance(grammar, WrittenGrammar) else None

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

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        text = segment.text.lower()
        near = nearest(self._grammar, text, rules=rules) if self._grammar is not None else None
        if near is None:
            return Hypothesis(text, 1.0)
        return Hypothesis(near.parse.text, 1.0 - 0.5 * near.cost / MOST_COST)
