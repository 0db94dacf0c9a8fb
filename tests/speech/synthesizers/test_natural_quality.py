"""Breath, tension, tremble, smile and onset, measured in the sound."""

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.signals import Prosody, VoiceQuality
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.natural import NaturalVoice

pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")

TEXT = "My mother may know where all the yellow lemons are in the morning."
SIZE = 2048


@pytest.fixture(scope="module")
def said():
    with ResourceManager((), FakeClock()) as resources:
        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
        voice.activate()

        def sound(**quality):
            return voice.synthesize(TEXT, Prosody(quality=VoiceQuality(**quality)))

        yield sound
        voice.deactivate()


def pieces(speech):
    """The loud stretches."""
    sound = speech.samples / 32768
    cut = np.array([sound[i : i + SIZE] for i in range(0, len(sound) - SIZE, SIZE // 8)])
    return cut[(cut**2).mean(axis=1) > 0.1 * (sound**2).mean()]


def spectrum(speech):
    power = (np.abs(np.fft.rfft(pieces(speech) * np.hanning(SIZE))) ** 2).mean(axis=0)
    return np.fft.rfftfreq(SIZE, 1 / speech.rate), power


def tilt(speech):
    """Decibels from 1 to 5 kHz against those below."""
    hertz, power = spectrum(speech)
    high = power[(hertz >= 1000) & (hertz < 5000)].sum()
    return 10 * np.log10(high / power[hertz < 1000].sum())


def periodicity(speech):
    """Height of the cepstral peak, which noise lowers."""
    magnitudes = np.abs(np.fft.rfft(pieces(speech) * np.hanning(SIZE)))
    cepstra = np.fft.irfft(np.log(magnitudes + 1e-6))
    return np.median(cepstra[:, speech.rate // 400 : speech.rate // 80].max(axis=1))


def loudness(speech):
    sound = speech.samples / 32768
    return 10 * np.log10((sound**2).mean())


def envelope(speech):
    """Decibels of stretches of 20 ms."""
    step = speech.rate // 50
    sound = speech.samples[: len(speech.samples) // step * step].reshape(-1, step) / 32768
    return 10 * np.log10((sound**2).mean(axis=1) + 1e-9)


def test_breath_is_noise_beside_the_voice(said):
    assert periodicity(said(breath=1.0)) < 0.8 * periodicity(said(breath=0.01))


def test_a_tense_voice_is_sharp_and_a_lax_one_soft(said):
    lax, plain, tense = (tilt(said(tension=tension)) for tension in (-1.0, 0.01, 1.0))
    assert lax < plain - 3
    assert plain < tense - 2


def test_a_smile_raises_the_resonances(said):
    octaves = np.arange(np.log2(700), np.log2(4500), 0.005)
    width = np.hanning(61) / np.hanning(61).sum()

    def shape(speech):
        hertz, power = spectrum(speech)
        decibels = np.convolve(np.interp(2**octaves, hertz, np.log(power)), width, "valid")
        return decibels - np.polyval(np.polyfit(octaves[30:-30], decibels, 1), octaves[30:-30])

    def raised(speech, other):
        """By which share the resonances lie higher."""
        lags = np.arange(-20, 21)
        one, other = shape(speech), shape(other)[20:-20]
        alike = [np.corrcoef(one[20 + lag : 20 + lag + len(other)], other)[0, 1] for lag in lags]
        return 2 ** (0.005 * lags[int(np.argmax(alike))]) - 1

    plain = said(smile=0.01)
    assert 0.02 < raised(said(smile=1.0), plain) < 0.07
    assert -0.07 < raised(said(smile=-1.0), plain) < -0.02


def test_a_tremble_shakes_pitch_and_loudness(said):
    still, shaken = (envelope(said(tremble=tremble)) for tremble in (0.01, 1.0))
    length = min(len(still), len(shaken))
    difference = shaken[:length] - still[:length]
    heard = still[:length] > still.max() - 15
    assert 0.5 < difference[heard].std() < 3.0


def test_a_phrase_begins_softly_or_abruptly(said):
    def first(speech):
        levels = envelope(speech)
        begin = np.flatnonzero(levels > levels.max() - 30)[0]
        return 10 * np.log10((10 ** (levels[begin : begin + 4] / 10)).mean())

    soft, plain, hard = (first(said(onset=onset)) for onset in (-1.0, 0.01, 1.0))
    assert soft < plain - 3
    assert hard > plain + 1


@pytest.mark.parametrize("name", ["breath", "tension", "tremble", "smile", "onset"])
def test_it_is_as_loud_and_as_long_and_never_clips(said, name):
    plain, changed = said(), said(**{name: 1.0})
    assert abs(loudness(changed) - loudness(plain)) < 1.5
    assert abs(changed.duration - plain.duration) < 0.1
    assert np.abs(changed.samples.astype(int)).max() < 32000
