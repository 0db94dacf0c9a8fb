"""From sound to utterances, without a robot: shared by all listeners."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from typing import Protocol

from hri.core.signals import Rejection, Samples, Utterance
from hri.hal.drivers.recording_level import audible
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.speech.acceptance import STRICTNESS, judge
from hri.speech.grammar import Grammar
from hri.speech.turn import Turn

STEP = 0.2
"""Seconds of new sound after which an engine is let work on a piece that is still open."""
SILENT_AFTER = 0.2
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


def hear(
    samples: Samples,
    rate: int,
    engine: Recognizer,
    grammar: Grammar,
    strictness: float = STRICTNESS,
    turn: Turn | None = None,
    stopwatch: Stopwatch = stopped,
    tell_partial: Callable[[str], object] | None = None,
) -> Iterator[Heard]:
    """What is said in a recording, piece by piece; its times count from its first sample.

    `engine` has been started with the grammar, and keeps nothing of the recording. `turn` says
    which rules are active; without one, all do. `stopwatch` measures the latencies. `tell_partial`
    is told the words so far while a piece goes on; without it no work is spent on them. A quiet
    recording is heard as if it were as loud as a usual voice.
    """
    loud_enough, gain_db = audible(samples, rate)
    sound = resample(loud_enough, rate, engine.rate)
    rules = None if turn is None else turn.rules(grammar)
    step = round(STEP * engine.rate)
    for first in range(0, len(sound), step):
        block = sound[first : first + step]
        for segment in engine.listen(block, (first + len(block)) / engine.rate):
            piece = _as_recorded(segment, gain_db)
            yield understand(engine, grammar, piece, strictness, turn, stopwatch)
        open_segment = engine.open_segment
        if open_segment is None:
            continue
        if tell_partial is not None:
            tell_partial(engine.advance(open_segment, rules))
        elif open_segment.quiet >= SILENT_AFTER:
            engine.advance(open_segment, rules)
    for segment in engine.flush():
        piece = _as_recorded(segment, gain_db)
        yield understand(engine, grammar, piece, strictness, turn, stopwatch)


def _as_recorded(segment: Segment, gain_db: float) -> Segment:
    """A piece with the level that it had before a quiet recording was amplified."""
    if segment.level_db is None or not gain_db:
        return segment
    return replace(segment, level_db=round(segment.level_db - gain_db, 1))


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
    heard = anticipate(engine, grammar, segment, strictness, turn)
    if isinstance(heard, Rejection) and turn is not None and not turn.is_speaking:
        heard = _untimely(engine, grammar, segment, strictness, turn) or heard
    return replace(heard, latency=stopwatch() - begun)


def anticipate(
    engine: Decoder, grammar: Grammar, segment: Segment, strictness: float, turn: Turn | None
) -> Heard:
    """What a piece of speech is by the rules that count; it may still go on."""
    hypothesis = engine.decode(segment, None if turn is None else turn.rules(grammar))
    return judge(grammar, segment, hypothesis, strictness, turn)


def _untimely(
    engine: Decoder, grammar: Grammar, segment: Segment, strictness: float, turn: Turn
) -> Rejection | None:
    """The sentence that was said of a rule that does not count now; None when none was."""
    if turn.rules(grammar) == frozenset(grammar.public_rules):
        return None
    heard = judge(grammar, segment, engine.decode(segment), strictness, turn)
    if isinstance(heard, Rejection) and heard.reason == "not now":
        return heard if heard.confidence >= strictness else None
    return None
