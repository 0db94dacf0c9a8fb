"""Whatever the robot feels, one must understand what it says."""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from functools import partial

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.signals import EmotionState
from hri.emotion.display import load_display
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar import load_grammar
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.turn import Turn
from tests.speech.conftest import HOUSE

GRAMMAR = HOUSE / "benchmarks" / "speech" / "house.jsgf"
COMMANDS = re.findall(r"@example (.+)", GRAMMAR.read_text(encoding="utf-8"))
LEAST_RIGHT = 0.9
"""Of all words; in the plain voice 0.94 are, since "Anna" sounds like "Emma"."""
RATE = 16000
QUIET = np.zeros(4800, np.int16)


@pytest.fixture(scope="module")
def ears():
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    resources = ResourceManager((), FakeClock())
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    recognizer.activate()
    grammar = load_grammar(GRAMMAR)
    recognizer.start(grammar)
    yield partial(recognizer.decode, rules=Turn().rules(grammar))
    recognizer.deactivate()


@pytest.fixture(scope="module")
def voice():
    speaker = EspeakVoice(Description("voice", "Hri.EspeakVoice"), ResourceManager((), FakeClock()))
    speaker.activate()
    return speaker


@pytest.mark.slow
@pytest.mark.parametrize("name", ["joy", "sadness", "anger", "fear", "surprise"])
def test_what_is_said_with_an_emotion_is_recognized(voice, ears, name):
    state = EmotionState(name, 1.0, 0.0, 0.0, 0.0, {name: 1.0})
    prosody = load_display().prosody(state)
    right = 0
    for command in COMMANDS:
        speech = voice.synthesize(command, prosody)
        sound = 0.4 * resample(speech.samples, speech.rate, RATE)
        samples = np.concatenate([QUIET, sound.astype(np.int16), QUIET])
        heard = ears(Segment(0.0, len(samples) / RATE, samples)).text
        same = SequenceMatcher(None, command.split(), heard.split()).get_matching_blocks()
        right += sum(block.size for block in same)

    assert len(COMMANDS) >= 15
    assert right >= LEAST_RIGHT * sum(len(command.split()) for command in COMMANDS)
