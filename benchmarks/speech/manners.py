"""Ways in which people speak: whispered, shouted, far away, fast, slow, and as a child."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache

import numpy as np
import soxr

from benchmarks.speech.levels import Sound
from hri.bench.speech.flite_voices import LEAD, RATE, TAIL
from hri.bench.speech.samples import Clip
from hri.core.clock import FakeClock
from hri.core.signals import Prosody, Samples
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import PLAIN
from hri.speech.synthesizers.natural import NaturalVoice

FAST, SLOW = Prosody(rate=1.5), Prosody(rate=0.7)
RAISED = Prosody(pitch=1.5, range=1.3, rate=0.9)
SHORTER_THROAT = 1.25
"""Of a child of about seven, against a woman."""
TILT_DB = 4.0
"""What a shout gains for each octave from 500 Hz to 4 kHz."""
ROOM_M3, REVERBERATION_S, DISTANCE_M = 60.0, 0.5, 3.0
FRAME, HOP = 512, 128
SMOOTH = 24
"""Cepstral coefficients of the envelope of a whisper."""


def whispered(text: str) -> Samples:
    """Without a voice: the envelopes of the plain sound, filled with noise."""
    sound = _said(text, PLAIN)
    window = np.hanning(FRAME)
    padded = np.pad(sound, FRAME)
    whole = np.zeros(len(padded))
    chance = np.random.default_rng(0)
    for begin in range(0, len(padded) - FRAME, HOP):
        spectrum = np.abs(np.fft.rfft(padded[begin : begin + FRAME] * window)) + 1.0
        cepstrum = np.fft.irfft(np.log(spectrum))
        cepstrum[SMOOTH:-SMOOTH] = 0.0
        envelope = np.exp(np.fft.rfft(cepstrum).real)
        noise = np.fft.rfft(chance.normal(size=FRAME) * window)
        whole[begin : begin + FRAME] += np.fft.irfft(noise * envelope) * window
    return _clip(_tilted(whole[FRAME:-FRAME], TILT_DB / 2))


def shouted(text: str) -> Samples:
    """Higher, and sharper."""
    return _clip(_tilted(_said(text, RAISED), TILT_DB))


def far(text: str) -> Samples:
    """DISTANCE_M away in a room: more sound comes from its walls than from the mouth.

    Both are equally loud at the critical distance, 0.057 m times the root of the volume over the
    reverberation time (H. Kuttruff, "Room Acoustics", section 5.6).
    """
    critical = 0.057 * np.sqrt(ROOM_M3 / REVERBERATION_S)
    time = np.arange(int(REVERBERATION_S * RATE)) / RATE
    tail = np.random.default_rng(0).normal(size=len(time)) * 10 ** (-3 * time / REVERBERATION_S)
    tail[: RATE // 500] = 0.0
    tail *= DISTANCE_M / critical / np.sqrt((tail**2).sum())
    tail[0] = 1.0
    sound = _said(text, PLAIN)
    size = len(sound) + len(tail)
    return _clip(np.fft.irfft(np.fft.rfft(sound, size) * np.fft.rfft(tail, size), size))


def fast(text: str) -> Samples:
    """Half as fast again."""
    return _clip(_said(text, FAST))


def slow(text: str) -> Samples:
    """In about one and a half times the time."""
    return _clip(_said(text, SLOW))


def child(text: str) -> Samples:
    """A shorter throat, which also raises the pitch; as slow as children speak."""
    slower = Prosody(rate=0.9 / SHORTER_THROAT)
    sound = _said(text, slower).astype(np.float32)
    return _clip(soxr.resample(sound, RATE * SHORTER_THROAT, RATE).astype(np.float64))


MANNERS: Mapping[str, Callable[[str], Samples]] = {
    "plain": lambda text: _clip(_said(text, PLAIN)),
    "whispered": whispered,
    "shouted": shouted,
    "far": far,
    "fast": fast,
    "slow": slow,
    "child": child,
}


def spoken(manner: str, sentences: Sequence[str]) -> Iterator[Clip]:
    """Sentences in one manner."""
    for sentence in sentences:
        yield Clip(f"{manner}/{sentence}", MANNERS[manner](sentence), sentence, voice=manner)


@cache
def _voice() -> NaturalVoice:
    resources = ResourceManager((), FakeClock())
    voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
    voice.activate()
    return voice


def _said(text: str, prosody: Prosody) -> Sound:
    speech = _voice().synthesize(text, prosody)
    return np.asarray(
        soxr.resample(speech.samples.astype(np.float32), speech.rate, RATE), np.float64
    )


def _tilted(sound: Sound, decibels: float) -> Sound:
    frequencies = np.fft.rfftfreq(len(sound), 1 / RATE)
    octaves = np.log2(np.clip(frequencies, 500.0, 4000.0) / 500.0)
    spectrum = np.fft.rfft(sound) * 10 ** (octaves * decibels / 20)
    return np.asarray(np.fft.irfft(spectrum, len(sound)), np.float64)


def _clip(sound: Sound) -> Samples:
    """Between silences with a breath of noise, as loud as the other voices."""
    level = 0.25 * 32767 / max(float(np.abs(sound).max()), 1.0)
    lead, tail = round(LEAD * RATE), round(TAIL * RATE)
    quiet = np.random.default_rng(1).normal(0.0, 3.0, lead + len(sound) + tail)
    quiet[lead : lead + len(sound)] += sound * level
    return np.asarray(np.round(quiet), np.int16)
