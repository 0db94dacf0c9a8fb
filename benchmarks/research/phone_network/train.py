"""Trains the phone network: `python train.py speech.npz network.npz --minutes 80`.

The teacher is the network that training starts from, on clean speech; the student hears the same
speech under noise (G. Hinton, O. Vinyals, J. Dean, "Distilling the knowledge in a neural network",
2015). It also learns the phones from `align.py` in their order, whenever they sound (A. Graves et
al., "Connectionist temporal classification", 2006). A matrix changes by the product of two narrow
ones (E. Hu et al., "LoRA", 2021). What is written is the exponential mean of the weights (B.
Polyak, A. Juditsky, 1992), and of their change only a part: what the network knows of people, whom
these voices are not, stays (M. Wortsman et al., "Robust fine-tuning of zero-shot models", 2022).
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from itertools import count
from pathlib import Path

import network
import numpy as np
import torch
from network import Stored, Weights, log_probabilities
from numpy.typing import NDArray
from sound import GRID, LENGTH, RATE, Sound, clean, noisy, tracks
from torch import Tensor
from torch.nn import functional

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.conformer import load_network
from hri.speech.recognizers.ctc.features import HOP, WIDTH, log_mel_of, padded
from hri.speech.recognizers.ctc.weights import FILE

Array = NDArray[np.float32]

BATCH = 16
RATE_OF_LEARNING = 7e-4
SMALLER = 0.3
"""The rate of what is learned by itself, relative to the narrow matrices."""
RANK = 48
"""Of the change of a matrix."""
WARM_UP = 200
"""Steps until the full rate of learning; it falls along a cosine until the end."""
MEAN = 0.999
"""How much of the mean of the weights stays at each step."""
PEAK_WEIGHT = 4.0
"""How much more a frame weighs in which the teacher hears a phone: most are blank."""
SEQUENCE_WEIGHT = 6.0
"""How much the phones in their order weigh, beside the frames."""
KEPT = 0.5
"""Part of the change that is written."""
DRAWN = 3
"""Times as many clips as there are, so that few are never drawn."""
MOST_PHONES = 96
"""In one example."""
LATEST = RATE // 50
"""Samples: a phone that begins so shortly before the end of an example is not asked for."""
WARPED = 0.5
"""How many of the examples are warped, and by which factors."""
WARPS = (0.84, 1.2)
PACED = 0.35
"""How many of the examples are faster or slower, and by which factors."""
PACES = (0.75, 1.7)
NOISES = 500
"""Tracks."""
ASIDE = ("allison", "flite")
ASIDE_OF_EACH = 24
"""Clips of these speakers on which the learning is watched, and which are not learned from."""
WATCHED_DB = (6.0, 12.0, 60.0)
NOT_TAUGHT = ("child", "whispered", "shouted")
"""Speakers whom the teacher hardly understands: of them, only the phones are learned."""
LEAST = 1e-7
AHEAD = 3
"""Batches that are made before they are asked for."""
REPORTED = 200
"""Steps between two reports."""


def evenly(
    speakers: NDArray[np.str_], aside: list[int], chance: np.random.Generator
) -> NDArray[np.intp]:
    """Numbers of clips, drawn so that a speaker of four times as many comes twice as often."""
    _, speaker, counts = np.unique(speakers, return_inverse=True, return_counts=True)
    weights = counts[speaker] ** -0.5
    weights[aside] = 0
    return chance.choice(len(speakers), DRAWN * len(speakers), p=weights / weights.sum())


@dataclass(frozen=True, eq=False)
class Lesson:
    """What is heard at once, and what it should be heard as."""

    mel: Array
    target: NDArray[np.float16]
    is_taught: NDArray[np.bool_]
    """Whether the teacher's word counts."""
    phones: NDArray[np.int32]


