"""Sounds among the words of a text."""

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Prosody, VoiceQuality
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import PLAIN
from hri.speech.ssml import MOST_SOUNDS, Ssml, combined, spoken
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.vocalizations.in_text import (
    SoundMark,
    check_sounds,
    has_sounds,
    parted,
)


def test_a_text_is_parted_into_words_and_sounds():
    assert list(parted("[giggle] That tickles! [sigh soft long]")) == [
        SoundMark("[giggle]", "giggle"),
        "That tickles!",
        SoundMark("[sigh soft long]", "sigh", "soft", "long"),
    ]
    assert [part.name for part in parted("[mm-hm][hm?]")] == ["mm-hm", "hm?"]


@pytest.mark.parametrize(
    "text",
    [
        "a list [1] of things",
        "[foo]",
        "[giggle loud]",
        "[sigh soft strong]",
        "[Giggle]",
        "[",
        "[]",
        "",
    ],
)
def test_other_brackets_are_text(text):
    assert not has_sounds(text)
    assert list(parted(text)) == ([text] if text else [])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Oh, [gigle] yes.", r'no sound \[gigle\] - did you mean "giggle"'),
        ("[sigh loud] Well.", r"no sound \[sigh loud\] - write soft or strong, short or long"),
    ],
)
def test_a_slip_in_a_reply_is_refused(text, message):
    check_sounds("[giggle] A list [1] of things [sigh soft].")
    with pytest.raises(HriError, match=message):
        check_sounds(text)


def test_the_words_alone():
    assert Ssml.of_text("[giggle] That [hm?] tickles.").without_sounds().text == "That tickles."
    assert Ssml.parse("<speak>[giggle] <s>Yes.</s></speak>").without_sounds().text == "Yes."
    assert Ssml.of_text("[giggle]").without_sounds().text == ""


def test_no_text_makes_sounds_without_end():
    pieces = Ssml.of_text("[laugh long]" * 100_000).pieces
    assert sum(isinstance(piece, SoundMark) for piece in pieces) == MOST_SOUNDS
    with pytest.raises(AuthoringError, match=f"more than {MOST_SOUNDS} sounds"):
        Ssml.parse("<speak>" + "[laugh]" * (MOST_SOUNDS + 1) + "</speak>")


def test_the_quality_of_a_voice_goes_on_in_markup():
    quality = VoiceQuality(breath=0.5)
    assert combined(Prosody(quality=quality), Prosody(rate=1.2)).quality == quality


@pytest.fixture(scope="module")
def voice():
    with ResourceManager((), FakeClock()) as resources:
        voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), resources)
        voice.activate()
        yield voice
        voice.deactivate()


def said(document, voice, prosody=PLAIN):
    return spoken(document, voice, prosody, lambda speech: None, lambda: True)


def test_a_sound_comes_where_it_stands(voice):
    text = "Hello. [laugh] How are you?"
    speech = said(Ssml.of_text(text), voice)
    assert speech.text == text
    assert [word.text for word in speech.words] == ["Hello.", "How", "are", "you?"]
    assert [text[word.position :].split()[0] for word in speech.words][1] == "How"
    gap = speech.words[1].start - speech.words[0].end
    assert 1.5 < gap < 2.6
    laughs = [span for span in speech.sentences if span.text == "[laugh]"]
    assert [span.position for span in laughs] == [7]
    assert speech.words[0].end < laughs[0].start < laughs[0].end < speech.words[1].start


def test_markup_has_sounds_too_as_loud_as_the_words(voice):
    document = Ssml.parse("<speak>Hello. <p>[sigh] Well.</p></speak>")
    assert document.text == "Hello. [sigh] Well."
    quiet, loud = (said(document, voice, Prosody(volume=volume)) for volume in (0.5, 1.0))
    assert 0 < abs(quiet.samples.astype(int)).max() < abs(loud.samples.astype(int)).max()


def test_markup_that_says_nothing_is_still_refused():
    assert Ssml.parse("<speak>[giggle]</speak>").text == "[giggle]"
    with pytest.raises(AuthoringError):
        Ssml.parse("<speak> </speak>")
