"""The eight voices that say commands and sentences from outside of their grammar.

slt and awb of flite were never learned from: they show what becomes of a new speaker.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from functools import cache, partial

import numpy as np

from hri.bench.speech import flite_voices
from hri.bench.speech.flite_voices import LEAD, RATE, TAIL
from hri.bench.speech.samples import Clip
from hri.core.clock import FakeClock
from hri.core.signals import Samples
from hri.hal.drivers.resampling import resample
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

NEW = ("slt", "awb")
"""Voices that nothing was learned from."""


def spoken(sentences: Sequence[str], voices: Collection[str] = ()) -> Iterator[Clip]:
    """Each sentence in each of these voices, or in all, between silences.

    Raises NotAvailable without flite.
    """
    for sentence in sentences:
        for voice in voices or VOICES:
            yield Clip(f"{voice}/{sentence}", VOICES[voice](sentence), sentence, voice=voice)


def _flite(voice: str, text: str) -> Samples:
    return flite_voices.say(text, voice)


@cache
def _synthesizer(kind: type[Synthesizer], voice: str) -> Synthesizer:
    parameters = {"voice": voice} if voice else {}
    synthesizer = kind(Description(voice, kind.__name__, parameters), _resources())
    synthesizer.activate()
    return synthesizer


@cache
def _resources() -> ResourceManager:
    return ResourceManager((), FakeClock())


@cache
def _own(kind: type[Synthesizer], voice: str, text: str) -> Samples:
    speech = _synthesizer(kind, voice).synthesize(text)
    said = resample(speech.samples, speech.rate, RATE)
    return np.pad(said, (round(LEAD * RATE), round(TAIL * RATE)))


VOICES: dict[str, Callable[[str], Samples]] = {
    "slt": partial(_flite, "slt"),
    "awb": partial(_flite, "awb"),
    "rms": partial(_flite, "rms"),
    "kal": partial(_flite, "kal"),
    "kal16": partial(_flite, "kal16"),
    "heart": partial(_own, NaturalVoice, ""),
    "en-us": partial(_own, EspeakVoice, "en-us"),
    "en-gb+f3": partial(_own, EspeakVoice, "en-gb+f3"),
}
TALKERS: dict[str, Callable[[str], Samples]] = VOICES | {
    name: partial(_own, EspeakVoice, name)
    for name in ("en-gb+m3", "en-gb-scotland", "en-us+f2", "en-029+m7")
}
"""Who talks to each other: more of them, for long talks."""
