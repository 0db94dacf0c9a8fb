"""The mouth opens as far as the voice is loud."""

import numpy as np
import pytest

from hri.core.signals import Phoneme, Samples, Speech
from hri.face.lips.lip_player import lip_track
from hri.face.lips.loudness import LEAST, MOST, USUAL_DB, Loudness

RATE = 16000
USUAL = 32768 * np.sqrt(2) * 10 ** (USUAL_DB / 20)
"""The amplitude of a tone that is as loud as a voice."""


def tone(amplitude: float, seconds: float = 1.0) -> Samples:
    times = np.arange(round(seconds * RATE)) / RATE
    return np.asarray(amplitude * np.sin(2 * np.pi * 200 * times), np.int16)


@pytest.mark.parametrize(
    ("amplitude", "factor"), [(1.0, 1.0), (0.5, 0.82), (2.0, 1.18), (0.05, LEAST), (6.0, MOST)]
)
def test_soft_speech_opens_less_and_a_shout_more(amplitude: float, factor: float) -> None:
    loudness = Loudness(tone(amplitude * USUAL), RATE)
    assert loudness.at(np.array([0.5])) == pytest.approx(factor, abs=0.01)


def test_silence_has_no_loudness_to_follow() -> None:
    times = np.array([-1.0, 0.0, 0.5, 9.0])
    for samples in (tone(0.0), tone(USUAL, 0.0)):
        assert Loudness(samples, RATE).at(times) == pytest.approx(1.0)


def test_the_factor_is_smooth_where_the_voice_is_not() -> None:
    samples = np.concatenate([tone(0.1 * USUAL, 0.5), tone(3 * USUAL, 0.5), tone(0.0, 0.5)])
    factors = Loudness(samples, RATE).at(np.arange(0, 1.5, 0.005))
    assert np.ptp(factors) > 0.5
    assert np.abs(np.diff(factors)).max() < 0.04, "slower than a jaw"


def test_a_speech_that_grows_is_as_loud_as_it_was() -> None:
    samples = np.concatenate([tone(USUAL), tone(0.0, 0.3), tone(2 * USUAL)])
    times = np.arange(0, 1.1, 0.01)
    part = Loudness(samples[: round(1.3 * RATE)], RATE).at(times)
    assert part == pytest.approx(Loudness(samples, RATE).at(times), abs=0.01)


def test_the_jaw_follows_and_closed_or_rounded_lips_do_not() -> None:
    sounds = tuple(Phoneme(name, 0.15 * n, 0.15) for n, name in enumerate(("a", "m", "u:", "a")))
    soft, loud = (
        lip_track(Speech("", tone(factor * USUAL, 0.6), RATE, sounds)) for factor in (0.4, 2.0)
    )
    assert soft.weights(0.08, "jaw")["aa"] < 0.75 * loud.weights(0.08, "jaw")["aa"]
    assert soft.weights(0.08)["aa"] < 0.9 * loud.weights(0.08)["aa"]
    assert soft.weights(0.225)["PP"] == loud.weights(0.225)["PP"]
    assert soft.weights(0.375)["ou"] == pytest.approx(loud.weights(0.375)["ou"])
