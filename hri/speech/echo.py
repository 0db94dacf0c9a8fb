"""The robot's own voice, taken out of what its microphone hears.

An adaptive filter learns the way from the loudspeaker to the microphone: the partitioned-block
frequency-domain Kalman filter, which learns by itself how far to trust what it hears, so that a
person who speaks at the same time does not spoil it. F. Kuech, E. Mabande, G. Enzner, "State-space
architecture of the partitioned-block-based acoustic echo controller", ICASSP 2014.
"""

from __future__ import annotations

import math
from collections import deque
from itertools import takewhile
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples, Speech
from hri.hal.drivers.resampling import resample
from hri.speech.grammar.words import normalize

BLOCK = 256
"""Samples that are worked on at once; the filter's parts are as long."""
PARTS = 16
"""Parts of the filter: at 16 kHz it reaches 256 ms back."""
FORGETTING = 0.9997
"""How much of the way is still so a block later: people and robots move."""
SMOOTHING = 0.5
"""Share of the old estimate in the new one of all that is not an echo."""
FIRST_DOUBT = 0.1
"""Variance of the way before anything is known of it: an echo of -10 dB in each of its parts.

With these figures 8, 14, 20 and 24 dB of an echo are gone in its first four seconds, in a room
that rings for 0.1 s, and no less when someone speaks meanwhile.
"""
ECHO_TAIL = 0.4
"""Seconds that the robot's own voice may be heard after it has ended."""
LEAD = 0.06
"""Seconds that the sound played is taken to be earlier than is known: it never may be late."""
TOLERANCE = 0.05
"""Seconds that the loudspeaker's position may be wrong before the sound played is aligned again."""
FOREIGN_SHARE = 0.5
"""Share of a block's energy that must be left for it to pass as it is."""
FULL_SCALE = 32768.0
REMEMBERED = 30.0
"""Seconds of sound of which is known how much was left: more than the longest piece of speech."""
AFTER = 0.1
"""Seconds from a sound to the end of the blocks that it comes in, at most."""
WHILE = 0.4
"""Seconds of sound in which the rest of its voice is compared with the sound played."""
AUDIBLE = 300.0
"""Samples' root mean square from which its voice counts as played, of 32768."""

Spectra = NDArray[np.complex128]


class EchoCanceller:
    """Learns the way from loudspeaker to microphone and subtracts what came along it."""

    def __init__(self) -> None:
        bins = BLOCK + 1
        self._played: Spectra = np.zeros((PARTS, bins), np.complex128)
        self._way: Spectra = np.zeros((PARTS, bins), np.complex128)
        self._doubt = np.full((PARTS, bins), FIRST_DOUBT)
        self._other = np.zeros(bins)
        self._last = np.zeros(BLOCK)
        self._heard_rest: Samples = np.zeros(0, np.int16)
        self._played_rest: Samples = np.zeros(0, np.int16)

    def cancel(self, heard: Samples, played: Samples) -> Samples:
        """What is left of `heard`, as far as whole blocks are there.

        `played` is what the loudspeaker was given meanwhile, or a little earlier, of equal length.
        """
        heard = np.concatenate([self._heard_rest, heard])
        played = np.concatenate([self._played_rest, played])
        whole = len(heard) // BLOCK * BLOCK
        self._heard_rest, self._played_rest = heard[whole:], played[whole:]
        left = np.empty(whole)
        for first in range(0, whole, BLOCK):
            block = slice(first, first + BLOCK)
            left[block] = self._step(heard[block] / FULL_SCALE, played[block] / FULL_SCALE)
        return np.clip(np.rint(left * FULL_SCALE), -32768, 32767).astype(np.int16)

    def flush(self) -> Samples:
        """What waits for its block to become whole; what was learnt is kept."""
        rest, self._heard_rest = self._heard_rest, self._heard_rest[:0]
        self._played_rest = self._played_rest[:0]
        return rest

    def _step(self, heard: NDArray[np.float64], played: NDArray[np.float64]) -> NDArray[np.float64]:
        self._played = np.roll(self._played, 1, axis=0)
        self._played[0] = np.fft.rfft(np.concatenate([self._last, played]))
        self._last = played
        echo = np.fft.irfft(np.sum(self._played * self._way, axis=0))[BLOCK:]
        left: NDArray[np.float64] = heard - echo
        error = np.fft.rfft(np.concatenate([np.zeros(BLOCK), left]))
        self._learn(error)
        return left * _gain(heard, left)

    def _learn(self, error: Spectra) -> None:
        power = np.abs(self._played) ** 2
        self._other = SMOOTHING * self._other + (1.0 - SMOOTHING) * np.abs(error) ** 2
        # Half of each transform is padding, hence the halves.
        expected = 0.5 * np.sum(power * self._doubt, axis=0) + self._other + 1e-12
        trust = self._doubt / expected
        # Only the first half of a part is part of the way.
        step = np.fft.irfft(trust * np.conj(self._played) * error, axis=1)
        step[:, BLOCK:] = 0.0
        self._way = FORGETTING * (self._way + np.fft.rfft(step, axis=1))
        kept = np.maximum(0.0, 1.0 - 0.5 * trust * power)
        moved = (1.0 - FORGETTING**2) * np.abs(self._way) ** 2
        self._doubt = FORGETTING**2 * kept * self._doubt + moved


