"""Lets people speak whom there are not: `python vary.py speech.npz --minutes 5`.

Takes clips apart into pitch, envelope and breath, changes them, and puts them together again with
the vocoder WORLD (M. Morise, F. Yokomori, K. Ozawa, 2016): another pitch, more or less melody,
a shorter or longer throat, an envelope as blurred as that of voices which are made of statistics,
and a slower or faster tongue. Adds the results to the file.
"""

from __future__ import annotations

import argparse
import os
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import pyworld
from numpy.typing import NDArray
from sound import RATE

Clip = NDArray[np.int16]

FRAME_MS = 5.0
LOUDEST = 0.5
SHORTEST = RATE // 3
"""Samples."""
VOICED = 10
"""Frames of a clip that must have a pitch."""
PITCH_RANGE = (75.0, 300.0)
"""Hz."""
THROATS = (0.82, 1.22)
"""By how much the envelope is stretched along the frequencies."""
BLURRED = 0.6
"""Share of envelopes reduced to a few cepstral coefficients and smoothed along time."""
LABELS = 4
"""Names that the new speakers share: the more, the more often they are learned from."""


def varied(clip: Clip, chance: np.random.Generator) -> Clip | None:
    """The same words of someone else; None for what has no pitch."""
    sound = clip / 32768
    rough, times = pyworld.dio(sound, RATE, frame_period=FRAME_MS)
    pitch = pyworld.stonemask(sound, rough, times, RATE)
    is_voiced = pitch > 0
    if is_voiced.sum() < VOICED:
        return None
    envelope = pyworld.cheaptrick(sound, pitch, times, RATE)
    breath = pyworld.d4c(sound, pitch, times, RATE)
    middle = float(np.exp(np.log(pitch[is_voiced]).mean()))
    wanted = float(np.clip(middle * 2 ** chance.normal(0, 0.35), *PITCH_RANGE))
    melody = chance.uniform(0.2, 1.3)
    pitch = np.where(is_voiced, wanted * (np.maximum(pitch, 1) / middle) ** melody, 0)
    # Who speaks higher has the shorter throat, as a rule.
    throat = 2 ** (np.log2(wanted / middle) / 4 + chance.normal(0, 0.09))
    envelope = stretched(envelope, float(np.clip(throat, *THROATS)))
    if chance.random() < BLURRED:
        envelope = blurred(envelope, int(chance.integers(20, 45)), int(chance.integers(1, 6)))
    if chance.random() < 0.5:
        breath = np.clip(breath ** chance.uniform(0.5, 2.5), 1e-6, 1 - 1e-6)
    pace = chance.uniform(0.85, 1.18)
    result = pyworld.synthesize(pitch, envelope, breath, RATE, FRAME_MS * pace)
    return np.round(result * (LOUDEST * 32767 / np.abs(result).max())).astype(np.int16)


def stretched(envelope: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
    """An envelope [frames, bins] along the frequencies."""
    last = envelope.shape[1] - 1
    places = np.minimum(np.arange(last + 1) / factor, last)
    lower = np.minimum(places.astype(int), last - 1)
    share = places - lower
    logs = np.log(envelope)
    between = logs[:, lower] * (1 - share) + logs[:, lower + 1] * share
    return np.ascontiguousarray(np.exp(between))


def blurred(envelope: NDArray[np.float64], numbers: int, frames: int) -> NDArray[np.float64]:
    """An envelope [frames, bins] from a few cepstral coefficients, averaged over some frames."""
    coded = pyworld.code_spectral_envelope(envelope, RATE, numbers)
    around = np.pad(coded, (((frames - 1) // 2, frames // 2), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(around, frames, axis=0)
    mean = np.ascontiguousarray(windows.mean(axis=-1))
    return pyworld.decode_spectral_envelope(mean, RATE, 2 * (envelope.shape[1] - 1))


def varied_for(seconds: float, file: Path, seed: int) -> list[tuple[Clip, str]]:
    """As many clips with their texts as can be made in this time, of all speakers."""
    chance = np.random.default_rng(seed)
    with np.load(file) as stored:
        clips = np.split(stored["clips"], stored["ends"][:-1])
        speakers, texts = stored["speakers"], stored["texts"]
    _, speaker, counts = np.unique(speakers, return_inverse=True, return_counts=True)
    weights = counts[speaker] ** -0.5
    found: list[tuple[Clip, str]] = []
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        number = int(chance.choice(len(clips), p=weights / weights.sum()))
        result = varied(clips[number], chance)
        if result is not None and len(result) >= SHORTEST:
            found.append((result, str(texts[number])))
    return found


def main() -> None:
    """Vary clips for some minutes and write the file again."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--minutes", type=float, default=5)
    parser.add_argument("--seed", type=int, default=9)
    args = parser.parse_args()
    workers = os.cpu_count() or 1
    seeds = range(args.seed * 1000, args.seed * 1000 + workers)
    with ProcessPoolExecutor(workers) as pool:
        parts = list(pool.map(partial(varied_for, 60 * args.minutes, args.file), seeds))
    found = [clip for part in parts for clip in part]
    stored = dict(np.load(args.file))
    ends = np.cumsum([len(clip) for clip, _ in found]) + len(stored["clips"])
    stored["clips"] = np.concatenate([stored["clips"], *(clip for clip, _ in found)])
    stored["ends"] = np.concatenate([stored["ends"], ends])
    names = np.array([f"varied {number % LABELS}" for number in range(len(found))])
    stored["speakers"] = np.concatenate([stored["speakers"], names])
    stored["texts"] = np.concatenate([stored["texts"], np.array([text for _, text in found])])
    np.savez(args.file, **stored)
    minutes = sum(len(clip) for clip, _ in found) / RATE / 60
    print(f"{args.file}: {len(found)} clips more, {minutes:.0f} minutes")


if __name__ == "__main__":
    main()
