"""Devices in memory for the behaviors of speech."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from hri.behavior.behavior import Behavior, Context
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Phoneme, Prosody, Samples, Speech
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import PLAIN, Synthesizer

TICK = 0.05


class ScriptedEars(Recognizer):
    """Finds the words it was told, at the times it was told: {1.0: ("stop", 0.9)}."""

    def _open(self) -> None:
        self.script: dict[float, tuple[str, float]] = {}
        self.started_with: Grammar | None = None
        self.partials: dict[float, str] = {}
        self.decoded_with: list[frozenset[str]] = []
        self.last = 0.0
        self.count = 0
        self.known: dict[str, dict[str, tuple[str, ...]]] = {}
        self.pause = 0.0  # seconds at the end of each piece in which nobody speaks

    def start(self, grammar: Grammar) -> None:
        if "unspeakable" in grammar.words():
            raise HriError("unspeakable - write another word")
        self.started_with = grammar

    def know(self, slot: str, sounds: Mapping[str, tuple[str, ...]]) -> None:
        self.known[slot] = dict(sounds)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        due = [time for time in self.script if self.last < time <= end]
        self.last = end
        self.count += len(samples)
        return [self._piece(time, time) for time in due]

    def flush(self) -> list[Segment]:
        return []

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        self.decoded_with.append(frozenset(rules or ()))
        return Hypothesis(*self.script[min(time for time in self.script if time >= segment.end)])

    def advance(self, segment: Segment, rules: Collection[str] | None = None) -> str:
        due = [words for time, words in self.partials.items() if time <= segment.end]
        return due[-1] if due else ""

    @property
    def open_segment(self) -> Segment | None:
        ends = [time for time in self.script if 0.0 < time - self.last < 0.5]
        return self._piece(ends[0], self.last) if ends else None

    def _piece(self, end: float, now: float) -> Segment:
        """What there is at a time of the piece that ends at another."""
        samples = np.zeros(round((now - end + 0.5) * self.rate), np.int16)
        quiet = max(0.0, now - (end - self.pause))
        number = 1 + sorted(self.script).index(end)
        return Segment(end - 0.5, now, samples, number=number, quiet=quiet)

    @property
    def is_hearing(self) -> bool:
        return any(0.0 < time - self.last < 0.5 for time in self.script)


class DeafMicrophone(Microphone):
    def read(self, now: float) -> Samples:
        return np.zeros(round(self.rate * TICK), np.int16)


class HighMicrophone(DeafMicrophone):
    rate = 44100


class TimedSpeaker(Speaker):
    """Plays without a sound, in the time of the clock."""

    def _open(self) -> None:
        self.started: float | None = None
        self.duration = 0.0

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.started, self.duration, self.rate = now, len(samples) / rate, rate

    def extend(self, samples: Samples, now: float) -> None:
        if self.started is not None:
            self.duration += len(samples) / self.rate

    def position(self, now: float) -> float | None:
        if self.started is None or now - self.started >= self.duration:
            return None
        return now - self.started

    def stop(self, now: float) -> None:
        self.started = None


class CountingVoice(Synthesizer):
    """A tenth of a second for each letter, by the rate of the prosody."""

    def _open(self) -> None:
        self.sounds: list[tuple[tuple[str, tuple[str, ...]], ...]] = []
        self.prosody = PLAIN

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        self.sounds.append(prosody.sounds)
        self.prosody = prosody
        duration = 0.1 * len(text) / prosody.rate
        samples = np.zeros(round(duration * 1000), np.int16)
        return Speech(text, samples, 1000, (Phoneme("a", 0.0, duration),))


class Stage:
    """One behavior on a fake clock with devices in memory; keeps the events it raises."""

    def __init__(self, behavior: Behavior, microphone: type[Microphone] = DeafMicrophone) -> None:
        self.clock = FakeClock()
        self.events: list[tuple[float, str, dict[str, object]]] = []
        bus = EventBus(self.clock)
        bus.subscribe("*", lambda e: self.events.append((e.time, e.name, dict(e.properties))))
        self.resources = ResourceManager((), self.clock)
        self.ears = self._add("recognizer", ScriptedEars)
        self.speaker = self._add("speaker", TimedSpeaker)
        self._add("microphone", microphone)
        self.voice = self._add("voice", CountingVoice)
        self.behavior = behavior
        behavior.start(Context(self.clock, bus, self.resources))

    def _add(self, id, driver):
        resource = driver(Description(id, driver.__name__), self.resources)
        resource.activate()
        self.resources.substitute(id, resource)
        return resource

    def run(self, seconds: float) -> None:
        """Tick for some seconds; outputs are emptied before each tick, as a network does."""
        for _ in range(round(seconds / TICK)):
            self.clock.advance(TICK)
            for name in self.behavior.outputs:
                getattr(self.behavior, name).value = None
            self.behavior.compute(self.clock.now(), TICK)

    def names(self) -> list[str]:
        return [name for _, name, _ in self.events]
