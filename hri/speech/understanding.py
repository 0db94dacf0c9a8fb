"""From a piece of speech to an utterance: shared by all that listen."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from typing import Protocol

from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.acceptance import judge
from hri.speech.grammar import Grammar
from hri.speech.turn import Turn

STEP = 0.2
"""Seconds of new sound after which an engine is let work on a piece that is still open."""
SILENT_AFTER = 0.16
"""Seconds of quiet at which an engine is let work at once: the end may have come."""

Heard = Utterance | Rejection
Stopwatch = Callable[[], float]
"""Seconds that only ever grow."""


class Decoder(Protocol):
    """The part of a recognizer that finds the words of a piece of speech."""

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis: ...


def stopped() -> float:
    """A stopwatch for who measures nothing."""
    return 0.0


def understand(
    engine: Decoder,
    grammar: Grammar,
    segment: Segment,
    strictness: float,
    turn: Turn | None,
    stopwatch: Stopwatch = stopped,
) -> Heard:
    """Decode a finished piece of speech and judge it.

    What no rule that counts now explains is held against the others, too: the reason of the
    rejection is then "not now" where one of those fits.
    """
    begun = stopwatch()
    turn = None if turn is None else turn.of(segment)
    heard = anticipate(engine, grammar, segment, strictness, turn)
    if isinstance(heard, Rejection):
        heard = explained(engine, grammar, segment, strictness, turn, heard)
    return replace(heard, latency=stopwatch() - begun)


def anticipate(
    engine: Decoder, grammar: Grammar, segment: Segment, strictness: float, turn: Turn | None
) -> Heard:
    """What a piece of speech is by the rules that count; it may still go on."""
    hypothesis = engine.decode(segment, None if turn is None else turn.rules(grammar))
    return judge(grammar, segment, hypothesis, strictness, turn)


def explained(
    engine: Decoder,
    grammar: Grammar,
    segment: Segment,
    strictness: float,
    turn: Turn | None,
    rejection: Rejection,
) -> Rejection:
    """A rejection, or the better one that a rule explains which does not count now."""
    all_rules = frozenset(grammar.public_rules)
    if turn is None or turn.is_speaking or turn.rules(grammar) == all_rules:
        return rejection
    heard = judge(grammar, segment, engine.decode(segment), strictness, turn)
    if isinstance(heard, Rejection) and heard.reason == "not now":
        return heard if heard.confidence >= strictness else rejection
    return rejection
