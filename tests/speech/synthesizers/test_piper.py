"""Voices of Piper, by the path of a model; without one, espeak-ng says the sentence."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.core.signals import Prosody
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak_library import load_espeak
from hri.speech.synthesizers.piper import PiperReader, PiperVoice, Settings, read_settings

MODEL = os.environ.get("PIPER_MODEL", "")
SETTINGS = {
    "audio": {"sample_rate": 22050},
    "espeak": {"voice": "en-us"},
    "inference": {"length_scale": 1.0},
    "phoneme_id_map": {"_": [0], "^": [1], "$": [2], " ": [3], "a": [4]},
}
READER = PiperReader(load_espeak(), Settings(22050, "en-us", {}, 1.0, 1))


def opened(**parameters):
    notices = []
    manager = ResourceManager((), FakeClock(), notice=notices.append)
    voice = PiperVoice(Description("voice", "Hri.PiperVoice", parameters), manager)
    voice.activate()
    return voice, notices


@pytest.mark.parametrize(
    "settings",
    [
        None,
        "{",
        "[]",
        "{}",
        json.dumps({**SETTINGS, "phoneme_id_map": {"a": [4]}}),
        json.dumps({**SETTINGS, "audio": {"sample_rate": "fast"}}),
        json.dumps(SETTINGS),
    ],
)
def test_without_a_whole_model_espeak_speaks_after_one_line(tmp_path, settings):
    (tmp_path / "voice.onnx").write_bytes(b"half of a model")
    if settings is not None:
        (tmp_path / "voice.onnx.json").write_text(settings)
    voice, notices = opened(model=str(tmp_path / "voice.onnx"))
    assert voice.synthesize("Hello there.").duration > 0.5
    (line,) = notices
    assert "voice.onnx" in line
    assert line.endswith("; espeak-ng speaks")
    assert "\n" not in line


def test_a_voice_without_a_model_is_refused_where_it_stands():
    with pytest.raises(AuthoringError, match="give the path"):
        opened()


def test_settings_are_read(tmp_path):
    (tmp_path / "a.json").write_text(json.dumps(SETTINGS))
    settings = read_settings(tmp_path / "a.json")
    assert (settings.rate, settings.language, settings.speakers) == (22050, "en-us", 1)
    assert settings.ids["a"] == 4


@pytest.mark.parametrize(
    "text", ["It costs $5.20, and I can.", "Yes! We met on 2026-11-24.", "I have been there."]
)
def test_each_symbol_stands_for_a_written_word(text):
    sentences = list(READER.sentences(text))
    assert " ".join(sentence.text for sentence in sentences) == text
    for sentence in sentences:
        assert len(sentence.symbols) == len(sentence.words)
        assert {0, len(sentence.text.split()) - 1} <= set(sentence.words)
        assert list(sentence.words) == sorted(sentence.words)


@given(st.text(max_size=80))
def test_any_text_is_read(text):
    for sentence in READER.sentences(text):
        assert len(sentence.symbols) == len(sentence.words)
        assert all(0 <= word < max(len(sentence.text.split()), 1) for word in sentence.words)


@pytest.mark.skipif(not MODEL, reason="no Piper model - set PIPER_MODEL to the path of an .onnx")
def test_a_model_speaks_with_times_and_always_alike():
    voice, notices = opened(model=MODEL)
    text = "Hello there, it costs $5.20. Good bye."
    speech = voice.synthesize(text)
    assert notices == []
    assert [word.text for word in speech.words] == text.split()
    times = [time for word in speech.words for time in (word.start, word.end)]
    assert times == sorted(times)
    assert times[-1] <= speech.duration
    assert np.array_equal(voice.synthesize(text).samples, speech.samples)
    assert voice.synthesize(text, Prosody(rate=1.5)).duration < 0.8 * speech.duration
    assert Path(MODEL).name in voice.describe()
