"""The noise of a room: its level, its kind, and its remedy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from hri.core.signals import Samples

Kind = Literal["quiet", "hum", "hiss", "unsteady"]

VOICE_DBFS = -26.0
"""Level of a voice of usual loudness a meter away, with the microphone at its usual sensitivity."""
NEEDED_DB = 18.0
"""By how much a voice must stand above the noise: below it commands begin to be missed, at 12 dB
one in ten, at 6 dB one in three (`hri bench speech`).
"""
UNSTEADY_DB = 3.0
"""Deviation of the level from one moment to the next from which a noise is not steady."""
LOW_HZ = 500.0
"""A steady noise is a hum if most of its power is below, else a hiss."""
FULL_SCALE = 32768.0
MOMENT = 0.05
"""Seconds."""
LISTENED = 2.0
"""Seconds of noise that are judged at once."""
REMEDIES: dict[Kind, str] = {
    "hum": "move the microphone away from motors and power supplies",
    "hiss": "turn the fan or the water off, or move the microphone",
    "unsteady": "turn the television or the music off, or speak nearer to the microphone",
}


@dataclass(frozen=True, slots=True)
class RoomNoise:
    """What a microphone hears while nobody speaks to the robot."""

    level: float
    """dB against full scale."""
    kind: Kind

    @property
    def clearance(self) -> float:
        """By how many dB a voice of usual loudness stands above it."""
        return VOICE_DBFS - self.level

    @property
    def advice(self) -> str:
        """What to do about it; empty when commands are understood in it."""
        return "" if self.kind == "quiet" else REMEDIES[self.kind]


def room_noise(samples: Samples, rate: int) -> RoomNoise:
    """The noise in some seconds of sound in which nobody near speaks. Silence is quiet."""
    size = round(MOMENT * rate)
    moments = samples[: len(samples) // size * size].reshape(-1, size) / FULL_SCALE
    powers = np.maximum((moments**2).mean(axis=1), 1e-12)
    if not len(powers):
        return RoomNoise(-120.0, "quiet")
    levels = 10.0 * np.log10(powers)
    level = round(float(10.0 * np.log10(powers.mean())), 1)
    if VOICE_DBFS - level >= NEEDED_DB:
        return RoomNoise(level, "quiet")
    if float(levels.std()) > UNSTEADY_DB:
        return RoomNoise(level, "unsteady")
    spectrum = (np.abs(np.fft.rfft(moments * np.hanning(size), axis=1)) ** 2).sum(axis=0)
    low = spectrum[: round(LOW_HZ * MOMENT)].sum()
    return RoomNoise(level, "hum" if low > spectrum.sum() / 2 else "hiss")


class RoomListener:
    """Judges the noise of a room again and again."""

    def __init__(self, rate: int) -> None:
        self.noise: RoomNoise | None = None
        """Of the last LISTENED seconds; None before."""
        self._rate = rate
        self._parts: list[Samples] = []
        self._count = 0

    def hear(self, samples: Samples) -> None:
        """Take sound in which nobody speaks."""
        self._parts.append(samples)
        self._count += len(samples)
        if self._count >= LISTENED * self._rate:
            self.noise = room_noise(np.concatenate(self._parts), self._rate)
            self._parts, self._count = [], 0
