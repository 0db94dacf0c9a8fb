from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.core.signals import EmotionState, Prosody, Speech
from hri.emotion.display import load_display
from hri.emotion.emotions import NAMES
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.espeak_library import load_espeak

TEXT = "Hello, I am your robot. It's 3.5 degrees - is that cold? Yes!"


def speaker_of(**parameters: str) -> EspeakVoice:
    resources = ResourceManager((), FakeClock())
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice", parameters), resources)
    voice.activate()
    return voice


@pytest.fixture(scope="module")
def voice() -> EspeakVoice:
    return speaker_of()


@pytest.mark.proves("R01")
def test_words_and_sentences_have_their_places_and_times(voice):
    speech = voice.synthesize(TEXT)

    assert [word.text for word in speech.words] == [
        "Hello,", "I am", "your", "robot.", "It's", "3.5", "degrees", "- is", "that", "cold?",
        "Yes!",
    ]  # fmt: skip
    assert [sentence.text for sentence in speech.sentences] == [
        "Hello, I am your robot.", "It's 3.5 degrees - is that cold?", "Yes!",
    ]  # fmt: skip
    robot = speech.words[3]
    assert 0.3 < robot.end - robot.start < 0.8
    assert speech.heard(robot.end) == "Hello, I am your robot."
    assert speech.heard(robot.end - 0.1) == "Hello, I am your"
    assert speech.sentences[1].start > robot.end, "there is a pause between"


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=60) | st.text("ab.,!? '-[]\n\x01 5", max_size=60))
def test_times_are_in_order_whatever_is_said(text):
    speech = VOICE.synthesize(text)

    for spans in (speech.words, speech.sentences):
        assert all(span.start <= span.end <= speech.duration + 1e-9 for span in spans)
        assert all(a.end <= b.start + 1e-9 for a, b in pairwise(spans))
        assert all(text[span.position :].startswith(span.text) for span in spans)
    ends = [phoneme.start + phoneme.duration for phoneme in speech.phonemes]
    starts = [phoneme.start for phoneme in speech.phonemes]
    assert ends[:-1] == pytest.approx(starts[1:])
    assert not ends or ends[-1] == pytest.approx(speech.duration)


VOICE = speaker_of()


@pytest.mark.parametrize("text", ["<prosody rate='x-slow'>", "\x01400S", "[[h@loU]]", "&lt;"])
def test_no_text_breaks_out_of_being_read(voice, text):
    plain = voice.synthesize("Good morning everybody.")
    after = voice.synthesize(f"{text} Good morning everybody.")

    first = next(i for i, word in enumerate(after.words) if word.text == "Good")
    changed = after.words[first + 2].end - after.words[first + 1].start
    expected = plain.words[2].end - plain.words[1].start
    assert changed == pytest.approx(expected, rel=0.1)


def test_the_sound_comes_in_parts_that_go_on_where_the_last_ended(voice):
    parts: list[Speech] = []
    whole = voice.stream(TEXT, Prosody(), parts.append, lambda: True)

    assert np.array_equal(whole.samples, voice.synthesize(TEXT).samples)
    assert parts[0].duration < 0.1
    assert parts[-1] is whole
    for before, after in pairwise(parts):
        assert np.array_equal(after.samples[: len(before.samples)], before.samples)


def test_what_is_no_longer_wanted_ends_within_a_block(voice):
    parts: list[Speech] = []
    speech = voice.stream(TEXT * 20, Prosody(), parts.append, lambda: len(parts) < 2)

    assert speech.duration < 0.3
    assert np.array_equal(voice.synthesize(TEXT).samples, VOICE.synthesize(TEXT).samples)


def test_an_error_of_who_listens_is_not_lost_in_the_library(voice):
    def fail(speech: Speech) -> None:
        raise OSError("no ear")

    with pytest.raises(OSError, match="no ear"):
        voice.stream(TEXT, Prosody(), fail, lambda: True)


