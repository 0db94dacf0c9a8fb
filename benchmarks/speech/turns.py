"""Where turns end: how soon after the last sound, and whether pauses inside a sentence cut it.

Sentences of the companion by eight voices, through the robot's ears on a clock of the bench: what
finding the words takes is measured apart.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from time import perf_counter

import numpy as np

from benchmarks.speech.levels import trimmed
from benchmarks.speech.voices import VOICES
from hri.behavior.behavior import Context
from hri.bench.speech.flite_voices import RATE
from hri.bench.table import Limit, Row, amount, at_least, at_most, share
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Samples
from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.listener import Listener
from hri.speech.recognizers.ctc.decoder import CtcRecognizer

TICK = 1 / 30
LEAD, TAIL = 1.0, 2.5
"""Seconds of quiet before and after what is said."""
HISS = 4.0
"""Of the quiet: root mean square of 16-bit samples."""

COMPLETE = (
    "what is your name",
    "what time is it",
    "go forward two meters",
    "turn left forty five degrees",
    "show me a happy face",
    "where is my cup",
    "how are you",
    "be quiet",
    "turn around",
    "come here",
    "why are you so happy",
    "what can you do",
    "thank you very much",
    "good night",
)
OPEN = ("go forward", "turn left", "move back", "turn right", "drive ahead", "back up")
PARTED = (
    ("go forward", "two meters"),
    ("turn left", "forty five degrees"),
    ("turn right", "ninety degrees"),
    ("go back", "one meter"),
    ("move forward", "three meters"),
    ("rotate left", "a little"),
    ("what is", "your name"),
    ("show me a", "happy face"),
    ("how much battery", "do you have"),
    ("where is", "my cup"),
    ("could you please", "turn around"),
    ("why are you so", "sad"),
    ("tell me", "the time"),
    ("what do you", "see"),
    ("turn left forty", "five degrees"),
    ("hey robot", "go forward two meters"),
)
"""Sentences with a pause inside."""
TWO = (
    ("what is your name", "what time is it"),
    ("turn left", "go forward"),
    ("how are you", "show me a happy face"),
    ("turn around", "come here"),
    ("go back", "turn right"),
    ("thank you", "what do you see"),
)
"""Two commands, one after the other."""
HESITANT = (
    ("go forward", "um", "two meters"),
    ("turn left", "uh", "forty five degrees"),
    ("show me a", "um", "happy face"),
    ("what is", "uh", "your name"),
)
"""Sentences with a hesitation inside, a third of a second before it and behind it."""
PAUSES: dict[float, Limit | None] = {0.3: None, 0.5: at_most(0.01), 0.8: at_most(0.05)}
BETWEEN = 0.25


@dataclass(frozen=True, slots=True)
class Told:
    """What the ears reported."""

    text: str
    delay: float
    """Seconds from the last sound."""
    continues: bool

    def means(self, sentence: str) -> bool:
        """Whether it means what a sentence of the companion does."""
        wanted, heard = parse(_grammar(), sentence), parse(_grammar(), self.text)
        return wanted is not None and heard is not None and heard.means_the_same(wanted)


def rows(step: int = 1) -> Iterator[Row]:
    """All rows; of every `step`th sentence. Raises NotAvailable without flite."""
    for what, sentences, median, p95 in (
        ("nothing can follow", COMPLETE, 0.3, 0.4),
        ("more may follow", OPEN, 0.65, 0.9),
    ):
        delays = [
            told[-1].delay
            for sentence in sentences[::step]
            for told, _ in _said_by_all((sentence,), 0.0)
            if told and told[-1].means(sentence)
        ]
        total = len(sentences[::step]) * len(VOICES)
        yield share(f"heard, {what}", len(delays), total, at_least(0.95))
        yield _delay(f"last sound to event, {what}, median", delays, 0.5, at_most(median))
        yield _delay(f"last sound to event, {what}, p95", delays, 0.95, at_most(p95))
    fluent = {
        (parts, voice)
        for parts in PARTED[::step]
        for told, voice in _said_by_all(parts, 0.0)
        if _is_one(told, " ".join(parts))
    }
    total = len(PARTED[::step]) * len(VOICES)
    yield share("heard without a pause", len(fluent), total, None)
    for pause, limit in PAUSES.items():
        cut = [
            f"{voice}: {parts} -> {[one.text for one in told]}"
            for parts in PARTED[::step]
            for told, voice in _said_by_all(parts, pause)
            if (parts, voice) in fluent and not _is_one(told, " ".join(parts))
        ]
        what = f"of these cut by a pause of {pause} s"
        yield share(what, len(cut), len(fluent), limit) | {"clips": cut}
    lost = [
        f"{voice}: {parts} -> {[one.text for one in told]}"
        for parts in HESITANT[::step]
        for told, voice in _said_by_all(parts, 0.33)
        if not _is_one(told, f"{parts[0]} {parts[2]}")
    ]
    total = len(HESITANT[::step]) * len(VOICES)
    yield share("cut by a hesitation", len(lost), total, None) | {"clips": lost}
    both = [
        f"{voice}: {pair} -> {[one.text for one in told]}"
        for pair in TWO[::step]
        for told, voice in _said_by_all(pair, BETWEEN)
        if not (len(told) == 2 and all(map(Told.means, told, pair)))
    ]
    total = len(TWO[::step]) * len(VOICES)
    what = f"two commands {BETWEEN} s apart that are not both heard"
    yield share(what, len(both), total, at_most(0.05)) | {"clips": both}
    yield _delay("finding the words at a pause, median", _took, 0.5, None)
    yield _delay("finding the words at a pause, p95", _took, 0.95, None)


def _delay(what: str, delays: Sequence[float], part: float, limit: Limit | None) -> Row:
    return amount(what, float(np.quantile(delays, part)), "s", limit)


def _is_one(told: Sequence[Told], sentence: str) -> bool:
    """Whether a sentence counts in the end, and nothing else but a greeting, as in "hi robot"."""
    *before, last = told or [Told("", 0.0, continues=False)]
    is_alone = not before or last.continues or before[0].means("hello robot")
    return last.means(sentence) and is_alone and len(before) <= 1


def _said_by_all(parts: Sequence[str], pause: float) -> Iterator[tuple[list[Told], str]]:
    for voice, say in VOICES.items():
        quiet = np.zeros(round(pause * RATE))
        sounds = [trimmed(say(part).astype(np.float64)) for part in parts]
        whole = sounds[0]
        for sound in sounds[1:]:
            whole = np.concatenate([whole, quiet, sound])
        yield _heard(whole.astype(np.int16)), voice


class _Addressed(MemoryMicrophone):
    """A microphone that hears only what is said to the robot."""

    is_recording = True


class _TimedEars(CtcRecognizer):
    def _decode(
        self, segment: Segment, samples: Samples, rules: Collection[str] | None
    ) -> Hypothesis:
        begun = perf_counter()
        hypothesis = super()._decode(segment, samples, rules)
        _took.append(perf_counter() - begun)
        return hypothesis


_took: list[float] = []
"""Seconds that finding the words took at each pause."""


@cache
def _grammar() -> Grammar:
    return load_grammar(paths.find("grammars", "companion"))


@cache
def _ears() -> Recognizer:
    """Shared by all sentences, so that the network is loaded once."""
    ears = _TimedEars(Description("recognizer", "Hri.Ctc"), ResourceManager((), FakeClock()))
    ears.activate()
    return ears


def _heard(sound: Samples) -> list[Told]:
    """What the companion's ears report of a sound, and when."""
    clock = FakeClock()
    bus = EventBus(clock)
    devices = ResourceManager((), clock)
    microphone = _Addressed(Description("microphone", "Hri.MemoryMicrophone"), devices)
    microphone.activate()
    devices.substitute("microphone", microphone)
    devices.substitute("recognizer", _ears())
    listener = Listener(latency_s=0.0)
    events: list[Event] = []
    bus.subscribe("speech.heard", events.append)
    _ears().flush()
    listener.start(Context(clock, bus, devices))
    while not listener.is_idle or clock.now() < LEAD:
        listener.compute(clock.now(), TICK)
        clock.advance(TICK)
    lead, tail = (np.zeros(round(seconds * RATE)) for seconds in (LEAD, TAIL))
    hiss = np.random.default_rng(1).normal(0.0, HISS, len(lead) + len(sound) + len(tail))
    begun = clock.now()
    microphone.hear(np.asarray(np.concatenate([lead, sound, tail]) + hiss, np.int16))
    while clock.now() < begun + LEAD + len(sound) / RATE + TAIL:
        clock.advance(TICK)
        listener.compute(clock.now(), TICK)
    listener.stop()
    end = begun + LEAD + len(sound) / RATE
    told = ((event.properties, event.time - end) for event in events)
    return [Told(str(what["text"]), delay, bool(what["continues"])) for what, delay in told]


if __name__ == "__main__":
    for row in rows(int(sys.argv[1]) if len(sys.argv) > 1 else 1):
        print(json.dumps(row))
