from __future__ import annotations

from hypothesis import given, strategies as st

from hri.core.signals import Prosody
from hri.hal.resource import Description
from hri.speech.synthesizers.silent import SECONDS_A_LETTER, SilentVoice


def speak(text: str, rate: float = 1.0):
    return SilentVoice(Description("voice", "Hri.SilentVoice"), None).synthesize(  # type: ignore
        text, Prosody(rate=rate)
    )


def test_words_and_sentences_have_times():
    speech = speak("Hi you. Come - now!")

    assert [(word.text, round(word.start, 2)) for word in speech.words] == [
        ("Hi", 0.0), ("you.", 0.12), ("Come", 0.3), ("now!", 0.54),
    ]  # fmt: skip
    assert [sentence.text for sentence in speech.sentences] == ["Hi you.", "Come - now!"]
    assert speech.heard(0.31) == "Hi you."


@given(st.text(), st.floats(0.5, 2.0))
def test_it_lasts_as_long_as_it_has_letters(text, rate):
    speech = speak(text, rate)

    letters = len(speech.phonemes)
    assert abs(speech.duration - letters * SECONDS_A_LETTER / rate) < 1e-4
    assert not speech.samples.any()
    assert all(text[word.position :].startswith(word.text) for word in speech.words)
