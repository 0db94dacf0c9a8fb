from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Prosody
from hri.hal.resource import Description
from hri.speech.pronunciation import phones
from hri.speech.pronunciation.dictionary import cmu_dictionary
from hri.speech.pronunciation.letter_to_sound import pronounce
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.pyttsx3 import Pyttsx3Voice, platform_voices

TEXT = "Hello, I am your robot."


@pytest.fixture
def espeak(resources):
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), resources)
    voice.activate()
    return voice


def test_espeak_gives_sound_and_phonemes_in_time(espeak):
    speech = espeak.synthesize(TEXT)

    assert speech.rate == 22050
    assert speech.samples.dtype == np.int16
    assert 1.0 < speech.duration < 3.0
    assert np.abs(speech.samples).max() > 5000
    names = [phoneme.name for phoneme in speech.phonemes]
    assert names[:4] == ["h", "@", "l", "oU"]
    assert speech.phonemes[3].stressed
    assert not speech.phonemes[0].stressed
    starts = [phoneme.start for phoneme in speech.phonemes]
    assert starts == sorted(starts)
    assert all(phoneme.duration >= 0 for phoneme in speech.phonemes)
    last = speech.phonemes[-1]
    assert last.start + last.duration == pytest.approx(speech.duration)


def test_the_same_text_gives_the_same_samples_whatever_was_said_before(espeak):
    first = espeak.synthesize(TEXT)
    espeak.synthesize("Something else?", Prosody(rate=1.4, pitch=1.3))
    again = espeak.synthesize(TEXT)

    assert np.array_equal(first.samples, again.samples)
    assert first.phonemes == again.phonemes


def test_prosody_scales_the_voice(espeak):
    plain = espeak.synthesize(TEXT)

    assert espeak.synthesize(TEXT, Prosody(rate=1.5)).duration < 0.8 * plain.duration
    quiet = espeak.synthesize(TEXT, Prosody(volume=0.3)).samples
    assert np.abs(quiet).max() < 0.5 * np.abs(plain.samples).max()
    assert pitch(espeak.synthesize(TEXT, Prosody(pitch=1.8))) > 1.1 * pitch(plain)


def pitch(speech):
    """Hz of the strongest repetition in a vowel."""
    vowel = next(phoneme for phoneme in speech.phonemes if phoneme.name == "oU")
    start = round(vowel.start * speech.rate)
    sound = speech.samples[start : start + speech.rate // 10].astype(float)
    repeats = np.correlate(sound, sound, "full")[len(sound) - 1 :]
    periods = range(speech.rate // 250, speech.rate // 70)
    strong = 0.8 * max(repeats[period] for period in periods)
    return speech.rate / next(period for period in periods if repeats[period] > strong)


@pytest.mark.parametrize("text", ["", "   ", "...", "\0", "\N{SNOWMAN}", "a" * 6000, "<b>&amp;"])
def test_odd_texts_do_no_harm(espeak, text):
    assert espeak.synthesize(text).rate == 22050


def test_an_unknown_voice_is_refused_with_its_place(resources):
    description = Description("voice", "Hri.EspeakVoice", {"voice": "martian"})
    with pytest.raises(AuthoringError, match='no voice "martian"'):
        EspeakVoice(description, resources).activate()


def test_words_are_pronounced_like_the_dictionary_says():
    dictionary = cmu_dictionary()
    for word in ("robot", "seven", "thing", "measure", "judge", "boy"):
        guessed, right = pronounce(word), dictionary.pronunciations(word)[0]
        assert abs(len(guessed) - len(right)) <= 1
        assert set(guessed) & set(right)
    with pytest.raises(HriError, match="nobody knows how"):
        pronounce("...")


def test_all_phones_of_the_table_are_the_engine_s():
    from hri.speech.pronunciation.letter_to_sound import PHONES

    assert {phone for said in PHONES.values() for phone in said.split()} <= set(phones.PHONES)


def test_pyttsx3_speaks_one_sentence_after_the_other_in_silence(resources, capfd):
    voice = Pyttsx3Voice(Description("voice", "Hri.Pyttsx3Voice"), resources)
    voice.activate()
    try:
        first, second = voice.synthesize("Hello there."), voice.synthesize("Good bye, my friend.")
    except HriError as error:
        pytest.skip(str(error))

    assert 0.3 < first.duration < second.duration < 4.0
    assert {"h", "l", "oU"} <= {phoneme.name for phoneme in first.phonemes}
    assert capfd.readouterr().out == ""
    assert not list(Path().glob("*.wav"))


def test_a_platform_s_voices_are_listed(monkeypatch):
    monkeypatch.setattr("hri.speech.synthesizers.pyttsx3.sys.platform", "darwin")
    try:
        voices = platform_voices()
    except HriError as error:
        pytest.skip(str(error))

    assert all(voice.id and voice.gender in ("male", "female", "") for voice in voices)
    assert "en-us" in {voice.language for voice in voices}


def test_linux_has_no_voices_but_those_of_espeak(monkeypatch):
    monkeypatch.setattr("hri.speech.synthesizers.pyttsx3.sys.platform", "linux")
    assert platform_voices() == ()


def test_a_platform_without_voices_is_one_line(monkeypatch):
    monkeypatch.setattr("hri.speech.synthesizers.pyttsx3.sys.platform", "darwin")
    monkeypatch.setattr("hri.speech.synthesizers.pyttsx3._PROGRAM", Path("no such program.py"))
    with pytest.raises(HriError, match=r"pyttsx3: .* - use Hri\.EspeakVoice"):
        platform_voices()
