"""Sentences with numbers and names, said as people write them, heard back by the recognizer."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hri.bench.table import Row, at_least, share
from hri.core.clock import FakeClock
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.numerals import in_words
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

WHAT = "sentences with numbers and names, heard back"
GRAMMAR = Path(__file__).with_name("spoken.jsgf")
SENTENCES = 200
QUIET = 4800
"""Samples of silence around each."""
_NUMBERS = {in_words(str(number)): str(number) for number in range(1, 100)}
_NAMES = re.findall(r"\w+", GRAMMAR.read_text().partition("<name> =")[2].partition(";")[0])
_CLOCK = re.compile(r"at (\d+) (\d+)$")


def rows() -> Iterator[Row]:
    """How many of the sentences are recognized word by word, of both voices."""
    grammar = load_grammar(GRAMMAR)
    chance = random.Random(26)
    sentences = [random_sentence(grammar, chance) for _ in range(SENTENCES)]
    espeak = heard_back(EspeakVoice, grammar, sentences)
    yield share(f"{WHAT}, espeak-ng", espeak, SENTENCES, None)
    natural = heard_back(NaturalVoice, grammar, sentences)
    yield share(
        f"{WHAT}, natural voice", natural, SENTENCES, at_least(max(0.99, espeak / SENTENCES))
    )


def heard_back(kind: type[Synthesizer], grammar: Grammar, sentences: list[str]) -> int:
    """How many sentences of a grammar are recognized when a voice says them."""
    with ResourceManager((), FakeClock()) as resources:
        voice = kind(Description("voice", kind.__name__), resources)
        ears = CtcRecognizer(Description("ears", "Hri.CtcRecognizer"), resources)
        voice.activate()
        ears.activate()
        ears.start(grammar)
        found = 0
        for sentence in sentences:
            speech = voice.synthesize(written(sentence))
            samples = np.pad(resample(speech.samples, speech.rate, ears.rate), QUIET)
            heard = ears.decode(Segment(0.0, len(samples) / ears.rate, samples))
            found += heard.text == sentence
        ears.deactivate()
        voice.deactivate()
    return found


def written(sentence: str) -> str:
    """As people write it: numbers in digits, a time with its colon, names with capital letters."""
    longest = sorted(_NUMBERS, key=len, reverse=True)
    digits = re.sub(rf"\b({'|'.join(longest)})\b", lambda m: _NUMBERS[m[0]], sentence)
    named = re.sub(rf"\b({'|'.join(_NAMES)})\b", lambda m: m[0].capitalize(), digits)
    timed = _CLOCK.sub(r"at \1:\2", named)
    return f"{timed[0].upper()}{timed[1:]}."
