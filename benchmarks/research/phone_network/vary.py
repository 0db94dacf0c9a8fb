"""Lets people speak whom there are not: `python vary.py speech.npz --minutes 5`.

Takes clips apart into pitch, envelope and breath, changes them, and puts them together again with
the vocoder WORLD (M. Morise, F. Yokomori, K. Ozawa, 2016): another pitch, more or less melody,
a shorter or longer throat, an envelope as blurred as that of voices which are made of statistics,
and a slower or faster tongue. Some become children, some whisper, some shout. Adds the results to
the file, with the phones that `align.py` found in the clips they are made of.
"""

from __future__ import annotations

import argparse
import os
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pyworld
from numpy.typing import NDArray
from sound import RATE

Samples = NDArray[np.int16]
Floats = NDArray[np.float64]

FRAME_MS = 5.0
LOUDEST = 0.5
SHORTEST = RATE // 3
"""Samples."""
VOICED = 10
"""Frames of a clip that must have a pitch."""
KINDS = {"varied": 0.76, "child": 0.12, "whispered": 0.05, "shouted": 0.07}
"""Who speaks, and how often."""
PITCH_RANGE = (75.0, 380.0)
"""Hz."""
CHILD_PITCH = (220.0, 380.0)
"""Hz."""
SHOUTED_PITCH = (1.3, 1.9)
"""Factors."""
TILT_DB = (1.5, 4.0)
"""By how much a shout and a whisper gain for each octave from 500 Hz to 4 kHz."""
THROATS = (0.82, 1.4)
"""By how much the envelope is stretched along the frequencies."""
PACES = (0.8, 1.25)
BLURRED = 0.6
"""Share of envelopes reduced to a few cepstral coefficients and smoothed along time."""
LABELS = 4
"""Names that the new speakers of the first kind share: the more, the more often they are heard."""


@dataclass(frozen=True, slots=True)
class Clip:
    """Who says what."""

    speaker: str
    text: str
    samples: Samples
    phones: NDArray[np.int32]
    """[phones, 2] Class, and the sample at which it begins."""


def varied(clip: Clip, kind: str, chance: np.random.Generator) -> Clip | None:
    """The same words of someone else; None for what has no pitch."""
    sound = clip.samples / 32768
    rough, times = pyworld.dio(sound, RATE, frame_period=FRAME_MS)
    pitch = pyworld.stonemask(sound, rough, times, RATE)
    is_voiced = pitch > 0
    if is_voiced.sum() < VOICED:
        return None
    envelope = pyworld.cheaptrick(sound, pitch, times, RATE)
    breath = pyworld.d4c(sound, pitch, times, RATE)
    middle = float(np.exp(np.log(pitch[is_voiced]).mean()))
    usual = (
        chance.uniform(*CHILD_PITCH) if kind == "child" else middle * 2 ** chance.normal(0, 0.35)
    )
    wanted = float(np.clip(usual, *PITCH_RANGE))
    # Who speaks higher has the shorter throat, as a rule.
    throat = 2 ** (np.log2(wanted / middle) / 4 + chance.normal(0, 0.09))
    envelope = stretched(envelope, float(np.clip(throat, *THROATS)))
    if chance.random() < BLURRED:
        envelope = blurred(envelope, int(chance.integers(20, 45)), int(chance.integers(1, 6)))
    if chance.random() < 0.5:
        breath = np.clip(breath ** chance.uniform(0.5, 2.5), 1e-6, 1 - 1e-6)
    if kind in ("whispered", "shouted"):
        envelope = tilted(envelope, chance.uniform(*TILT_DB))
    if kind == "shouted":
        wanted *= chance.uniform(*SHOUTED_PITCH)
    melody = chance.uniform(0.2, 1.3)
    pitch = np.where(is_voiced, wanted * (np.maximum(pitch, 1) / middle) ** melody, 0)
    if kind == "whispered":
        pitch, breath = np.zeros_like(pitch), np.full_like(breath, 1 - 1e-6)
    pace = chance.uniform(*PACES)
    result = pyworld.synthesize(pitch, envelope, breath, RATE, FRAME_MS * pace)
    if len(result) < SHORTEST:
        return None
    samples = np.round(result * (LOUDEST * 32767 / np.abs(result).max())).astype(np.int16)
    phones = np.round(clip.phones * (1, pace)).astype(np.int32)
    speaker = f"{kind} {chance.integers(LABELS)}" if kind == "varied" else kind
    return Clip(speaker, clip.text, samples, phones)


