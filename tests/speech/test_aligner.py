"""Times for sounds that came without any, against voices that know theirs."""

from difflib import SequenceMatcher
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.signals import Speech
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.aligner import LONGEST, spoken_words, with_times
from hri.speech.recognizers.ctc.alignment import DELAYS, PAUSE, Peak, phonemes, placed
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

SENTENCES = (
    "My mother may know where all the yellow lemons are in the morning.",
    "Please bring the blue cup to my kitchen, and put it on the table.",
    "I can tell you the time, or a joke about robots.",
    "Papa, who moved the two big boots away from the fire?",
    "The weather will remain the same all over the country tomorrow.",
    "She has bought five fresh fish at the harbor.",
)


def opened(kind, **parameters):
    voice = kind(Description("voice", "a voice", parameters), ResourceManager((), FakeClock()))
    voice.activate()
    return voice


def without_times(speech, text=""):
    return Speech(text, speech.samples, speech.rate)


def matched(true, found):
    """The starts of phonemes that both have, in pairs."""
    names = [[one.name for one in speech.phonemes] for speech in (true, found)]
    for begin, other, size in SequenceMatcher(None, *names, False).get_matching_blocks():
        for number in range(size):
            yield true.phonemes[begin + number].start, found.phonemes[other + number].start


@pytest.mark.parametrize(
    "voice", [(NaturalVoice, {}), (EspeakVoice, {}), (EspeakVoice, {"voice": "en-gb+m3"})]
)
def test_sounds_of_a_known_text_are_found_where_the_voice_made_them(voice):
    kind, parameters = voice
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    speaker = opened(kind, **parameters)
    pairs = []
    for text in SENTENCES:
        true = speaker.synthesize(text)
        pairs += matched(true, with_times(without_times(true, text)))
    late = np.array([found - made for made, found in pairs])
    assert len(late) > 150
    assert abs(np.median(late)) < 0.010
    assert np.percentile(np.abs(late), 95) < 0.045


def test_words_as_people_write_them_have_their_times():
    text = "It is 7 o'clock, and I have 23 apples."
    found = with_times(without_times(opened(EspeakVoice).synthesize(text), text))
    assert [word.text for word in found.words] == text.split()
    assert all(text[word.position :].startswith(word.text) for word in found.words)
    times = [time for word in found.words for time in (word.start, word.end)]
    assert times == sorted(times)
    (sentence,) = found.sentences
    assert (sentence.start, sentence.end) == (times[0], times[-1])


def test_a_pause_between_two_words_is_one():
    voice = opened(EspeakVoice)
    first, second = (voice.synthesize(text) for text in ("Come here", "please"))
    silence = np.zeros(first.rate, np.int16)
    samples = np.concatenate((first.samples, silence, second.samples))
    found = with_times(Speech("Come here please", samples, first.rate))
    pause = next(p for p in found.phonemes if p.name == PAUSE and p.start > 0.2)
    assert pause.start == pytest.approx(first.duration, abs=0.1)
    assert pause.start + pause.duration == pytest.approx(first.duration + 1.0, abs=0.1)


def test_without_a_text_the_lips_still_close():
    true = opened(EspeakVoice).synthesize("Papa, papa, papa, papa.")
    found = with_times(without_times(true))
    closed, heard = ([p.start for p in s.phonemes if p.name == "p"] for s in (true, found))
    assert len(closed) == 8
    assert len(heard) >= 7
    assert all(min(abs(one - other) for other in closed) < 0.06 for one in heard)


def test_what_is_no_speech_has_no_phonemes():
    chance = np.random.default_rng(1)
    noise = chance.normal(0, 2000, 48_000).astype(np.int16)
    tone = (8000 * np.sin(np.arange(48_000) / 10)).astype(np.int16)
    for samples in (noise, tone, np.zeros(48_000, np.int16), np.zeros(0, np.int16)):
        assert with_times(Speech("", samples, 16_000)).phonemes == ()


@pytest.mark.parametrize(
    ("text", "seconds", "what"),
    [
        ("안녕하세요", 1.0, "Latin letters"),
        ("word " * 2000, 1.0, "at most"),
        ("The weather is nice in the mountains.", 3.0, "hardly"),
        ("far more words than there is time for " * 5, 0.2, "hardly"),
        ("", LONGEST + 1, "cut it into parts"),
    ],
)
def test_what_cannot_be_aligned_is_one_line(text, seconds, what):
    with pytest.raises(HriError, match=what) as raised:
        with_times(Speech(text, np.zeros(round(seconds * 8000), np.int16), 8000))
    assert "\n" not in str(raised.value)


@settings(max_examples=25)
@given(st.text(max_size=40), st.integers(0, 9000), st.sampled_from((8000, 22050, 44100)))
def test_any_text_and_any_sound_are_aligned_or_refused(text, length, rate):
    samples = np.random.default_rng(length).integers(-9000, 9000, length).astype(np.int16)
    try:
        speech = with_times(Speech(text, samples, rate))
    except HriError:
        return
    assert all(one.duration > 0 for one in speech.phonemes)


@given(st.lists(st.tuples(st.sampled_from(sorted(DELAYS)), st.floats(0.0, 5.0)), max_size=40))
def test_phonemes_follow_each_other(heard):
    times = sorted(time for _, time in heard)
    peaks = [Peak(name, 0, time) for (name, _), time in zip(heard, times, strict=True)]
    sound = np.random.default_rng(0).integers(-9000, 9000, 5 * 16000).astype(np.int16)
    found = list(phonemes(placed(peaks, sound, 16000), 5.0))
    assert sum(one.name != PAUSE for one in found) == len(peaks)
    for one, after in pairwise(found):
        assert one.start + one.duration <= after.start + 1e-9
        assert one.duration > 0


@given(st.text(max_size=60))
def test_each_spoken_word_stands_for_a_written_one(text):
    count = len(text.split())
    for word, origin in spoken_words(text):
        assert word.replace("'", "").isascii()
        assert 0 <= origin < count
