"""What the student hears instead of clean speech: rooms, microphones, babble and other noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

Sound = NDArray[np.float32]
Chance = np.random.Generator

RATE = 16000
LENGTH = 4 * RATE
"""Samples of one example."""
GRID = RATE // 50
"""Samples of a frame of the network: clips begin at a multiple of it."""
TRACK = 2 * LENGTH
"""Samples of a track of noise, of which an example gets a part."""
ACTIVE_DB = 25.0
"""Frames this far below the loudest count as speech; as in `hri bench speech`."""


def active_power(sound: Sound) -> float:
    """Mean square of the frames of 10 ms that are speech."""
    frames = sound[: len(sound) // 160 * 160].reshape(-1, 160).astype(np.float64)
    powers = (frames**2).mean(axis=1)
    return float(powers[powers >= powers.max() * 10 ** (-ACTIVE_DB / 10)].mean()) + 1e-9


def decibels(value: float) -> float:
    """The factor of an amplitude."""
    return float(10 ** (value / 20))


# Noise: tracks of mean square 1.


def babble(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Three to twelve people who talk at once, one a little louder than the other."""
    track = np.zeros(TRACK, np.float32)
    for _ in range(chance.integers(3, 13)):
        track += talk(clips, chance) * decibels(chance.normal(0, 2))
    return track


