"""Whatever the robot feels, one must understand what it says."""

from __future__ import annotations

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

COMMANDS = ("go forward ten meters", "turn right", "show me a happy face", "what is your name")
RATE = 16000
QUIET = np.zeros(4800, np.int16)


@pytest.fixture(scope="module")
def ears():
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    resources = ResourceManager((), FakeClock())
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    recognizer.activate()
    companion = load_grammar(HOUSE / "grammars" / "companion.jsgf")
    recognizer.start(companion)
    yield partial(recognizer.decode, rules=Turn().rules(companion))
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
    heard = []
    for command in COMMANDS:
        speech = voice.synthesize(command, prosody)
        sound = 0.4 * resample(speech.samples, speech.rate, RATE)
        samples = np.concatenate([QUIET, sound.astype(np.int16), QUIET])
        heard.append(ears(Segment(0.0, len(samples) / RATE, samples)).text)

    assert heard == list(COMMANDS)
