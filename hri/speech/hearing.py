"""From a recording to utterances, without a robot."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from hri.core.signals import Samples, Utterance
from hri.hal.drivers.recording_level import audible
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Recognizer, Segment
from hri.speech.acceptance import STRICTNESS
from hri.speech.grammar import Grammar
from hri.speech.turn import Turn
from hri.speech.turn_taking import TurnTaking
from hri.speech.understanding import SILENT_AFTER, STEP, Heard, Stopwatch, stopped

BLOCK = 0.05
"""Seconds of a recording that are heard at once."""


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
    """What is said in a recording, sentence by sentence; its times count from its first sample.

    `engine` has been started with the grammar, and keeps nothing of the recording. `turn` says
    which rules are active; without one, all do. `stopwatch` measures the latencies. `tell_partial`
    is told the words so far while a piece goes on; without it no work is spent on them. A quiet
    recording is heard as if it were as loud as a usual voice. Where someone goes on with a
    sentence after its end seemed to have come, only all of it counts.
    """
    loud_enough, gain_db = audible(samples, rate)
    sound = resample(loud_enough, rate, engine.rate)
    rules = None if turn is None else turn.rules(grammar)
    turns = TurnTaking(engine)
    waiting: list[Heard] = []

    def ended(segment: Segment) -> Iterator[Heard]:
        begun = stopwatch()
        reading = turns.end(_as_recorded(segment, gain_db), grammar, strictness, turn)
        took = stopwatch() - begun
        if reading.continues:
            understood = [one for one in reading.heard if isinstance(one, Utterance)]
            waiting[-1:] = understood or waiting[-1:]
        else:
            yield from waiting
            waiting[:] = reading.heard
        waiting[:] = [replace(one, latency=one.latency or took) for one in waiting]

    step, worked = round(BLOCK * engine.rate), 0.0
    for first in range(0, len(sound), step):
        block = sound[first : first + step]
        for segment in engine.listen(block, (first + len(block)) / engine.rate):
            yield from ended(segment)
        open_segment = engine.open_segment
        if open_segment is None:
            continue
        if open_segment.quiet >= SILENT_AFTER:
            piece = _as_recorded(open_segment, gain_db)
            reading = turns.read(piece, grammar, strictness, turn)
            engine.wait(open_segment, reading.pauses)
            if tell_partial is not None and reading.heard:
                tell_partial(reading.heard[-1].text)
        elif tell_partial is not None and open_segment.end - worked >= STEP:
            worked = open_segment.end
            tell_partial(engine.advance(open_segment, rules))
    for segment in engine.flush():
        yield from ended(segment)
    yield from waiting


def _as_recorded(segment: Segment, gain_db: float) -> Segment:
    """A piece with the level that it had before a quiet recording was amplified."""
    if segment.level_db is None or not gain_db:
        return segment
    return replace(segment, level_db=round(segment.level_db - gain_db, 1))