class Lessons:
    """Clean examples with what the teacher hears in them, and noise to lay over them."""

    def __init__(self, file: Path, teacher: Path, seed: int) -> None:
        self._seed = seed
        self._filters = network.read(teacher)["filters"]
        chance = np.random.default_rng(seed)
        with np.load(file) as stored:
            clips = np.split(stored["clips"], stored["ends"][:-1])
            phones = np.split(
                np.stack([stored["phones"], stored["starts"]], axis=1), stored["phone_ends"][:-1]
            )
            speakers = stored["speakers"]
        targets = taught(clips, ~np.isin(speakers, NOT_TAUGHT), teacher)
        aside = [
            number
            for speaker in ASIDE
            for number in np.flatnonzero(speakers == speaker)[::5][:ASIDE_OF_EACH]
        ]
        chosen = evenly(speakers, aside, chance)
        self._clips = [clips[number] for number in chosen]
        self._spoken = [phones[number] for number in chosen]
        self._targets = [targets[number] for number in chosen]
        self._noises = [track.astype(np.float16) for track in tracks(NOISES, self._clips, chance)]
        kept = [(number, *clean([clips[number]], chance)) for number in aside]
        self.watched_phones = np.stack(
            [
                phones_within([(phones[number], at) for _, at in placed])
                for number, _, placed in kept
            ]
        )
        self.watched = {
            ratio: np.stack(
                [frames(self._beside(sound, ratio, chance), self._filters) for _, sound, _ in kept]
            )
            for ratio in WATCHED_DB
        }

    def _beside(self, sound: Sound, ratio: float, chance: np.random.Generator) -> Sound:
        """A sound above noise, at a level difference in decibels."""
        noise = self._noises[chance.integers(len(self._noises))][:LENGTH].astype(np.float32)
        return sound + noise * np.float32(sound.std() * 10 ** (-ratio / 20))

    def batch(self, number: int) -> Lesson:
        """Log-mel frames of noisy examples, what is to be heard in each, and the phones."""
        chance = np.random.default_rng((self._seed, number))
        return Lesson(*map(np.stack, zip(*(self._one(chance) for _ in range(BATCH)), strict=True)))

    def _one(
        self, chance: np.random.Generator
    ) -> tuple[Array, NDArray[np.float16], np.bool_, NDArray[np.int32]]:
        pace = chance.uniform(*PACES) if chance.random() < PACED else 1.0
        sound, placed = clean(self._clips, chance, math.ceil(LENGTH * pace))
        heard = [(self._targets[clip], start) for clip, start in placed]
        is_taught = pace == 1.0 and all(target is not None for target, _ in heard)
        mel = frames(noisy(sound, self._noises, chance), warped(self._filters, chance), pace)
        phones = phones_within([(self._spoken[clip], start) for clip, start in placed], pace)
        return mel, composed(heard), np.bool_(is_taught), phones


Target = NDArray[np.float16] | None
"""What the teacher hears in a clip, [frames, classes]; None where it has no say."""


def taught(
    clips: list[NDArray[np.int16]], is_taught: NDArray[np.bool_], teacher: Path
) -> list[Target]:
    """What the teacher hears in each clip."""
    with ProcessPoolExecutor() as pool:
        chosen = (clip for clip, is_one in zip(clips, is_taught, strict=True) if is_one)
        found = pool.map(partial(posteriors, teacher), chosen, chunksize=64)
        return [next(found) if is_one else None for is_one in is_taught]


network_of = cache(load_network)


def posteriors(teacher: Path, clip: NDArray[np.int16]) -> NDArray[np.float16]:
    """Chances of the classes, [frames, classes]."""
    return np.exp(network_of(str(teacher)).posteriors(clip)).astype(np.float16)


def composed(heard: list[tuple[Target, int]]) -> NDArray[np.float16]:
    """What is heard in an example that is composed of clips, given where each begins."""
    count = LENGTH // GRID + 1
    whole = np.zeros((count, len(CLASSES)), np.float16)
    whole[:, 0] = 1.0
    for target, start in heard:
        if target is not None:
            first = start // GRID
            part = target[max(-first, 0) : max(count - first, 0)]
            whole[max(first, 0) : max(first, 0) + len(part)] = part
    return whole


