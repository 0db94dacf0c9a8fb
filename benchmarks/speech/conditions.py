"""The rooms that clips are heard in: a quiet one, among people who talk, in a kitchen, in wind."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.speech.babble import babble
from benchmarks.speech.kitchen import kitchen
from benchmarks.speech.levels import Sound, above
from benchmarks.speech.pink import pink
from hri.bench.speech import flite_voices
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.samples import Clip
from hri.core.signals import Samples


@dataclass(frozen=True, slots=True)
class Noise:
    """What lies under the speech, and by how much."""

    make: Callable[[Sequence[Samples], int, np.random.Generator], Sound]
    """Of talkers, a number of samples, and chance."""
    ratio: float
    """Decibels of the speech above it."""
    seed: str = ""


CONDITIONS: Mapping[str, Noise | None] = {
    "clean": None,
    "12 dB": Noise(babble, 12.0),
    "6 dB": Noise(babble, 6.0),
    "12 dB in a kitchen": Noise(kitchen, 12.0, " kitchen"),
    "6 dB in a kitchen": Noise(kitchen, 6.0, " kitchen"),
    "12 dB over pink noise": Noise(pink, 12.0, " pink"),
    "6 dB over pink noise": Noise(pink, 6.0, " pink"),
}


def heard_in(
    condition: str, clips: Sequence[Clip], talkers: Sequence[Clip], draw: int = 0
) -> Iterator[Clip]:
    """The clips in the noise of a condition, the same at every run of the same draw."""
    noise = CONDITIONS[condition]
    for clip in clips:
        if noise is None:
            yield clip
            continue
        others = [talker.samples for talker in talkers if talker.name != clip.name]
        seed = f"{clip.name} {noise.ratio:g}{noise.seed}" + (f" {draw}" if draw else "")
        chance = np.random.default_rng(zlib.crc32(seed.encode()))
        made = noise.make(others, len(clip.samples), chance)
        yield replace(clip, samples=above(clip.samples, made, noise.ratio))


def padded(clip: Clip) -> Clip:
    """With the silences of a spoken sentence around it, so that noise has a beginning."""
    lead, tail = round(flite_voices.LEAD * RATE), round(flite_voices.TAIL * RATE)
    return Clip(clip.name, np.pad(clip.samples, (lead, tail)), clip.sentence, clip.slots)
