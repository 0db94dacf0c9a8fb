"""Speech above the talk of other people, at a known distance in level.

The ratio counts the power of the speech while it is active, so that pauses around a sentence do not
make it louder than it is: frames within `ACTIVE_DB` of the loudest one are active.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hri.bench.speech import flite_voices
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.samples import Clip
from hri.core.signals import Samples

Sound = NDArray[np.float64]

FRAME = RATE // 100
ACTIVE_DB = 25.0
TALKERS = 6
"""Voices of the babble: single words of it can hardly be made out."""
RATIOS: Mapping[str, float | None] = {"clean": None, "12 dB": 12.0, "6 dB": 6.0}
"""Decibels above the babble, by condition."""
LOUDEST = 32000.0
"""A mixture that would be louder is made quieter as a whole."""


def frame_powers(sound: Sound) -> Sound:
    """Mean square of each 10 ms."""
    frames = sound[: len(sound) // FRAME * FRAME].reshape(-1, FRAME)
    return np.asarray(np.mean(frames**2, axis=1))


def active_power(sound: Sound) -> float:
    """Mean square of the active frames; 0 for silence."""
    powers = frame_powers(sound)
    if not len(powers) or powers.max() <= 0:
        return 0.0
    return float(powers[powers >= powers.max() * 10 ** (-ACTIVE_DB / 10)].mean())


def trimmed(sound: Sound) -> Sound:
    """From the first active frame to the last."""
    powers = frame_powers(sound)
    active = np.flatnonzero(powers >= powers.max() * 10 ** (-ACTIVE_DB / 10))
    return sound[active[0] * FRAME : (active[-1] + 1) * FRAME]


def babble(talkers: Sequence[Samples], length: int, chance: np.random.Generator) -> Sound:
    """`length` samples of `TALKERS` of them at once, equally loud, each from anywhere."""
    mixture = np.zeros(length)
    for index in chance.choice(len(talkers), min(TALKERS, len(talkers)), replace=False):
        voice = trimmed(talkers[index].astype(np.float64))
        start = int(chance.integers(len(voice)))
        mixture += np.resize(np.roll(voice, -start), length) / np.sqrt(active_power(voice))
    return mixture


def above(speech: Samples, noise: Sound, ratio_db: float) -> Samples:
    """The speech over the noise, its active power `ratio_db` above the noise's mean power."""
    clean = speech.astype(np.float64)
    wanted = active_power(clean) / 10 ** (ratio_db / 10)
    mixture = clean + noise * np.sqrt(wanted / np.mean(noise**2))
    mixture *= min(1.0, LOUDEST / np.max(np.abs(mixture)))
    return np.asarray(mixture.astype(np.int16))


def in_babble(
    clips: Sequence[Clip], talkers: Sequence[Clip], condition: str, draw: int = 0
) -> Iterator[Clip]:
    """The clips over the talk of the others, the same at every run of the same draw."""
    ratio = RATIOS[condition]
    for clip in clips:
        if ratio is None:
            yield clip
            continue
        others = [talker.samples for talker in talkers if talker.name != clip.name]
        seed = f"{clip.name} {ratio:g}" + (f" {draw}" if draw else "")
        noise = babble(others, len(clip.samples), np.random.default_rng(zlib.crc32(seed.encode())))
        yield replace(clip, samples=above(clip.samples, noise, ratio))


def padded(clip: Clip) -> Clip:
    """With the silences of a spoken sentence around it, so that babble has a beginning."""
    lead, tail = round(flite_voices.LEAD * RATE), round(flite_voices.TAIL * RATE)
    return Clip(clip.name, np.pad(clip.samples, (lead, tail)), clip.sentence, clip.slots)
