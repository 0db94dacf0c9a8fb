"""The curve of the pitch with the tones of its phrases."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.speech.notation.intonation import Tone
from hri.speech.synthesizers.natural_melody import LIFTED_DB, RELEASE, Phrase, bent, lifted

FALLING = np.concatenate([np.full(60, 240.0), np.linspace(240, 150, 40)]).astype(np.float32)
RISING = np.concatenate([np.full(60, 200.0), np.linspace(200, 240, 40)]).astype(np.float32)
LOUD = np.ones(100, bool)
LAST = 20
"""Frames of the last 250 ms."""


def semitones(curve, loud=LOUD):
    """How far the last of the voice goes up."""
    voice = curve[(curve > 40) & loud][-LAST:]
    return 12 * np.log2(voice[-1] / voice[0])


@pytest.mark.parametrize("curve", [FALLING, RISING], ids=["falling", "rising"])
@pytest.mark.parametrize(
    ("tone", "least", "most"),
    [
        (Tone.RISE, 2.5, 9.0),
        (Tone.CONTINUE, 0.8, 4.0),
        (Tone.LEVEL, -2.0, 2.0),
        (Tone.FALL, -12.0, -1.0),
        (Tone.STRONG_FALL, -14.0, -1.0),
    ],
)
def test_a_phrase_ends_in_its_tone(curve, tone, least, most):
    assert least < semitones(bent(curve, LOUD, [Phrase(0, 100, tone)])) < most


@pytest.mark.parametrize("tone", Tone)
def test_the_tone_is_in_what_is_heard(tone):
    """The network's voice dies away in its last frames, with a pitch that means nothing."""
    heard = np.arange(100) < 80
    curve = bent(FALLING, heard, [Phrase(0, 100, tone)])
    whole = bent(FALLING[:80], heard[:80], [Phrase(0, 80, tone)])
    assert curve[:80] == pytest.approx(whole)


def test_the_next_phrase_comes_back_to_its_own_pitch():
    phrases = [Phrase(0, 50, Tone.RISE), Phrase(50, 100, Tone.FALL)]
    curve = bent(FALLING, LOUD, phrases)
    assert curve[50 + RELEASE : 65] == pytest.approx(FALLING[50 + RELEASE : 65])
    assert np.abs(12 * np.log2(curve[1:] / curve[:-1])).max() < 2, "without a jump"


@pytest.mark.parametrize("tone", Tone)
def test_where_there_is_no_voice_nothing_changes(tone):
    curve = FALLING.copy()
    curve[70:75] = 0.0
    assert (bent(curve, LOUD, [Phrase(0, 100, tone)])[70:75] == 0.0).all()


@pytest.mark.parametrize("tone", Tone)
def test_the_edges_of_a_voice_do_not_mislead_it(tone):
    """The curve comes from 0 where a voice begins, and goes there where it ends."""
    curve = FALLING.copy()
    curve[74:80] = 70.0, 50.0, 0.0, 0.0, 55.0, 120.0
    plain, changed = (bent(one, LOUD, [Phrase(0, 100, tone)]) for one in (FALLING, curve))
    voice = changed > 40
    assert 12 * np.log2(changed[voice] / plain[voice]) == pytest.approx(0, abs=2)


def test_the_end_of_a_question_does_not_die_away():
    loudness = np.concatenate([np.zeros(80), np.full(20, -16.0)])
    gain = lifted(loudness, [Phrase(0, 100, Tone.RISE)])
    assert gain[90] == pytest.approx(16.0 - LIFTED_DB)
    assert not gain[:70].any()
    assert not lifted(loudness, [Phrase(0, 100, Tone.FALL)]).any()


@given(
    st.lists(st.floats(0, 600), min_size=1, max_size=60),
    st.lists(st.booleans(), min_size=60, max_size=60),
    st.sampled_from(Tone),
)
def test_no_curve_leaves_the_range_of_a_voice(hertz, loud, tone):
    curve = np.array(hertz, np.float32)
    mask = np.array(loud[: len(curve)])
    changed = bent(curve, mask, [Phrase(0, len(curve), tone)])
    assert np.isfinite(changed).all()
    assert changed.max() <= max(curve.max(), 41.0) * 2.5
