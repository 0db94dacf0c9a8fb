"""How soon a voice begins, how soon it is silent, and what the natural voice takes."""

from __future__ import annotations

import json
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

from hri.behavior.behavior import Context
from hri.bench.speech.listening import ONE_CORE
from hri.bench.table import Row, amount, at_least, at_most, attempted, share
from hri.core import child
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Samples, Speech
from hri.hal.drivers.sound_card import SoundCardSpeaker
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import PLAIN, Synthesizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.voice import Voice

TEXT = "I have heard you, and I am on my way to the kitchen. It will take me about a minute."
FIRST = "first audio of say, median"
CANCEL = "cancel to silence, median"
NATURAL = "real-time factor of the natural voice, one core"
PROGRAM = Path(__file__).with_name("natural_voice_process.py")
TIMES = 20
STARTS = 3
LONG = 10
"""Times that TEXT is said in a long text."""
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

    def _give(self, out: Any, frames: int, stamp: object, status: object) -> None:
        super()._give(out, frames, stamp, status)
        if self.silent is None and not out.any():
            self.silent = time.perf_counter() + self._stream.latency


def rows() -> Iterator[Row]:
    """First audio, and cancel to silence where there is a sound card, of espeak-ng and heart."""
    for kind, name, soon in ((EspeakVoice, "", 0.010), (NaturalVoice, ", natural voice", 0.150)):
        yield from attempted(FIRST + name, partial(_first_audio_row, kind, FIRST + name, soon))
        yield from attempted(CANCEL + name, partial(_silence_row, kind, CANCEL + name))
    yield from attempted(NATURAL, _natural_rows)


def _first_audio_row(kind: type[Synthesizer], what: str, soon: float) -> Iterator[Row]:
    taken = [_first_audio(kind) for _ in range(TIMES)]
    worst = round(max(taken), 5)
    yield amount(what, float(np.median(taken)), "s", at_most(soon), worst=worst)


def _silence_row(kind: type[Synthesizer], what: str) -> Iterator[Row]:
    taken = [_silence(kind) for _ in range(TIMES)]
    # A sound server that is late in a busy machine stalls for seconds, silently.
    worst = round(max(taken), 5)
    yield amount(what, float(np.median(taken)), "s", at_most(0.060), worst=worst)


def _natural_rows() -> Iterator[Row]:
    """Time, memory and sameness in fresh processes; how late the sentences of a long text are."""
    runs = [_natural_process() for _ in range(STARTS)]
    factor, ready = (
        float(np.median([run[name] for run in runs])) for name in ("factor", "ready_s")
    )
    yield amount(NATURAL, factor, "s/s", at_most(0.05), ready_s=round(ready, 3))
    if memory := max(run["bytes"] for run in runs) / 1e6:
        yield amount("memory of the natural voice", memory, "MB", at_most(120.0))
    same = sum(run["digest"] == runs[0]["digest"] for run in runs)
    yield share("the same samples in every process, natural voice", same, STARTS, at_least(1.0))
    yield amount("gap between the sentences of a long text", _gap(), "s", at_most(0.0))


def _natural_process() -> dict[str, Any]:
    command = child.command(PROGRAM, TEXT)
    environment = child.environment(**ONE_CORE)
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        raise HriError(f"{PROGRAM.name} failed: {done.stderr[-500:].strip()} - run it by hand")
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures


def _gap() -> float:
    """By how many seconds the latest sentence of a long text comes after the end of the one before.

    The first sentence begins to sound as soon as it is made.
    """
    begun: float | None = None
    heard, late = 0.0, 0.0

    def take(speech: Speech) -> None:
        nonlocal begun, heard, late
        now = time.perf_counter()
        begun = now if begun is None else begun
        late = max(late, now - begun - heard if heard else 0.0)
        heard = speech.duration

    with _opened(NaturalVoice) as voice:
        voice.stream(" ".join([TEXT] * LONG), PLAIN, take, lambda: True)
    return late


@contextmanager
def _opened(kind: type[Synthesizer]) -> Iterator[Synthesizer]:
    with ResourceManager((), RealClock()) as resources:
        voice = kind(Description("voice", kind.__name__), resources)
        voice.activate()
        try:
            yield voice
        finally:
            voice.deactivate()


def _first_audio(kind: type[Synthesizer]) -> float:
    """Seconds from `say` to the first samples at the speaker; the voice is warm."""
    with _speaking(kind, _Ear) as mouth:
        for _ in range(2):
            mouth.speaker.begun = None
            begun = time.perf_counter()
            mouth.voice.say(TEXT)
            first = mouth.wait(lambda: mouth.speaker.begun)
            mouth.voice.hush()
            mouth.tick()
    return first - begun


def _silence(kind: type[Synthesizer]) -> float:
    """Seconds from `hush` to the last sample that was heard."""
    with _speaking(kind, _Card) as mouth:
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
def _speaking(made_by: type[Synthesizer], kind: type[S]) -> Iterator[_Mouth[S]]:
    clock = RealClock()
    with ResourceManager((), clock) as resources:
        speaker = kind(Description("speaker", "Hri.Speaker"), resources)
        resources.substitute("speaker", speaker)
        voice = made_by(Description("voice", made_by.__name__), resources)
        resources.substitute("voice", voice)
        behavior = Voice("voice")
        behavior.start(Context(clock, EventBus(clock), resources))
        try:
            yield _Mouth(behavior, speaker, clock.now)
        finally:
            behavior.stop()
