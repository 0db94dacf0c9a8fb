"""A kitchen: dishes, a tap, a kettle, the hum of the refrigerator, and some people who talk."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from benchmarks.speech.levels import Sound, active_power, trimmed
from hri.bench.speech.flite_voices import RATE
from hri.core.signals import Samples

TALKERS = 2
"""People who talk farther away."""
STRIKES = (1.5, 5.0)
"""Dishes that are struck in a second."""
MODES = (4, 9)
"""Frequencies at which a dish rings."""
LEVELS = {"dishes": 0.0, "tap": -6.0, "talk": -3.0, "kettle": -9.0, "hum": -15.0}
"""Mean power of each source, dB; by chance up to SPREAD more or less."""
SPREAD = 6.0
TAIL = 0.4
"""Seconds in which the room's reverberation falls by 60 dB."""


def kitchen(talkers: Sequence[Samples], length: int, chance: np.random.Generator) -> Sound:
    """`length` samples of all of it."""
    sources: dict[str, Callable[[], Sound]] = {
        "dishes": lambda: _dishes(length, chance),
        "tap": lambda: _tap(length, chance),
        "talk": lambda: _talk(talkers, length, chance),
        "kettle": lambda: _kettle(length, chance),
        "hum": lambda: _hum(length, chance),
    }
    mixture = np.zeros(length)
    for name, source in sources.items():
        sound = source()
        level = LEVELS[name] + chance.uniform(-SPREAD, SPREAD)
        mixture += sound * 10 ** (level / 20) / max(float(np.sqrt(np.mean(sound**2))), 1e-9)
    return mixture


def _dishes(length: int, chance: np.random.Generator) -> Sound:
    """Struck things, each of which rings at a few frequencies and fades; often several at once."""
    sound = np.zeros(length + RATE)
    begin = 0.0
    rate = chance.uniform(*STRIKES)
    while begin < length:
        for _ in range(int(chance.integers(1, 4))):
            start = min(int(begin + chance.uniform(0.0, 0.12) * RATE), length)
            sound[start : start + RATE] += _strike(chance)
        begin += chance.exponential(2.0 / rate) * RATE
    return sound[:length]


def _strike(chance: np.random.Generator) -> Sound:
    time = np.arange(RATE) / RATE
    modes = int(chance.integers(*MODES))
    pitches = chance.uniform(700.0, 7200.0, modes)
    fades = 10.0 ** chance.uniform(-2.3, -0.7, modes)
    ring = np.sin(2 * np.pi * pitches[:, None] * time) * np.exp(-time / fades[:, None])
    click = chance.normal(size=RATE) * np.exp(-time / 0.002)
    return np.asarray((ring.sum(axis=0) + click) * 10 ** (chance.normal(0.0, 5.0) / 20))


def _tap(length: int, chance: np.random.Generator) -> Sound:
    """Running water: noise around 1 to 5 kHz whose strength flickers."""
    noise = _shaped(length, chance, lambda f: 1.0 / (1.0 + ((f - 2500.0) / 2200.0) ** 2))
    flicker = np.exp(_shaped(length, chance, lambda f: (f < 25.0).astype(float)) * 0.4)
    return np.asarray(noise * flicker)


def _kettle(length: int, chance: np.random.Generator) -> Sound:
    """A kettle or an extractor fan: low noise that swells slowly."""
    noise = _shaped(length, chance, lambda f: 1.0 / (1.0 + (f / 400.0) ** 1.3))
    swell = np.interp(np.arange(length), np.linspace(0, length, 6), chance.uniform(0.5, 1.5, 6))
    return np.asarray(noise * swell)


def _hum(length: int, chance: np.random.Generator) -> Sound:
    """A motor on the mains: harmonics of 50 or 60 Hz."""
    time = np.arange(length) / RATE
    mains = float(chance.choice((50.0, 60.0)))
    harmonics = np.arange(1, 12)[:, None]
    phases = chance.uniform(0.0, 2 * np.pi, (len(harmonics), 1))
    return np.asarray((np.sin(2 * np.pi * mains * harmonics * time + phases) / harmonics).sum(0))


def _talk(talkers: Sequence[Samples], length: int, chance: np.random.Generator) -> Sound:
    """A few people at the other side of the room."""
    sound = np.zeros(length)
    for index in chance.choice(len(talkers), min(TALKERS, len(talkers)), replace=False):
        voice = trimmed(talkers[index].astype(np.float64))
        start = int(chance.integers(len(voice)))
        sound += np.resize(np.roll(voice, -start), length) / np.sqrt(active_power(voice))
    time = np.arange(int(TAIL * RATE)) / RATE
    tail = chance.normal(size=len(time)) * 10 ** (-3 * time / TAIL)
    size = length + len(tail)
    echoing = np.fft.irfft(np.fft.rfft(sound, size) * np.fft.rfft(tail, size), size)
    return np.asarray(echoing[:length], np.float64)


def _shaped(length: int, chance: np.random.Generator, strength: Callable[[Sound], Sound]) -> Sound:
    """Noise with a strength for each frequency, Hz; deviation 1."""
    frequencies = np.asarray(np.fft.rfftfreq(length, 1 / RATE), np.float64)
    sound = np.fft.irfft(np.fft.rfft(chance.normal(size=length)) * strength(frequencies), length)
    return np.asarray(sound / max(float(sound.std()), 1e-9), np.float64)