def _gain(heard: NDArray[np.float64], left: NDArray[np.float64]) -> float:
    """How much of what is left is someone else's: where most of a block was echo, so is the rest.

    Nor can a block be louder without the echo than with it, whatever has been learnt.
    """
    before, after = float(np.dot(heard, heard)), float(np.dot(left, left))
    if after >= before:
        return math.sqrt(before / after) if after else 0.0
    return min(1.0, after / before / FOREIGN_SHARE)


class _Block(NamedTuple):
    """Energies of a block of sound, in squares of samples."""

    end: float
    """Seconds of the clock."""
    heard: float
    left: float
    played: float
    samples: int
    """How many are left."""


class Leftover:
    """How much of what the microphone heard of late was left without the robot's voice."""

    def __init__(self) -> None:
        self._blocks: deque[_Block] = deque()
        self._least = math.inf  # energy left of what was played, at least

    def add(self, heard: Samples, left: Samples, played: Samples, now: float) -> None:
        """Add the sound up to a time in seconds, before and after subtraction, and its voice."""
        block = _Block(now, _energy(heard), _energy(left), _energy(played), len(left))
        self._blocks.append(block)
        while now - self._blocks[0].end > REMEMBERED:
            self._blocks.popleft()
        if block.played:
            self._note_least(now)

    def _note_least(self, now: float) -> None:
        """Nobody speaks in each moment: the least that is left in a while is its voice alone.

        R. Martin, "Noise power spectral density estimation based on optimal smoothing and minimum
        statistics", IEEE Transactions on Speech and Audio Processing 9 (2001).
        """
        recent = list(takewhile(lambda block: block.end > now - WHILE, reversed(self._blocks)))
        is_whole = self._blocks[0].end <= now - WHILE and all(block.played for block in recent)
        played = sum(block.played for block in recent)
        if is_whole and played > sum(block.samples for block in recent) * AUDIBLE**2:
            self._least = min(self._least, sum(block.left for block in recent) / played)

    def share(self, start: float, end: float) -> float:
        """Share of the energy between two times in seconds that is left; 1 when none is known."""
        blocks = self._between(start, end)
        before = sum(block.heard for block in blocks)
        return sum(block.left for block in blocks) / before if before else 1.0

    def level_db(self, start: float, end: float) -> float:
        """Level of what is left between two times in seconds, dB against full scale."""
        blocks = self._between(start, end)
        count = max(1, sum(block.samples for block in blocks))
        return _decibels(sum(block.left for block in blocks) / count / FULL_SCALE**2)

    def above_least_db(self, start: float, end: float) -> float:
        """How far what is left between two times is above the least left of its voice, in dB.

        Both are compared with what was played meanwhile and shortly before, which the room still
        gives back in a pause; infinite where it said nothing.
        """
        blocks = self._between(start, end)
        played = sum(block.played for block in self._between(start - ECHO_TAIL, end))
        if not played or math.isinf(self._least):
            return math.inf
        return _decibels(sum(block.left for block in blocks) / played) - _decibels(self._least)

    def _between(self, start: float, end: float) -> list[_Block]:
        recent = takewhile(lambda block: block.end >= start, reversed(self._blocks))
        return [block for block in recent if block.end <= end + AFTER][::-1]


def _decibels(power: float) -> float:
    return 10.0 * math.log10(max(power, 1e-12))


def _energy(samples: Samples) -> float:
    return float(np.sum(np.square(samples, dtype=np.float64)))


class OwnVoice:
    """The sound of the robot's loudspeaker, as reported by the voice."""

    def __init__(self, rate: int) -> None:
        """`rate` is the microphone's samples a second."""
        self._rate = rate
        self._speech: Speech | None = None
        self._sound: Samples = np.zeros(0, np.int16)
        self._next = 0
        self._begun = 0.0

    def said(self, start: float, end: float) -> list[str]:
        """Its words between two times of the clock, or all if it gives no times."""
        if self._speech is None:
            return []
        first, last = start - self._begun, end - self._begun
        words = [w.text for w in self._speech.words if w.end >= first and w.start <= last]
        return normalize(" ".join(words) if self._speech.words else self._speech.text)

    def played(self, speech: Speech | None, position: float, count: int, now: float) -> Samples:
        """The last `count` samples played, `position` seconds of the speech having been heard."""
        if speech is None:
            return np.zeros(count, np.int16)
        self._begun = now - position
        first = round((position + LEAD) * self._rate) - count
        is_new = self._speech is None or speech.text != self._speech.text
        if is_new or abs(first - self._next) > TOLERANCE * self._rate:
            self._next = first
        if speech is not self._speech:
            self._speech = speech
            self._sound = resample(speech.samples, speech.rate, self._rate)
        first, self._next = self._next, self._next + count
        played = np.zeros(count, np.int16)
        part = self._sound[max(0, first) : max(0, first + count)]
        offset = min(count, max(0, -first))
        played[offset : offset + len(part)] = part
        return played
