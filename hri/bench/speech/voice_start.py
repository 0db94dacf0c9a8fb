"""How soon the voice begins, and how soon it is silent."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from hri.behavior.behavior import Context
from hri.bench.table import Row, amount, at_most, attempted
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Samples
from hri.hal.drivers.sound_card import SoundCardSpeaker
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.voice import Voice

TEXT = "I have heard you, and I am on my way to the kitchen. It will take me about a minute."
FIRST = "first audio of say, median"
CANCEL = "cancel to silence, median"
TIMES = 20
WELL_BEGUN = 0.5
"""Seconds of speech that are heard before it is cut."""
LOOP = 0.001
"""Seconds between two ticks of the voice: what a slower loop adds is not the voice's."""
PATIENCE = 20.0
"""Seconds after which a voice that does not begin or end is given up."""


S = TypeVar("S", bound=Speaker)


class _Ear(Speaker):
    """Notes when it first gets sound."""

    def _open(self) -> None:
        self.begun: float | None = None

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.begun = self.begun or time.perf_counter()

    def extend(self, samples: Samples, now: float) -> None:
        pass

    def position(self, now: float) -> float | None:
        return None if self.begun is None else 0.0

    def stop(self, now: float) -> None:
        self.begun = None


class _Card(SoundCardSpeaker):
    """Notes when the sound card is first given silence."""

    silent: float | None = 0.0  # not asked before the stream is there

    def _wanted(self, out: Any, frames: int, stamp: object, status: object) -> None:
        super()._wanted(out, frames, stamp, status)
        if self.silent is None and not out.any():
            self.silent = time.perf_counter() + self._stream.latency


def rows() -> Iterator[Row]:
    """First audio, and cancel to silence where there is a sound card."""
    yield from attempted(FIRST, _first_audio_row)
    yield from attempted(CANCEL, _silence_row)


def _first_audio_row() -> Iterator[Row]:
    taken = [_first_audio() for _ in range(TIMES)]
    worst = round(max(taken), 5)
    yield amount(FIRST, float(np.median(taken)), "s", at_most(0.010), worst=worst)


def _silence_row() -> Iterator[Row]:
    taken = [_silence() for _ in range(TIMES)]
    # A sound server that is late in a busy machine stalls for seconds, silently.
    worst = round(max(taken), 5)
    yield amount(CANCEL, float(np.median(taken)), "s", at_most(0.060), worst=worst)


def _first_audio() -> float:
    """Seconds from `say` to the first samples at the speaker; the voice is warm."""
    with _speaking(_Ear) as mouth:
        for _ in range(2):
            mouth.speaker.begun = None
            begun = time.perf_counter()
            mouth.voice.say(TEXT)
            first = mouth.wait(lambda: mouth.speaker.begun)
            mouth.voice.hush()
            mouth.tick()
    return first - begun


def _silence() -> float:
    """Seconds from `hush` to the last sample that was heard."""
    with _speaking(_Card) as mouth:
        mouth.voice.say(TEXT)
        mouth.wait(lambda: (mouth.speaker.position(mouth.now()) or 0.0) > WELL_BEGUN or None)
        mouth.speaker.silent = None
        begun = time.perf_counter()
        mouth.voice.hush()
        return mouth.wait(lambda: mouth.speaker.silent) - begun


@dataclass(frozen=True, eq=False)
class _Mouth(Generic[S]):
    """A voice, its speaker, and the loop that drives them."""

    voice: Voice
    speaker: S
    now: Callable[[], float]

    def tick(self) -> None:
        self.voice.compute(self.now(), LOOP)

    def wait(self, ask: Callable[[], float | None]) -> float:
        """Tick until there is an answer."""
        deadline = self.now() + PATIENCE
        pause = threading.Event()
        while (answer := ask()) is None:
            if self.now() > deadline:
                raise HriError("the voice neither begins nor ends - try `hri say hello`")
            self.tick()
            pause.wait(LOOP)
        return answer


@contextmanager
def _speaking(kind: type[S]) -> Iterator[_Mouth[S]]:
    clock = RealClock()
    with ResourceManager((), clock) as resources:
        speaker = kind(Description("speaker", "Hri.Speaker"), resources)
        resources.substitute("speaker", speaker)
        voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), resources)
        resources.substitute("voice", voice)
        behavior = Voice("voice")
        behavior.start(Context(clock, EventBus(clock), resources))
        try:
            yield _Mouth(behavior, speaker, clock.now)
        finally:
            behavior.stop()