@pytest.mark.parametrize("name", ["en-gb", "en-us+m3", "de"])
def test_a_voice_sounds_the_same_whoever_spoke_before(name):
    first = speaker_of(voice=name).synthesize(TEXT).samples
    speaker_of(voice="fr").synthesize(TEXT)

    assert np.array_equal(speaker_of(voice=name).synthesize(TEXT).samples, first)
    assert not np.array_equal(VOICE.synthesize(TEXT).samples, first)


@pytest.mark.parametrize(
    ("name", "remedy"), [("en-uk", '"en-us"|"en-gb"'), ("en-us+f33", '"f3"'), ("x", "hri voices")]
)
def test_a_voice_that_is_not_there_has_a_remedy(name, remedy):
    with pytest.raises(AuthoringError, match=remedy):
        speaker_of(voice=name)


def test_a_text_of_minutes_is_no_burden(voice):
    speech = voice.synthesize("This is one of many sentences. " * 60)

    assert speech.duration > 90
    assert len(speech.sentences) == 60


def test_the_user_s_lexicon_says_how_names_sound(tmp_path):
    path = tmp_path / "lexicon.txt"
    path.write_text("xiomara  S IY OW M AA1 R AH\n", encoding="utf-8")

    known = speaker_of(lexicon=str(path)).synthesize("Hello (Xiomara), you.")

    names = [phoneme.name for phoneme in known.phonemes]
    assert [name for name in names if name[0] in "sSmMoO"] == ["oU", "s", "oU", "m"]
    assert [word.text for word in known.words] == ["Hello", "(Xiomara),", "you."]


def test_pitch_and_range_are_factors_of_what_is_heard(voice):
    plain, high = (melody(voice, Prosody(pitch=pitch)) for pitch in (1.0, 1.2))
    flat, wide = (melody(voice, Prosody(range=range)) for range in (0.5, 1.5))

    assert np.median(high) / np.median(plain) == pytest.approx(1.2, abs=0.07)
    assert semitones(flat) < 0.75 * semitones(plain)
    assert semitones(wide) > 1.2 * semitones(plain)


def melody(voice, prosody):
    """Hz every 20 ms where there is a voice, by autocorrelation."""
    speech = voice.synthesize("Where are you, my dear old friend? I wonder.", prosody)
    width, low, high = speech.rate // 25, speech.rate // 250, speech.rate // 60
    found = []
    for start in range(0, len(speech.samples) - width, speech.rate // 50):
        frame = speech.samples[start : start + width].astype(float)
        repeats = np.correlate(frame, frame, "full")[width - 1 :] / np.arange(width, 0, -1)
        best = low + int(np.argmax(repeats[low:high]))
        if np.abs(frame).max() > 3000 and repeats[best] > 0.6 * repeats[0]:
            strong = np.flatnonzero(repeats[low:high] > 0.92 * repeats[best]) + low
            found.append(speech.rate / strong[0])
    return np.array(found)


def semitones(hertz):
    return 12 * np.log2(np.percentile(hertz, 85) / np.percentile(hertz, 15))


@pytest.mark.parametrize("name", NAMES)
def test_no_emotion_overdrives_the_voice(voice, name):
    state = EmotionState(name, 1.0, 0.0, 0.0, 0.0, {name: 1.0})
    speech = voice.synthesize(TEXT, load_display().prosody(state))

    loudest = np.abs(speech.samples.astype(int)).max()
    assert 8000 < loudest < 32000, "neither clipped nor lost in the noise of a room"


def test_voices_are_listed_with_what_to_ask_for():
    library = load_espeak()

    assert {"en-us", "en-gb", "de"} <= {voice.id for voice in library.voices()}
    assert {"f3", "m1"} <= {voice.id for voice in library.variants()}
    assert all(library.has_voice(voice) for voice in ("de", "en-gb", "en-us+f3", "EN-US"))
    assert not any(library.has_voice(voice) for voice in ("zz", "en-us+nobody", "../de", ""))


def test_one_text_may_be_said_by_another_voice(voice):
    other = speaker_of(voice="de").synthesize("guten Morgen")

    assert (voice.synthesize("guten Morgen", Prosody(voice="de")).samples == other.samples).all()
    assert voice.synthesize("guten Morgen").duration != other.duration
