"""Whether feelings are heard in the voice as published: 7 emotions by 4 measures of the sound.

The directions are those on which P. N. Juslin and P. Laukka, "Communication of emotions in vocal
expression and music performance", Psychological Bulletin 129 (2003), and I. R. Murray and J. L.
Arnott, "Toward the simulation of emotion in synthetic speech", JASA 93 (1993), agree; surprise is
M. Schroeder's, "Speech and Emotion Research" (2003). librosa's pYIN (M. Mauch and S. Dixon, ICASSP
2014), which knows nothing of the voice, finds the pitch.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from hri.bench.table import Row, at_least, share
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.core.signals import EmotionState, Speech
from hri.emotion.display import load_display
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import PLAIN
from hri.speech.synthesizers.natural import NaturalVoice

WHAT = "feelings: direction of pitch, range, rate and loudness as published"
MEASURES = ("pitch", "range", "rate", "loudness")
PUBLISHED = {
    "joy": (1, 1, 1, 1),
    "sadness": (-1, -1, -1, -1),
    "anger": (1, 1, 1, 1),
    "fear": (1, 0, 1, 0),
    "disgust": (-1, 0, -1, -1),
    "surprise": (1, 1, 1, 1),
    "love": (-1, -1, -1, -1),
}
"""The direction of each measure; 0 where the sources differ. Love is what they call tenderness."""
SENTENCES = (
    "My mother may know where all the yellow lemons are in the morning.",
    "I am going to the kitchen now, and I will be here again in a minute.",
    "There is a letter on the table, and nobody has opened it so far.",
    "The weather will remain the same all over the country tomorrow.",
)
LOWEST_HZ, HIGHEST_HZ = 70.0, 500.0
_FULL = 32768

Heard = dict[str, float]
"""Of each measure, how it differs from the plain voice: octaves, octaves, log2, decibels."""


def rows() -> Iterator[Row]:
    """How many of the directions are as published, at full strength."""
    if find_spec("librosa") is None:
        raise NotAvailable("librosa is not installed - pip install librosa")
    right = [
        np.sign(heard[measure]) == direction
        for emotion, heard in differences(1.0).items()
        for measure, direction in zip(MEASURES, PUBLISHED[emotion], strict=True)
        if direction
    ]
    yield share(WHAT, int(sum(right)), len(right), at_least(0.95))


def differences(intensity: float) -> dict[str, Heard]:
    """What is heard of each emotion, against the same sentences without one."""
    display = load_display()
    with ResourceManager((), FakeClock()) as resources:
        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
        voice.activate()
        plain = [measured(voice.synthesize(text, PLAIN)) for text in SENTENCES]
        found = {}
        for name in PUBLISHED:
            state = EmotionState(name, intensity, 0.0, 0.0, 0.0, {name: intensity})
            prosody = display.prosody(state)
            said = [measured(voice.synthesize(text, prosody)) for text in SENTENCES]
            found[name] = dict(zip(MEASURES, np.median(np.subtract(said, plain), 0), strict=True))
        voice.deactivate()
    return found


def measured(speech: Speech) -> NDArray[np.float64]:
    """Pitch, its range, rate and loudness of a sound: logarithms of base 2, and decibels."""
    import librosa

    sound = speech.samples / _FULL
    pitch, _, _ = librosa.pyin(sound, fmin=LOWEST_HZ, fmax=HIGHEST_HZ, sr=speech.rate)
    logs = np.log2(pitch[np.isfinite(pitch)])
    heard = np.abs(sound) > 0.01 * np.abs(sound).max()
    first, last = np.flatnonzero(heard)[[0, -1]]
    spoken = sound[first : last + 1]
    low, high = np.percentile(logs, (10, 90))
    loudness = 10 * np.log10((spoken**2).mean())
    return np.array([np.median(logs), np.log2(high - low), -np.log2(len(spoken)), loudness])
