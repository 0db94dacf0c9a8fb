"""Forced alignment of known texts, against the times of voices that know them."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

import numpy as np

from benchmarks.speech.accuracy import outside
from hri.bench.speech.samples import ROBOT
from hri.bench.table import Row, amount, at_most
from hri.core.clock import FakeClock
from hri.core.signals import Speech
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech.aligner import with_times
from hri.speech.grammar import load_grammar
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

WHAT = "forced alignment against the voice's own times"
SENTENCES = 80
"""Of the robot's grammar; those from outside of it come beside them."""
VOICES: tuple[tuple[str, type[Synthesizer], dict[str, str]], ...] = (
    ("heart", NaturalVoice, {}),
    ("espeak en-us", EspeakVoice, {}),
    ("espeak en-gb+m3", EspeakVoice, {"voice": "en-gb+m3"}),
)


def rows() -> Iterator[Row]:
    """Median and 95th percentile of how late the begins of phonemes are found, for each voice."""
    texts = [*load_grammar(ROBOT).sample(SENTENCES), *outside()]
    with ResourceManager((), FakeClock()) as resources:
        for name, kind, parameters in VOICES:
            voice = kind(Description(name, name, parameters), resources)
            voice.activate()
            late = 1e3 * np.array([one for text in texts for one in lateness(voice, text)])
            voice.deactivate()
            yield amount(f"{WHAT}: bias, {name}", float(abs(np.median(late))), "ms", at_most(10.0))
            p95 = float(np.percentile(np.abs(late), 95))
            yield amount(f"{WHAT}: p95, {name}", p95, "ms", at_most(40.0), sounds=len(late))


def lateness(voice: Synthesizer, text: str) -> Iterator[float]:
    """By how many seconds each phoneme that both name alike is found too late."""
    true = voice.synthesize(text)
    found = with_times(Speech(text, true.samples, true.rate))
    made, heard = ([one.name for one in speech.phonemes] for speech in (true, found))
    for begin, other, size in SequenceMatcher(None, made, heard, False).get_matching_blocks():
        for number in range(size):
            yield found.phonemes[other + number].start - true.phonemes[begin + number].start
