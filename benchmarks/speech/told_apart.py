"""Whether the emotions that a companion has most are told apart by the sound of its voice.

Six measures of the sound, each in a unit that listeners notice, say how far two emotions are apart;
a linear discriminant (R. A. Fisher, 1936), which has learned from other sentences, names each one.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from benchmarks.speech.feelings import HIGHEST_HZ, LOWEST_HZ, SENTENCES
from hri.bench.table import Row, amount, at_least, share
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.core.signals import EmotionState, Speech
from hri.emotion.display import load_display
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.natural import NaturalVoice

WHAT = "feelings: named by a discriminant that learned from other sentences"
EMOTIONS = (
    *("joy", "sadness", "anger", "fear", "disgust", "surprise"),
    *("hope", "relief", "pride", "shame", "gratitude", "disappointment"),
)
TEXTS = (
    *SENTENCES,
    "You have put the red ball behind the door.",
    "They came home from the lake before the rain began.",
    "Anna and Ben are in the garden with the dog.",
    "I have been waiting for you since this morning.",
    "The train to the city leaves from the other side.",
    "We can look for your keys in the living room.",
    "They left the window open all night long.",
    "Now I know what you wanted to see.",
)
UNITS = {
    "pitch": 1.0,  # semitones of the median
    "range": 1.5,  # semitones from the 10th to the 90th percentile
    "loudness": 1.0,  # decibels
    "pace": 0.42,  # decibels: 5 %
    "tilt": 1.5,  # decibels above 1 kHz against those below
    "noise": 1.0,  # hundredths of the cepstral peak, lower with more noise
}
"""What a difference counts as one."""
FOLDS = 4
SHRUNK = 0.01
"""Share of the mean variance that is added to each measure's, as with so few sentences one must."""
LOUD = 0.05
"""Of the mean power, from which on a stretch is voice."""
_FULL, _SIZE = 32768, 2048

Measured = NDArray[np.float64]
"""Emotions by texts by measures, in UNITS."""


def rows() -> Iterator[Row]:
    """The two that are most alike, and how many are named right."""
    if find_spec("librosa") is None:
        raise NotAvailable("librosa is not installed - pip install librosa")
    heard = measured_emotions()
    distance, pair = min(pairs(heard))
    yield amount(f"feelings: the two most alike ({pair})", distance, "units", at_least(1.0))
    right = named_right(heard)
    yield share(WHAT, right, heard.shape[0] * heard.shape[1], at_least(0.6))


def measured_emotions() -> Measured:
    """Each emotion at full strength."""
    display = load_display()
    with ResourceManager((), FakeClock()) as resources:
        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
        voice.activate()
        heard = []
        for name in EMOTIONS:
            prosody = display.prosody(EmotionState(name, 1.0, 0.0, 0.0, 0.0, {name: 1.0}))
            heard.append([measured(voice.synthesize(text, prosody)) for text in TEXTS])
        voice.deactivate()
    in_units: Measured = np.array(heard) / np.array(list(UNITS.values()))
    return in_units


def pairs(heard: Measured) -> Iterator[tuple[float, str]]:
    """How far each two emotions are apart, by the means of their sentences."""
    means = dict(zip(EMOTIONS, heard.mean(axis=1), strict=True))
    for one, other in combinations(EMOTIONS, 2):
        yield float(np.linalg.norm(means[one] - means[other])), f"{one}, {other}"


def named_right(heard: Measured) -> int:
    """How many are named right, each part of the texts by what was learned from the others."""
    texts = np.arange(heard.shape[1])
    right = 0
    for fold in range(FOLDS):
        is_held_out = texts % FOLDS == fold
        learned = heard[:, ~is_held_out]
        means = learned.mean(axis=1)
        covariance = np.cov((learned - means[:, None]).reshape(-1, len(UNITS)).T)
        covariance += SHRUNK * np.eye(len(UNITS)) * np.trace(covariance) / len(UNITS)
        away = heard[:, is_held_out, None] - means
        distances = np.einsum("etmi,ij,etmj->etm", away, np.linalg.inv(covariance), away)
        right += int((distances.argmin(axis=2) == np.arange(len(heard))[:, None]).sum())
    return right


def measured(speech: Speech) -> list[float]:
    """The measures of a sound, as UNITS lists them."""
    import librosa

    sound = speech.samples / _FULL
    is_heard = np.flatnonzero(np.abs(sound) > 0.01 * np.abs(sound).max())
    spoken = sound[is_heard[0] : is_heard[-1] + 1]
    pitch, _, _ = librosa.pyin(sound, fmin=LOWEST_HZ, fmax=HIGHEST_HZ, sr=speech.rate)
    low, middle, high = np.percentile(12 * np.log2(pitch[np.isfinite(pitch)]), (10, 50, 90))
    power = (spoken**2).mean()
    pace = len(spoken) / speech.rate / len(speech.text)
    return [middle, high - low, _db(power), 2 * _db(pace), *_timbre(spoken, speech.rate, power)]


def _timbre(spoken: NDArray[np.float64], rate: int, power: float) -> tuple[float, float]:
    """Tilt of the spectrum, decibels, and height of the cepstral peak of the voice, hundredths."""
    starts = range(0, len(spoken) - _SIZE, _SIZE // 4)
    pieces = np.array([spoken[start : start + _SIZE] for start in starts])
    loud = pieces[(pieces**2).mean(axis=1) > LOUD * power]
    spectra = np.abs(np.fft.rfft(loud * np.hanning(_SIZE)))
    hertz = np.fft.rfftfreq(_SIZE, 1 / rate)
    energy = (spectra**2).sum(axis=0)
    tilt = _db(energy[(hertz >= 1000) & (hertz < 5000)].sum() / energy[hertz < 1000].sum())
    cepstra = np.fft.irfft(np.log(spectra + 1e-6))
    peaks = cepstra[:, rate // 450 : rate // 80].max(axis=1)
    return tilt, 100.0 * float(np.median(peaks))


def _db(power: float) -> float:
    return 10.0 * float(np.log10(power))
