"""What the companion makes of typed lines and of clips, by whose turn it is."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import cache, partial

from benchmarks.progress import progress
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import ONE_CORE, Heard
from hri.bench.speech.samples import Clip
from hri.bench.speech.scoring import Outcome
from hri.bench.workers import variables, worker_pool
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Recognizer, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot
from hri.speech import hearing, understanding
from hri.speech.acceptance import STRICTNESS
from hri.speech.behaviors import Listener
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.recognizers.automatic import AutomaticRecognizer
from hri.speech.recognizers.typed import LineDecoder
from hri.speech.turn import Turn
from hri.testing.dialogues import TYPED

NAME = "Robin"
BATCH = 40
"""Clips that a process hears at once."""


@cache
def companion() -> Grammar:
    """Its grammar, with its name."""
    return load_grammar(paths.find("grammars", "companion")).called(NAME)


@cache
def with_skills() -> Grammar:
    """The same with the commands of all its skills."""
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=TYPED)
    return robot.context.behavior(Listener).read_grammar().called(NAME)


def typed(line: str, turn: Turn) -> Heard:
    """What a typed line is."""
    segment = Segment(0.0, 0.0, text=line)
    decoder = LineDecoder(companion())
    return _told(understanding.understand(decoder, companion(), segment, STRICTNESS, turn))


def heard(
    clips: Sequence[Clip], turn: Turn, what: str, grammar: Callable[[], Grammar] = companion
) -> list[Outcome]:
    """What the default engine makes of clips, in as many processes as there are cores."""
    batches = [clips[start : start + BATCH] for start in range(0, len(clips), BATCH)]
    cores = os.cpu_count() or 1
    with variables(**ONE_CORE), worker_pool(cores) as pool:
        hear = partial(hear_all, turn=turn, grammar=grammar)
        done = progress(pool.map(hear, batches), len(batches), what)
        pieces = [one for batch in done for one in batch]
    return [Outcome(clip, made) for clip, made in zip(clips, pieces, strict=True)]


def hear_all(
    clips: Sequence[Clip], turn: Turn, grammar: Callable[[], Grammar] = companion
) -> list[list[Heard]]:
    """What it makes of the pieces of speech of each clip, in this process."""
    engine, known = _engine(grammar), grammar()
    return [
        [_told(one) for one in hearing.hear(clip.samples, RATE, engine, known, turn=turn)]
        for clip in clips
    ]


@cache
def _engine(grammar: Callable[[], Grammar]) -> Recognizer:
    resources = ResourceManager((), FakeClock())
    engine = AutomaticRecognizer(Description("recognizer", "Hri.Recognizer"), resources)
    engine.activate()
    engine.start(grammar())
    return engine


def _told(one: understanding.Heard) -> Heard:
    utterance = one if isinstance(one, Utterance) else None
    return Heard(
        is_accepted=utterance is not None,
        text=one.text,
        rule=utterance.rule if utterance else "",
        tags=dict(utterance.tags) if utterance else {},
        confidence=one.confidence,
        reason=one.reason if isinstance(one, Rejection) else "",
        latency_s=one.latency,
        start_s=one.start,
        end_s=one.end,
    )