def one_talker(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Someone else, above steady noise."""
    floor = steady(clips, chance)
    return talk(clips, chance) + floor / floor.std() * decibels(chance.uniform(-15, 0))


def talk(clips: Sequence[Sound], chance: Chance) -> Sound:
    """One sentence after another."""
    track = np.zeros(TRACK, np.float32)
    position = -int(chance.integers(RATE))
    while position < TRACK:
        clip = clips[chance.integers(len(clips))].astype(np.float32)
        clip = clip / np.sqrt(active_power(clip))
        start, position = position, position + len(clip)
        part = clip[max(-start, 0) : TRACK - start]
        track[max(start, 0) : max(start, 0) + len(part)] += part
    return track


def steady(clips: Sequence[Sound], chance: Chance) -> Sound:
    """From white to brown, sometimes swelling."""
    frequency = np.fft.rfftfreq(TRACK, 1 / RATE)
    spectrum = chance.normal(size=len(frequency)) + 1j * chance.normal(size=len(frequency))
    track = np.fft.irfft(spectrum / np.maximum(frequency, 60) ** chance.uniform(0, 1.1), TRACK)
    if chance.random() < 0.5:
        swells = 10 ** (chance.normal(0, 4, 24) / 20)
        track *= np.interp(np.arange(TRACK), np.linspace(0, TRACK, 24), swells)
    return track.astype(np.float32)


def clatter(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Dishes: struck things that ring at some frequencies, above faint steady noise."""
    floor = steady(clips, chance)
    track = floor / floor.std() * np.float32(0.05)
    for _ in range(chance.integers(6, 40)):
        start, length = chance.integers(TRACK - RATE), RATE // 2
        time = np.arange(length) / RATE
        tones = sum(
            np.sin(2 * np.pi * chance.uniform(500, 7000) * time) * chance.random()
            for _ in range(chance.integers(3, 9))
        )
        decay = np.exp(-time / 10 ** chance.uniform(-2.2, -0.8))
        track[start : start + length] += tones * decay * decibels(chance.normal(0, 6))
    return track.astype(np.float32)


def music(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Plucked chords over a beat."""
    track = np.zeros(TRACK, np.float32)
    beat = int(RATE * chance.uniform(0.2, 0.6))
    scale = 110 * 2 ** (np.array([0, 2, 4, 5, 7, 9, 11, 12, 14, 16]) / 12) * chance.uniform(0.8, 2)
    time = np.arange(RATE) / RATE
    harmonics = np.arange(1, 9)[:, None]
    for start in range(0, TRACK - RATE, beat):
        for pitch in chance.choice(scale, chance.integers(1, 4)):
            strength = harmonics ** -chance.uniform(0.8, 2)
            note = (np.sin(2 * np.pi * pitch * harmonics * time) * strength).sum(axis=0)
            track[start : start + RATE] += note * np.exp(-time / chance.uniform(0.1, 0.8))
        drum = chance.normal(size=RATE // 8) * np.exp(-np.arange(RATE // 8) / 400)
        track[start : start + RATE // 8] += drum * chance.uniform(0, 4)
    return track


def shaped(chance: Chance, strength: NDArray[np.float64]) -> Sound:
    """A track of noise with a strength for each frequency of `FREQUENCIES`; deviation 1."""
    size = len(FREQUENCIES)
    spectrum = (chance.normal(size=size) + 1j * chance.normal(size=size)) * strength
    track = np.fft.irfft(spectrum, TRACK).astype(np.float32)
    return track / track.std()


FREQUENCIES = np.fft.rfftfreq(TRACK, 1 / RATE)


def swelling(chance: Chance, steps: int, deviation_db: float) -> Sound:
    """Factors for a track that come and go by chance."""
    swells = 10 ** (chance.normal(0, deviation_db, steps) / 20)
    return np.interp(np.arange(TRACK), np.linspace(0, TRACK, steps), swells).astype(np.float32)


def water(clips: Sequence[Sound], chance: Chance) -> Sound:
    """A tap, or something that fries: noise of the middle and high frequencies that flickers."""
    middle, width = chance.uniform(1200, 5000), chance.uniform(0.5, 1.3)
    octaves = np.log2(np.maximum(FREQUENCIES, 20) / middle)
    hiss = shaped(chance, np.exp(-((octaves / width) ** 2)) + 0.05)
    return hiss * swelling(chance, int(chance.integers(40, 400)), chance.uniform(1, 4))


def motor(clips: Sequence[Sound], chance: Chance) -> Sound:
    """The robot's own motors, or a mixer: harmonics of a pitch that wanders, gears, and hiss."""
    rough = swelling(chance, int(chance.integers(4, 30)), 1.5)
    pitch = chance.uniform(45, 500) * rough / rough.mean()
    phase = 2 * np.pi * np.cumsum(pitch) / RATE
    fall = chance.uniform(0.2, 1.2)
    tones = sum(
        np.sin(number * phase + chance.uniform(0, 6.3)) * number**-fall * chance.uniform(0.2, 1)
        for number in range(1, int(chance.integers(6, 25)))
    )
    hiss = shaped(chance, 1 / (1 + FREQUENCIES / chance.uniform(300, 4000)))
    track = tones / np.std(tones) + hiss * decibels(chance.uniform(-15, 3))
    if chance.random() < 0.5:  # it runs now and then
        track *= np.repeat(chance.random(16) < 0.6, TRACK // 16) + 0.03
    return track.astype(np.float32)


def traffic(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Cars that pass: low noise that swells and fades."""
    track = shaped(chance, 1 / (1 + (FREQUENCIES / chance.uniform(80, 400)) ** 1.5))
    track *= swelling(chance, int(chance.integers(4, 9)), 8)
    tires = shaped(chance, 1 / (1 + ((FREQUENCIES - 900) / 700) ** 2))
    return track + tires * swelling(chance, 6, 8) * np.float32(decibels(chance.uniform(-20, -3)))


def television(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Someone talks over music."""
    tune = music(clips, chance)
    return talk(clips, chance) + tune / tune.std() * decibels(chance.uniform(-18, 0))


def kitchen(clips: Sequence[Sound], chance: Chance) -> Sound:
    """Some of it at once."""
    track = np.zeros(TRACK, np.float32)
    for kind in (clatter, water, motor, babble):
        if chance.random() < 0.7:
            part = kind(clips, chance)
            track += part / part.std() * np.float32(decibels(chance.normal(0, 6)))
    return track if track.any() else clatter(clips, chance)


NOISES: dict[Callable[[Sequence[Sound], Chance], Sound], float] = {
    babble: 0.44, one_talker: 0.06, television: 0.05, steady: 0.08, clatter: 0.06, music: 0.04,
    water: 0.05, motor: 0.05, traffic: 0.03, kitchen: 0.14,
}  # fmt: skip


def tracks(count: int, clips: Sequence[Sound], chance: Chance) -> list[Sound]:
    """Tracks of noise of all kinds, every third one of a reverberating room."""
    made = []
    for kind in chance.choice(np.array(list(NOISES)), count, p=list(NOISES.values())):
        track = kind(clips, chance)
        if chance.random() < 0.33:
            track = filtered(track, room(chance, TRACK))
        made.append((track / track.std()).astype(np.float32))
    return made


# Rooms and microphones: responses by frequency.


def room(chance: Chance, length: int) -> NDArray[np.complex64]:
    """A direct sound and an exponential tail that takes 0.1 to 0.8 s to fall by 60 dB.

    Far from the speaker the tail has more power than the direct sound: at 3 m in a room of 60 m3
    that takes 0.5 s, 14 dB more.
    """
    time = np.arange(length // 4) / RATE
    tail = chance.normal(size=len(time)) * 10 ** (-3 * time / chance.uniform(0.1, 0.8))
    tail[: RATE // 500] = 0
    response = tail * decibels(chance.triangular(-15, 10, 18)) / np.sqrt((tail**2).sum())
    response[0] = 1
    return np.fft.rfft(response.astype(np.float32), length)


def microphone(chance: Chance, length: int) -> NDArray[np.float32]:
    """Bent by some decibels; one in eight is a telephone's, one in three lacks the lowest."""
    frequency = np.fft.rfftfreq(length, 1 / RATE)
    octave = np.log2(np.maximum(frequency, 60) / 1000)
    bends = chance.normal(0, 3, 9)
    response = np.interp(octave, np.linspace(-4, 3, 9), bends) + octave * chance.normal(0, 1)
    if chance.random() < 0.12:
        response -= 60 * (frequency > chance.uniform(3300, 3900))
    if chance.random() < 0.33:
        response -= 12 * np.maximum(np.log2(chance.uniform(80, 320) / (frequency + 1)), 0)
    return (10 ** (response / 20)).astype(np.float32)


def filtered(sound: Sound, response: NDArray[np.complex64] | NDArray[np.float32]) -> Sound:
    """The sound behind a response by frequency."""
    return np.fft.irfft(np.fft.rfft(sound) * response, len(sound)).astype(np.float32)


# Examples.


def clean(
    clips: Sequence[Sound], chance: Chance, length: int = LENGTH
) -> tuple[Sound, list[tuple[int, int]]]:
    """`length` samples with some clips in them, at 16-bit full scale, and a whisper of noise.

    Beside them the numbers of the clips, and the sample at which each begins, on the GRID.
    """
    sound = np.zeros(length, np.float32)
    placed: list[tuple[int, int]] = []
    position = int(chance.integers(-RATE // 2, RATE))
    level = 3000 * decibels(chance.normal(0, 5))
    while position < length - RATE // 2:
        number = int(chance.integers(len(clips)))
        clip = clips[number] * (level / np.sqrt(active_power(clips[number])))
        start = position // GRID * GRID
        placed.append((number, start))
        position = start + len(clip) + int(chance.exponential(RATE / 2))
        part = clip[max(-start, 0) : length - start]
        sound[max(start, 0) : max(start, 0) + len(part)] += part
    return sound + chance.normal(0, 3, length).astype(np.float32), placed


def noisy(sound: Sound, noises: Sequence[Sound], chance: Chance) -> Sound:
    """The same sound as a microphone in a noisy room gets it."""
    power, length = active_power(sound), len(sound)
    if chance.random() < 0.5:
        sound = filtered(sound, room(chance, length))
    if chance.random() < 0.8:
        ratio = chance.triangular(1, 7, 18) if chance.random() < 0.85 else chance.uniform(18, 40)
        noise = noises[chance.integers(len(noises))]
        start = chance.integers(TRACK - length)
        sound = sound + noise[start : start + length].astype(np.float32) * (
            power**0.5 * decibels(-ratio)
        )
    if chance.random() < 0.6:
        sound = filtered(sound, microphone(chance, length))
    level = np.sqrt(active_power(sound))
    loudness = chance.uniform(300, 8000) if chance.random() < 0.5 else level
    return np.clip(np.round(sound * (loudness / level)), -32768, 32767).astype(np.float32)
