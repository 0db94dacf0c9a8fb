"""Hears the keyboard: every typed line is a piece of speech.

A line need not be a sentence to the letter: little words too many or too few are forgiven, at the
price that `hri.speech.grammar.tolerance` puts on them. All that may be forgiven at once halves the
confidence; a line of which only a part is a sentence loses a quarter of it, and one that says it in
other words somewhat more.

Lines wait for each other and until the robot has spoken; only what a rule marked @interrupts allows
is heard at once.
"""

from __future__ import annotations

import math
import sys
import threading
from collections import deque
from collections.abc import Collection
from typing import NamedTuple

from hri.core.origin import KEYBOARD, origin
from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.speech.grammar import Grammar as WrittenGrammar
from hri.speech.grammar.excerpt import excerpt
from hri.speech.grammar.guessing import paraphrased
from hri.speech.grammar.matching import parse
from hri.speech.grammar.tolerance import MOST_COST, nearest

OF_PART = 0.75
"""Confidence of a line of which only a part is a sentence."""
OF_PARAPHRASE = 0.6
"""Confidence of a line that is most like other ways to say a sentence."""
REPLY_SECONDS = 1.0
"""How long the line behind another one waits for the robot to begin to speak."""


class _Line(NamedTuple):
    text: str
    time: float | None
    """Seconds of the clock at which it was typed; None: when it is heard."""
    origin: str


class TypedRecognizer(Recognizer):
    """Takes lines from code (`type_line`), and from standard input with source = "stdin"."""

    parameters = ("source",)

    def _open(self) -> None:
        source = self.description.text("source", "code")
        if source not in ("code", "stdin"):
            raise self.description.error("source", f'no source "{source}"', "write code or stdin")
        self._grammar: WrittenGrammar | None = None
        self._lines: deque[_Line] = deque()
        self._is_speaking = False
        self._free_at = -math.inf
        """Seconds of the clock from which the next line may be heard."""
        if source == "stdin":
            # A daemon: nobody can end a read from a terminal.
            threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in sys.stdin:
            self._lines.append(_Line(line.strip(), None, KEYBOARD))
        self._is_closed = True

    _is_closed = False

    @property
    def has_ended(self) -> bool:
        """True when all lines were heard and no further one can come (the end of the input)."""
        return self._is_closed and not self._lines

    def type_line(self, text: str, now: float) -> None:
        """Let it hear a line, typed at `now` seconds."""
        self._lines.append(_Line(text, now, origin()))

    def start(self, grammar: Grammar) -> None:
        self._grammar = grammar if isinstance(grammar, WrittenGrammar) else None

    def mind(self, is_speaking: bool, now: float) -> None:
        if self._is_speaking and not is_speaking:
            self._free_at = now
        self._is_speaking = is_speaking

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        line = self._next(end)
        if line is None:
            return []
        self._free_at = end + REPLY_SECONDS
        time = end if line.time is None else line.time
        return [Segment(time, time, text=line.text, origin=line.origin)]

    def _next(self, now: float) -> _Line | None:
        """The line that is heard now; None when all must wait."""
        while self._lines and not self._lines[0].text:
            self._lines.popleft()
        if not self._is_speaking and now >= self._free_at:
            return self._lines.popleft() if self._lines else None
        for place, line in enumerate(tuple(self._lines)):
            if self._interrupts(line.text):
                del self._lines[place]
                self._date_those_before(place, now)
                return line
        return None

    def _date_those_before(self, place: int, now: float) -> None:
        """Lines that are overtaken were typed by now, whenever they are heard."""
        for index in range(place):
            if self._lines[index].time is None:
                self._lines[index] = self._lines[index]._replace(time=now)

    def _interrupts(self, text: str) -> bool:
        grammar = self._grammar
        rules = grammar.marked("interrupts") if grammar is not None else frozenset()
        return bool(rules) and grammar is not None and parse(grammar, text, rules) is not None

    def flush(self) -> list[Segment]:
        return []

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        return LineDecoder(self._grammar).decode(segment, rules)


class LineDecoder:
    """Finds the sentence of a grammar that is nearest to a typed line."""

    def __init__(self, grammar: WrittenGrammar | None) -> None:
        """Without a grammar every line is taken as it is."""
        self._grammar = grammar

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        """`segment` has the line as its text; `rules` are those that count, all by default."""
        text = segment.text.lower()
        if self._grammar is None:
            return Hypothesis(text, 1.0)
        if (near := nearest(self._grammar, segment.text, rules=rules)) is not None:
            return Hypothesis(near.parse.as_typed, 1.0 - 0.5 * near.cost / MOST_COST)
        part = excerpt(self._grammar, text, rules)
        if (meant := paraphrased(self._grammar, text, rules, part)) is not None:
            return Hypothesis(meant.text, OF_PARAPHRASE, paraphrase=text)
        return Hypothesis(text, 1.0) if part is None else Hypothesis(part.text, OF_PART)
