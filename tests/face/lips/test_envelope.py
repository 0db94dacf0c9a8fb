"""A mouth that follows a sound alone."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Phoneme, Samples, Speech
from hri.face.lips.envelope import VOWELS, EnvelopeTrack
from hri.face.lips.lip_player import lip_track
from hri.face.lips.lipsync import LipTrack
from hri.face.vocabulary import VISEMES
from tests.recorded import spoken_by_a_person

RATE = 16000


def vowel(first: float, second: float, seconds: float = 0.4) -> Samples:
    """A buzz at 120 Hz through two resonances and the ones every voice has above them."""
    count = round(seconds * RATE)
    sound = np.zeros(count)
    sound[:: RATE // 120] = 1.0
    for hertz, width in ((0.0, 200.0), (first, 80.0), (second, 100.0), (2900.0, 180.0)):
        radius = np.exp(-np.pi * width / RATE)
        turn = 2 * radius * np.cos(2 * np.pi * hertz / RATE)
        for n in range(2, count):
            sound[n] += turn * sound[n - 1] - radius**2 * sound[n - 2]
    return (12000 * sound / np.abs(sound).max()).astype(np.int16)


def opened(track: LipTrack, position: float) -> float:
    """How open the mouth is: the sum of all vowels."""
    weights = track.weights(position)
    return sum(weights.get(viseme, 0.0) for viseme in VOWELS)


@pytest.mark.parametrize("viseme", VOWELS)
def test_the_resonances_of_a_vowel_give_its_shape(viseme: str) -> None:
    weights = EnvelopeTrack(vowel(*VOWELS[viseme]), RATE).weights(0.2)
    assert max(weights, key=lambda name: weights[name]) == viseme
    assert weights[viseme] > 0.5


@pytest.mark.parametrize(("low", "high", "viseme"), [(5000, 7500, "SS"), (2600, 4200, "CH")])
def test_a_hiss_brings_the_teeth_together(low: float, high: float, viseme: str) -> None:
    spectrum = np.fft.rfft(np.random.default_rng(1).normal(size=RATE))
    hertz = np.fft.rfftfreq(RATE, 1 / RATE)
    hiss = np.fft.irfft(spectrum * ((hertz > low) & (hertz < high)))
    track = EnvelopeTrack((3000 * hiss / hiss.std()).astype(np.int16), RATE)
    assert track.weights(0.5)[viseme] > 0.6
    assert opened(track, 0.5) < 0.2


def test_the_mouth_opens_with_the_loudness_and_rests_in_silence() -> None:
    silence, loud = np.zeros(RATE // 2, np.int16), vowel(700, 1300)
    track = lip_track(Speech("", np.concatenate([silence, loud, loud // 4, silence]), RATE))
    assert opened(track, 0.7) > 0.7
    assert 0.1 < opened(track, 1.1) < 0.8 * opened(track, 0.7)
    for position in (-1.0, 0.2, 1.7, 99.0):
        assert track.weights(position) == {}
        assert track.emphasis(position) == 0


@pytest.mark.parametrize("samples", [np.zeros(0), np.zeros(9), np.zeros(RATE), np.full(RATE, 900)])
def test_what_is_no_voice_leaves_the_mouth_shut(samples: Samples) -> None:
    track = EnvelopeTrack(samples.astype(np.int16), RATE)
    assert all(track.weights(position) == {} for position in (-0.1, 0.0, 0.1, 0.5, 2.0))


@given(st.integers(0, 30000), st.sampled_from([1000, 8000, 16000, 44100]), st.integers(0, 9))
def test_any_sound_gives_weights_in_range_that_never_jump(peak: int, rate: int, seed: int) -> None:
    noise = np.random.default_rng(seed).integers(-peak, peak + 1, rate // 4, np.int16)
    noise[: rate // 8] //= 50
    track = EnvelopeTrack(noise, rate)
    rows = [track.weights(position) for position in np.arange(-0.05, 0.3, 0.005)]
    for now, then in pairwise(rows):
        for viseme in VISEMES:
            assert 0 <= now.get(viseme, 0.0) <= 1.2
            assert abs(now.get(viseme, 0.0) - then.get(viseme, 0.0)) < 0.09


def test_lips_without_phonemes_open_where_those_with_phonemes_do() -> None:
    pieces = [vowel(*VOWELS["aa"], 0.2), np.zeros(3200, np.int16), vowel(*VOWELS["ou"], 0.2)]
    samples = np.concatenate(pieces)
    names = ("a", "_:", "u:")
    phonemes = tuple(Phoneme(name, 0.2 * n, 0.2) for n, name in enumerate(names))
    heard = lip_track(Speech("", samples, RATE))
    told = lip_track(Speech("", samples, RATE, phonemes))
    for position, viseme in ((0.1, "aa"), (0.5, "ou")):
        assert heard.weights(position)[viseme] > 0.4
        assert told.weights(position)[viseme] > 0.4
    assert heard.weights(0.3) == {}


@pytest.mark.parametrize("name", ["goforward", "numbers", "cards001", "cards004"])
def test_with_real_voices_the_mouth_is_open_at_the_loudest_and_shut_in_pauses(name: str) -> None:
    samples = spoken_by_a_person(name)
    track = EnvelopeTrack(samples, RATE)
    size = RATE // 50
    blocks = samples[: len(samples) // size * size].reshape(-1, size).astype(float)
    loudness = np.convolve(np.sqrt((blocks**2).mean(axis=1)), np.ones(5) / 5, mode="same")
    order = np.argsort(loudness)
    tenth = len(order) // 10
    shut, wide = order[:tenth], order[-tenth:]
    assert np.mean([sum(track.weights((n + 0.5) / 50).values()) for n in shut]) < 0.05
    assert np.mean([sum(track.weights((n + 0.5) / 50).values()) for n in wide]) > 0.6