def stretched(envelope: Floats, factor: float) -> Floats:
    """An envelope [frames, bins] along the frequencies."""
    last = envelope.shape[1] - 1
    places = np.minimum(np.arange(last + 1) / factor, last)
    lower = np.minimum(places.astype(int), last - 1)
    share = places - lower
    logs = np.log(envelope)
    between = logs[:, lower] * (1 - share) + logs[:, lower + 1] * share
    return np.ascontiguousarray(np.exp(between))


def tilted(envelope: Floats, decibels: float) -> Floats:
    """An envelope [frames, bins] of power with more of the high frequencies."""
    frequencies = np.linspace(0, RATE / 2, envelope.shape[1])
    octaves = np.log2(np.clip(frequencies, 500, 4000) / 500)
    return np.ascontiguousarray(envelope * 10 ** (octaves * decibels / 10))


def blurred(envelope: Floats, numbers: int, frames: int) -> Floats:
    """An envelope [frames, bins] from a few cepstral coefficients, averaged over some frames."""
    coded = pyworld.code_spectral_envelope(envelope, RATE, numbers)
    around = np.pad(coded, (((frames - 1) // 2, frames // 2), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(around, frames, axis=0)
    mean = np.ascontiguousarray(windows.mean(axis=-1))
    return pyworld.decode_spectral_envelope(mean, RATE, 2 * (envelope.shape[1] - 1))


def read(file: Path) -> list[Clip]:
    """The clips of a file that `align.py` has seen."""
    with np.load(file) as stored:
        samples = np.split(stored["clips"], stored["ends"][:-1])
        both = np.stack([stored["phones"], stored["starts"]], axis=1)
        phones = np.split(both, stored["phone_ends"][:-1])
        names, texts = stored["speakers"].tolist(), stored["texts"].tolist()
    return list(map(Clip, names, texts, samples, phones))


def write(clips: list[Clip], file: Path) -> None:
    """In the form of `collect.py` and `align.py`."""
    phones = np.concatenate([clip.phones for clip in clips])
    np.savez(
        file,
        clips=np.concatenate([clip.samples for clip in clips]),
        ends=np.cumsum([len(clip.samples) for clip in clips]),
        speakers=np.array([clip.speaker for clip in clips]),
        texts=np.array([clip.text for clip in clips]),
        phones=phones[:, 0],
        starts=phones[:, 1],
        phone_ends=np.cumsum([len(clip.phones) for clip in clips]),
    )


def varied_for(seconds: float, file: Path, seed: int) -> list[Clip]:
    """As many clips as can be made in this time, of all speakers."""
    chance = np.random.default_rng(seed)
    clips = read(file)
    names = np.array([clip.speaker for clip in clips])
    _, speaker, counts = np.unique(names, return_inverse=True, return_counts=True)
    weights = counts[speaker] ** -0.5
    found: list[Clip] = []
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        clip = clips[int(chance.choice(len(clips), p=weights / weights.sum()))]
        kind = str(chance.choice(list(KINDS), p=list(KINDS.values())))
        if (result := varied(clip, kind, chance)) is not None:
            found.append(result)
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
    write([*read(args.file), *found], args.file)
    minutes = sum(len(clip.samples) for clip in found) / RATE / 60
    print(f"{args.file}: {len(found)} clips more, {minutes:.0f} minutes")


if __name__ == "__main__":
    main()