def frames(sound: Sound, filters: Array, pace: float = 1.0) -> Array:
    """Log-mel frames of an example, said faster by a factor: its windows lie further apart."""
    begins = np.round(np.arange(LENGTH // HOP + 1) * HOP * pace).astype(int)
    windows = np.lib.stride_tricks.sliding_window_view(padded(sound), WIDTH)
    apart = windows[np.minimum(begins, len(windows) - 1)]
    return np.pad(log_mel_of(apart, filters), ((1, 1), (0, 0)))


def warped(filters: Array, chance: np.random.Generator) -> Array:
    """The filters [bins, bands] as if the mouth of the speaker were smaller or larger.

    The lower frequencies are stretched, the highest stays (L. Lee, R. Rose, "A frequency warping
    approach to speaker normalization", 1998).
    """
    if chance.random() > WARPED:
        return filters
    factor = chance.uniform(*WARPS)
    last = len(filters) - 1
    bend = 0.8 * last / max(factor, 1)
    places = np.interp(np.arange(last + 1), [0, bend, last], [0, bend * factor, last])
    lower = np.minimum(places.astype(int), last - 1)
    share = (places - lower)[:, None].astype(np.float32)
    return filters[lower] * (1 - share) + filters[lower + 1] * share


def phones_within(
    placed: list[tuple[NDArray[np.int32], int]], pace: float = 1.0
) -> NDArray[np.int32]:
    """The phones [MOST_PHONES] that begin in an example, in order; then 0.

    Given are the classes and beginnings [phones, 2] of clips, where each of these begins, and by
    which factor all of them are said faster.
    """
    classes = [
        phone
        for phones, start in placed
        for phone, begins in phones
        if 0 <= start + begins < LENGTH * pace - LATEST
    ][:MOST_PHONES]
    return np.pad(np.array(classes, np.int32), (0, MOST_PHONES - len(classes)))


def loss(weights: Weights, lesson: Lesson) -> Tensor:
    """How far the student is from the teacher, and from what was said, a frame.

    The first frame by frame, by Kullback and Leibler's measure; the second by how likely it finds
    the phones in their order, whenever they sound.
    """
    target = torch.from_numpy(lesson.target.astype(np.float32))
    phones = torch.from_numpy(lesson.phones.astype(np.int64))
    with torch.autocast("cpu", torch.bfloat16):
        heard = log_probabilities(weights, torch.from_numpy(lesson.mel))
    apart = (target * (target.clamp_min(LEAST).log() - heard)).sum(dim=-1)
    apart = (apart * (1 + PEAK_WEIGHT * (1 - target[..., 0]))).mean(dim=-1)
    apart = (apart * torch.from_numpy(lesson.is_taught)).mean()
    return apart + SEQUENCE_WEIGHT * unlikely(heard, phones).mean() / heard.shape[1]


def unlikely(heard: Tensor, phones: Tensor) -> Tensor:
    """Negative logarithm of the chance to hear phones [batch, MOST_PHONES] in their order."""
    batch, frames, _ = heard.shape
    lengths = torch.full((batch,), frames), (phones > 0).sum(dim=1)
    return functional.ctc_loss(
        heard.transpose(0, 1), phones, *lengths, reduction="none", zero_infinity=True
    )


TALL, WIDE = " tall", " wide"
"""Ends of the names of the two narrow matrices."""


def beginning(tensors: Stored) -> dict[str, Tensor]:
    """What is learned: of a large matrix two narrow ones, whose product is 0; the rest as it is."""
    chance = torch.Generator().manual_seed(3)
    learned = {}
    for name, tensor in tensors.items():
        if tensor.ndim == 2 and min(tensor.shape) > RANK:
            height, width = tensor.shape
            learned[name + TALL] = torch.randn(height, RANK, generator=chance) * height**-0.5
            learned[name + WIDE] = torch.zeros(RANK, width)
        else:
            learned[name] = torch.tensor(tensor)
    return learned


class Student:
    """The network that learns, and the mean of what it has learned."""

    def __init__(self, tensors: Stored) -> None:
        self._filters = tensors["filters"]
        tensors = {name: tensor for name, tensor in tensors.items() if name != "filters"}
        self._before = {name: torch.from_numpy(tensor) for name, tensor in tensors.items()}
        self._learned = beginning(tensors)
        self._mean = {name: part.clone() for name, part in self._learned.items()}
        for part in self._learned.values():
            part.requires_grad_()
        narrow = [part for name, part in self._learned.items() if name.endswith((TALL, WIDE))]
        others = [part for name, part in self._learned.items() if not name.endswith((TALL, WIDE))]
        self._optimizer = torch.optim.Adam(
            [{"params": narrow, "share": 1.0}, {"params": others, "share": SMALLER}],
            betas=(0.9, 0.99), fused=True,
        )  # fmt: skip
        self._number = 0

    def _weights(self, learned: Weights) -> dict[str, Tensor]:
        return {
            name: learned[name] if name in learned
            else before + learned[name + TALL] @ learned[name + WIDE]
            for name, before in self._before.items()
        }  # fmt: skip

    def learn(self, lesson: Lesson, rate: float) -> float:
        """One step; the loss before it."""
        value = loss(self._weights(self._learned), lesson)
        self._optimizer.zero_grad()
        value.backward()
        torch.nn.utils.clip_grad_norm_(self._learned.values(), 1.0)
        for group in self._optimizer.param_groups:
            group["lr"] = rate * group["share"]
        self._optimizer.step()
        self._number += 1
        kept = min(MEAN, (1 + self._number) / (10 + self._number))
        with torch.no_grad():
            means, learned = list(self._mean.values()), list(self._learned.values())
            torch._foreach_lerp_(means, learned, 1.0 - kept)
        return float(value.detach())

    def cost(self, mels: Array, phones: NDArray[np.int32]) -> float:
        """What a phone costs with the whole change: negative logarithm of its chance."""
        total = 0.0
        weights = self._weights(self._mean)
        with torch.no_grad():
            for begin in range(0, len(mels), BATCH):
                heard = log_probabilities(weights, torch.from_numpy(mels[begin : begin + BATCH]))
                wanted = torch.from_numpy(phones[begin : begin + BATCH].astype(np.int64))
                total += float(unlikely(heard, wanted).sum())
        return total / int((phones > 0).sum())

    def write(self, file: Path, kept: float) -> None:
        """What was known before, and the part of the change that is kept, 0 to 1."""
        tensors = {
            name: torch.lerp(self._before[name], weight, kept).numpy()
            for name, weight in self._weights(self._mean).items()
        }
        network.write({"filters": self._filters} | tensors, file)


_lessons: Lessons
"""Of a separate process: what it was forked with, which is too much to be sent to it."""


def _batch(number: int) -> Lesson:
    return _lessons.batch(number)


def batches(lessons: Lessons) -> Iterator[Lesson]:
    """One batch after another, made in a separate process while the one before is learned from."""
    global _lessons
    _lessons = lessons
    with multiprocessing.get_context("fork").Pool(1) as pool:
        coming = [pool.apply_async(_batch, (number,)) for number in range(AHEAD)]
        for number in count(AHEAD):
            coming.append(pool.apply_async(_batch, (number,)))
            yield coming.pop(0).get()


def main() -> None:
    """Train for some minutes and write the file, now and then in between."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("speech", type=Path)
    parser.add_argument("file", type=Path)
    parser.add_argument("--start", type=Path, default=FILE, help="the network that learns")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--rate", type=float, default=RATE_OF_LEARNING)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--kept", type=float, default=KEPT, help="part of what it learns")
    args = parser.parse_args()
    lessons = Lessons(args.speech, args.start, args.seed)
    student = Student(network.read(args.start))

    def report(number: int, losses: list[float]) -> None:
        costs = [
            f"{ratio:g} dB {student.cost(mels, lessons.watched_phones):.3f}"
            for ratio, mels in lessons.watched.items()
        ]
        minutes = (time.perf_counter() - begun) / 60
        now = f"{minutes:5.1f} min, step {number}: loss {np.mean(losses or [math.nan]):.4f}"
        print(now, *costs, sep=", ", flush=True)
        student.write(args.file, args.kept)

    begun = time.perf_counter()
    losses: list[float] = []
    report(0, losses)
    for number, lesson in enumerate(batches(lessons), 1):
        done = (time.perf_counter() - begun) / 60 / args.minutes
        if done >= 1:
            break
        rate = args.rate * min(1, number / WARM_UP) * (1 + math.cos(math.pi * done)) / 2
        losses.append(student.learn(lesson, rate))
        if number % REPORTED == 0:
            report(number, losses[-REPORTED:])
    report(len(losses), losses[-REPORTED:])


if __name__ == "__main__":
    main()
