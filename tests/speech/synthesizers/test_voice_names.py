"""A voice is found by its name, by a language in words, or by a character."""

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.signals import Prosody
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.voice_names import CHARACTERS, unknown, voice_named
from hri.speech.voice import Voice
from tests.speech.fakes import Stage


@pytest.mark.parametrize(
    ("wanted", "found"),
    [
        ("heart", "heart"),
        ("en-gb+f3", "en-gb+f3"),
        ("German", "de"),
        ("english", "en-us"),
        ("x", ""),
        ("David", "en-us+david"),
        ("Nobody plain", "en-us"),
        ("Nobody x", ""),
    ],
)
def test_a_voice_is_found_by_name_or_language(wanted, found):
    assert voice_named(wanted) == found


def test_every_character_is_there():
    assert all(voice_named(name) == character.voice for name, character in CHARACTERS.items())


def test_what_is_misspelled_is_named():
    assert 'did you mean "robot"' in unknown("robott")
    assert 'did you mean "german"' in unknown("germn")


@pytest.mark.parametrize("kind", [EspeakVoice, NaturalVoice])
def test_a_voice_that_is_not_there_loses_no_sentence(kind):
    notices = []
    manager = ResourceManager((), FakeClock(), notice=notices.append)
    voice = kind(Description("voice", "a voice"), manager)
    voice.activate()
    plain = voice.synthesize("Hello.")
    for _ in range(2):
        other = voice.synthesize("Hello.", Prosody(voice="hart"))
        assert np.array_equal(other.samples, plain.samples)
    (line,) = notices
    assert 'no voice "hart" - did you mean "heart"?' in line
    assert len(voice.synthesize("Hello.", Prosody(voice="robot")).samples) != len(plain.samples)


def test_a_behavior_speaks_with_its_voice_unless_a_text_has_its_own():
    stage = Stage(Voice(voice="robot"))
    asked = []
    synthesizer = stage.behavior._synthesizer
    plainly = synthesizer.synthesize
    synthesizer.synthesize = lambda text, how: asked.append(how.voice) or plainly(text, how)
    stage.behavior.say("a")
    stage.behavior.say("b", prosody=Prosody(voice="warm"))
    stage.run(1.0)
    assert asked == ["robot", "warm"]
