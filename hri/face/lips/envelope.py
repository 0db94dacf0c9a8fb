"""A mouth for a voice that gives no phoneme times: it follows the sound alone.

Loudness opens the mouth. What it opens to is read from the first two formants, the resonances of
the voice: vowels stand at known places there (Peterson & Barney 1952), so that lips spread for "ee"
and round for "oo". A hiss brings the teeth together; pauses close the mouth.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples
from hri.face.lips.lipsync import LEAST_WEIGHT, LipTrack, Values
from hri.face.lips.spans import ARTICULATORS
from hri.face.vocabulary import VISEMES

STEP = 0.02
"""Seconds between two values."""
WINDOW = 0.032
"""Seconds of sound that each value is read from."""

QUIET_DB, FULL_DB = -26.0, 0.0
"""Against the loud parts of the speech: the mouth starts to open, and is open."""
OVER_NOISE_DB = 9.0
"""Sound less than this above the noise of the recording is not a voice."""
LOUDNESS_BELOW_NOISE_DB = -30.0
"""The quietest parts count as noise only when they are this far below the loud ones."""
LEAST = 30.0
"""Of 32767: what is never louder is silence."""

BAND_HZ = (200.0, 4000.0)
"""Where formants are looked for."""
TILT = 0.95
"""Pre-emphasis: how much of the sample before is taken away, to level the fall of a voice."""

VOWELS = {
    "aa": (700.0, 1300.0),
    "E": (530.0, 1850.0),
    "ih": (330.0, 2250.0),
    "oh": (540.0, 880.0),
    "ou": (350.0, 950.0),
}
"""First and second formant in Hz (after Peterson & Barney 1952, between men and women)."""
OPENING = {"aa": 1.0, "E": 0.9, "ih": 0.85, "oh": 0.95, "ou": 0.95}
"""Weight of a viseme when it is the only one and the voice is loud."""
SHARPNESS = 7.0
"""How clearly the nearest vowel wins, in squared octaves."""
HISS_HZ = (2200.0, 3600.0)
"""Mean frequency from which on a sound is hiss, not a vowel."""
SHARP_HZ = 4200.0
"""A hiss with a higher mean is an s, with a lower one a sh."""

_HEARD = [VISEMES.index(viseme) for viseme in (*VOWELS, "SS", "CH")]
_ORDER = 12
"""Of the linear prediction: one resonance a kilohertz, and the slope of the voice."""
_SPECTRUM = 128
"""Points of the smooth spectrum."""
_RATE = 10_000
"""Samples a second that formants are read at."""
_CALM = 2
"""Steps before and after that are smoothed over: the full way takes 60 ms, as lips do."""
_PER_CHUNK = 100
"""Steps that are worked out together."""


class EnvelopeTrack(LipTrack):
    """A mouth that opens as the voice is loud, to the vowel that it sounds like.

    Lips, jaw and tongue go together. Loudness is measured at once, vowels when they are asked for.
    """

    def __init__(self, samples: Samples, rate: int) -> None:
        self._frames = _Frames(samples, rate)
        self._level = _level(self._frames.loudness())
        self._emphasis = _calmed(np.clip(3 * self._level - 2, 0, 1)[:, None], 9)[:, 0]
        self._chunks: dict[int, Values] = {}

    def shape(self, position: float) -> Values:
        number, share = divmod(position / STEP - 0.5, 1)
        heard = (1 - share) * self._at(int(number)) + share * self._at(int(number) + 1)
        heard[heard <= LEAST_WEIGHT] = 0.0
        shape = np.zeros((len(VISEMES), len(ARTICULATORS)))
        shape[_HEARD] = heard[:, None]
        return shape

    def emphasis(self, position: float) -> float:
        middles = (np.arange(len(self._emphasis)) + 0.5) * STEP
        if not len(middles):
            return 0.0
        return float(np.interp(position, middles, self._emphasis, left=0.0, right=0.0))

    def _at(self, number: int) -> Values:
        if not -_CALM <= number < len(self._level) + _CALM:
            return np.zeros(len(_HEARD))
        chunk, place = divmod(number, _PER_CHUNK)
        if chunk not in self._chunks:
            self._chunks[chunk] = self._work_out(chunk)
        row: Values = self._chunks[chunk][place]
        return row

    def _work_out(self, chunk: int) -> Values:
        """Weights [steps, visemes] over one chunk."""
        numbers = np.arange(chunk * _PER_CHUNK - _CALM, (chunk + 1) * _PER_CHUNK + _CALM)
        level = np.zeros(len(numbers))
        heard = (numbers >= 0) & (numbers < len(self._level))
        level[heard] = self._level[numbers[heard]]
        shapes = np.zeros((len(level), len(_HEARD)))
        voiced = np.flatnonzero(level)
        if len(voiced):
            frames = self._frames.at(numbers[voiced])
            shapes[voiced] = level[voiced, None] * _shares(frames, self._frames.rate)
        return _calmed(shapes, 2 * _CALM + 1)[_CALM:-_CALM]


class _Frames:
    """A sound in overlapping windows whose middles are STEP apart."""

    def __init__(self, samples: Samples, rate: int) -> None:
        self.rate = rate
        size, count = max(2, round(rate * WINDOW)), int(len(samples) / rate / STEP)
        padded = np.pad(samples, size, mode="edge" if len(samples) else "constant")
        self._windows = np.lib.stride_tricks.sliding_window_view(padded, size)
        middles = np.round((np.arange(count) + 0.5) * STEP * rate).astype(int)
        self._begins = middles + size - size // 2

    def at(self, numbers: NDArray[np.intp]) -> Values:
        """The samples of some windows, [windows, samples], without their mean."""
        frames = self._windows[self._begins[numbers]].astype(np.float64)
        centered: Values = frames - frames.mean(axis=1, keepdims=True)
        return centered

    def loudness(self) -> Values:
        """The root mean square of each window."""
        numbers = np.arange(len(self._begins))
        blocks = [numbers[n : n + _PER_CHUNK] for n in range(0, len(numbers), _PER_CHUNK)]
        levels = [np.sqrt((self.at(block) ** 2).mean(axis=1)) for block in blocks]
        return np.concatenate([np.zeros(0), *levels])


def _level(loudness: Values) -> Values:
    """How loud the voice is at each step, 0 to 1; 0 is silence or noise."""
    if not len(loudness) or loudness.max() < LEAST:
        return np.zeros(len(loudness))
    decibels = 20 * np.log10(np.maximum(loudness, 1.0))
    loud = np.percentile(decibels[loudness >= LEAST], 90)
    noise = min(np.percentile(decibels, 10), loud + LOUDNESS_BELOW_NOISE_DB)
    quiet = max(loud + QUIET_DB, noise + OVER_NOISE_DB)
    return np.asarray(np.clip((decibels - quiet) / (loud + FULL_DB - quiet), 0, 1))


def _shares(frames: Values, rate: int) -> Values:
    """What each step sounds like, [steps, visemes]: vowels by formants, the rest by brightness."""
    windows = frames * np.hanning(frames.shape[1])
    power = np.abs(np.fft.rfft(windows)) ** 2
    frequencies = np.asarray(np.fft.rfftfreq(frames.shape[1], 1 / rate), np.float64)
    mean = power @ frequencies / np.maximum(power.sum(axis=1), 1e-9)
    hiss = np.clip((mean - HISS_HZ[0]) / (HISS_HZ[1] - HISS_HZ[0]), 0, 1)
    first, second = _formants(power, frequencies)
    places = np.log2(np.array(list(VOWELS.values())))
    away = (np.log2(first)[:, None] - places[:, 0]) ** 2
    away += (np.log2(second)[:, None] - places[:, 1]) ** 2
    near = np.exp(-SHARPNESS * away)
    near /= np.maximum(near.sum(axis=1, keepdims=True), 1e-9)
    vowels = (1 - hiss)[:, None] * near * np.array(list(OPENING.values()))
    sharp = np.clip((mean - SHARP_HZ) / 1000 + 0.5, 0, 1)
    return np.column_stack([vowels, hiss * sharp, hiss * (1 - sharp)])


def _formants(power: Values, frequencies: Values) -> tuple[Values, Values]:
    """First and second resonance of each step in Hz, by linear prediction.

    The autocorrelation of the band is the Fourier transform of its power; the predictor solves
    the Yule-Walker equations; formants are the highest peaks of the smooth spectrum that it makes.
    """
    low, high = BAND_HZ
    hertz = np.linspace(0, _RATE / 2, 2 * _SPECTRUM)
    level = np.abs(1 - TILT * np.exp(-2j * np.pi * hertz / _RATE)) ** 2
    band = np.array([np.interp(hertz, frequencies, row, right=0.0) for row in power]) * level
    lags = np.fft.irfft(band)[:, : _ORDER + 1]
    lags[:, 0] = lags[:, 0] * 1.001 + 1e-6
    distance = np.abs(np.subtract.outer(np.arange(_ORDER), np.arange(_ORDER)))
    predictor = np.linalg.solve(lags[:, distance], lags[:, 1:, None])[..., 0]
    wanted = np.linspace(low, high, _SPECTRUM)
    turns = np.exp(-2j * np.pi * np.outer(np.arange(1, _ORDER + 1), wanted) / _RATE)
    smooth = -np.log(np.abs(1 - predictor @ turns) + 1e-9)
    peaks = np.zeros(smooth.shape, bool)
    peaks[:, 1:-1] = (smooth[:, 1:-1] > smooth[:, :-2]) & (smooth[:, 1:-1] >= smooth[:, 2:])
    first = _first_peak(peaks & (wanted < 1000), wanted, VOWELS["aa"][0])
    second = _first_peak(
        peaks & (wanted > np.maximum(first[:, None] + 200, 750)), wanted, VOWELS["aa"][1]
    )
    return first, second


def _first_peak(peaks: NDArray[np.bool_], hertz: Values, otherwise: float) -> Values:
    """The lowest peak of each row; `otherwise` where there is none."""
    return np.where(peaks.any(axis=1), hertz[np.argmax(peaks, axis=1)], otherwise)


def _calmed(values: Values, steps: int) -> Values:
    """Steps of smoothing over time, since a mouth is slower than a voice."""
    window = np.hanning(steps + 2)[1:-1]
    padded = np.pad(values, ((steps // 2, steps // 2), (0, 0)))
    moved = [padded[n : n + len(values)] * share for n, share in enumerate(window / window.sum())]
    return np.sum(moved, axis=0) if len(values) else values
