"""Trains the adaptation: `python train.py speech.npz adaptation.npz --minutes 60`.

The teacher is the network as it comes, on clean speech; the student is the network with the
change that is learned, on the same speech under noise (G. Hinton, O. Vinyals, J. Dean, "Distilling
the knowledge in a neural network", 2015). It also learns the phones from `align.py`. A matrix
changes by the product of two narrow ones (E. Hu et al., "LoRA", 2021), everything smaller by
itself. The file is what `hri.speech.recognizers.ctc.adaptation` reads; given with --start, training
goes on from it.
"""

from __future__ import annotations

import argparse
import math
import os
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=true")

import jax
import jax.numpy as jnp
import numpy as np
import optax
from jax import Array
from jax.typing import ArrayLike
from numpy.typing import NDArray
from sound import LENGTH, RATE, Sound, clean, noisy, tracks

from hri.speech.recognizers.ctc.adaptation import TALL, WIDE
from hri.speech.recognizers.ctc.classes import folding
from hri.speech.recognizers.ctc.conformer import BLOCKS, DIMENSION, HEADS, TAPS
from hri.speech.recognizers.ctc.features import log_mel, padded
from hri.speech.recognizers.ctc.weights import Tensor, find_weights, read_tensors

Change = dict[str, Array]
"""What is learned, by the names of the file."""

RANK = 48
BATCH = 8
RATE_OF_LEARNING = 7e-4
WARM_UP = 40
"""Steps until the full rate of learning; it falls along a cosine until the end."""
SMALLER = 0.3
"""The rate of what is learned by itself, relative to the matrices."""
PEAK_WEIGHT = 4.0
"""How much more a frame weighs in which the teacher hears a phone: most are blank."""
SEQUENCE_WEIGHT = 6.0
"""How much the phones in their order weigh, beside the frames."""
MOST_PHONES = 96
"""In one example."""
LATEST = RATE // 50
"""Samples: a phone that begins so shortly before the end of an example is not asked for."""
WARPED = 0.5
"""How many of the examples are warped, and by which factors."""
WARPS = (0.86, 1.16)
NOISES = 400
"""Tracks."""
ASIDE = ("allison", "flite")
ASIDE_OF_EACH = 24
"""Clips of these speakers on which the learning is watched, and which are not learned from."""
WATCHED_DB = (6.0, 12.0, 60.0)
SPAN = 40
"""Frames that one product of the convolution makes."""


# The network, as hri.speech.recognizers.ctc.conformer runs it.


class Weights:
    """The tensors of the network with a change laid over them."""

    def __init__(self, tensors: dict[str, Array], change: Change) -> None:
        self._tensors = tensors
        self._change = change

    def __getitem__(self, name: str) -> Array:
        tensor = self._tensors[name]
        change = self._change.get(name)
        return tensor if change is None else tensor + change

    def product(self, frames: Array, name: str) -> Array:
        """Frames times a matrix; kernels of one frame are matrices as well, transposed."""
        matrix = self[name]
        is_kernel = matrix.ndim == 3
        matrix = matrix[:, :, 0].T if is_kernel else matrix
        output = frames @ matrix
        if name + TALL in self._change:
            tall, wide = self._change[name + TALL], self._change[name + WIDE]
            # The file has the change as the tensor lies.
            output += (frames @ wide.T) @ tall.T if is_kernel else (frames @ tall) @ wide
        return output


def normalized(frames: Array, weights: Weights, name: str) -> Array:
    """Mean 0 and variance 1 over the dimensions, then a gain and a shift."""
    centered = frames - frames.mean(axis=-1, keepdims=True)
    variance = (centered**2).mean(axis=-1, keepdims=True)
    scaled = centered * jax.lax.rsqrt(variance + 1e-5)
    return scaled * weights[f"{name}.weight"] + weights[f"{name}.bias"]


def feed_forward(frames: Array, weights: Weights, name: str, number: int) -> Array:
    """Half a feed-forward layer."""
    hidden = weights.product(normalized(frames, weights, f"{name}.norm"), f"onnx::MatMul_{number}")
    hidden = jax.nn.silu(hidden + weights[f"{name}.fc1.bias"])
    return 0.5 * (
        weights.product(hidden, f"onnx::MatMul_{number + 1}") + weights[f"{name}.fc2.bias"]
    )


def attention(frames: Array, weights: Weights, name: str, number: int) -> Array:
    """Every frame looks at every other."""
    inward = normalized(frames, weights, f"{name}.attn_norm")
    inward = weights.product(inward, f"onnx::MatMul_{number}")
    inward += weights[f"{name}.attn.in_proj_bias"]
    batch, count, _ = frames.shape
    parts = inward.reshape(batch, count, 3, HEADS, -1)
    queries, keys, values = (parts[:, :, part] for part in range(3))
    likeness = jnp.einsum("bqhd,bkhd->bhqk", queries, keys) * (DIMENSION / HEADS) ** -0.5
    seen = jnp.einsum("bhqk,bkhd->bqhd", jax.nn.softmax(likeness), values)
    seen = seen.reshape(batch, count, DIMENSION)
    outward = weights.product(seen, f"onnx::MatMul_{number + 4}")
    return outward + weights[f"{name}.attn.out_proj.bias"]


def convolution(frames: Array, weights: Weights, name: str, number: int) -> Array:
    """A gate, and a filter of each dimension along time."""
    inward = normalized(frames, weights, f"{name}.norm")
    inward = weights.product(inward, f"{name}.pointwise1.weight")
    inward += weights[f"{name}.pointwise1.bias"]
    gated = inward[..., :DIMENSION] * jax.nn.sigmoid(inward[..., DIMENSION:])
    filtered = along_time(gated, weights[f"onnx::Conv_{number}"][:, 0])
    filtered = jax.nn.silu(filtered + weights[f"onnx::Conv_{number + 1}"])
    outward = weights.product(filtered, f"{name}.pointwise2.weight")
    return outward + weights[f"{name}.pointwise2.bias"]


def along_time(frames: Array, taps: Array) -> Array:
    """TAPS taps along time, as products of pieces with a banded matrix, which is faster."""
    count = frames.shape[1]
    pieces = -(-count // SPAN)
    half = TAPS // 2
    around = jnp.pad(frames, ((0, 0), (half, half + pieces * SPAN - count), (0, 0)))
    windows = jnp.stack(
        [around[:, SPAN * i : SPAN * i + SPAN + TAPS - 1] for i in range(pieces)], axis=1
    )
    offset = np.arange(SPAN + TAPS - 1)[:, None] - np.arange(SPAN)
    places = (offset == np.arange(TAPS)[:, None, None]).astype(np.float32)
    banded = jnp.einsum("ct,twj->cwj", taps, places)
    filtered = jnp.einsum("bpwc,cwj->bpjc", windows, banded)
    return filtered.reshape(frames.shape[0], -1, DIMENSION)[:, :count]


def probabilities(weights: Weights, fold: ArrayLike, mel: Array) -> Array:
    """Of CLASSES, shape [batch, frames, classes], of log-mel frames [batch, 2 * frames + 1, 80]."""
    count = (mel.shape[1] - 1) // 2
    windows = jnp.concatenate([mel[:, tap : tap + 2 * count : 2] for tap in range(3)], axis=-1)
    stem = weights["onnx::Conv_801"].transpose(2, 1, 0).reshape(-1, DIMENSION)
    frames = jax.nn.gelu(windows @ stem + weights["onnx::Conv_802"], approximate=False)
    for block in range(BLOCKS):
        name = f"acoustic_model.model.blocks.{block}"
        frames += feed_forward(frames, weights, f"{name}.ffn1", 829 + 9 * block)
        frames += attention(frames, weights, name, 831 + 9 * block)
        frames += convolution(frames, weights, f"{name}.conv", 804 + 3 * block)
        frames += feed_forward(frames, weights, f"{name}.ffn2", 836 + 9 * block)
        frames = normalized(frames, weights, f"{name}.norm")
    head = "acoustic_model.model.proj"
    tokens = jax.nn.softmax(weights.product(frames, f"{head}.weight") + weights[f"{head}.bias"])
    folded = tokens @ fold
    return folded / folded.sum(axis=-1, keepdims=True)


# What is learned.


def is_matrix(name: str) -> bool:
    """Whether a tensor changes by the product of two narrow ones."""
    return name.startswith("onnx::MatMul") or ("pointwise" in name and name.endswith(".weight"))


def beginning(tensors: dict[str, Tensor], start: Path | None) -> Change:
    """No change, or that of a file, of RANK."""
    chance = np.random.default_rng(3)
    known = dict(np.load(start)) if start else {}
    change: dict[str, NDArray[np.float32]] = {}
    for name, tensor in tensors.items():
        if name == "mel_fb" or name.startswith("stft"):
            continue
        if not is_matrix(name):
            change[name] = known.get(name, np.zeros(tensor.shape)).astype(np.float32)
            continue
        height, width = tensor.shape[:2]
        tall = chance.normal(0, height**-0.5, (height, RANK)).astype(np.float32)
        wide = np.zeros((RANK, width), np.float32)
        if name + TALL in known:
            given, other = known[name + TALL], known[name + WIDE]
            rank, scale = given.shape[1], float(given.astype(np.float32).std()) * height**0.5
            tall[:, :rank], wide[:rank] = given / scale, other * scale
        change[name + TALL], change[name + WIDE] = tall, wide
    return {name: jnp.array(value) for name, value in change.items()}


def write(change: Change, file: Path) -> None:
    """As 16-bit floats, the two factors of a matrix equally large."""
    stored: dict[str, NDArray[np.float16]] = {}
    for name, value in change.items():
        scale = 1.0
        if name.endswith((TALL, WIDE)):
            stem = name.removesuffix(TALL).removesuffix(WIDE)
            tall, wide = (float(jnp.abs(change[stem + end]).max()) for end in (TALL, WIDE))
            scale = math.sqrt((wide + 1e-9) / tall)
            scale = scale if name.endswith(TALL) else 1 / scale
        stored[name] = np.asarray(value * scale, np.float16)
    np.savez_compressed(file, **stored)


def loss(
    change: Change, tensors: dict[str, Array], fold: Array, mel: Array, target: Array,
    phones: Array,
) -> Array:  # fmt: skip
    """How far the student is from the teacher, and from what was said, a frame.

    The first frame by frame, by Kullback and Leibler's measure; the second by how likely it finds
    the phones in their order, whenever they sound (A. Graves et al., "Connectionist temporal
    classification", 2006).
    """
    heard = jnp.log(jnp.maximum(probabilities(Weights(tensors, change), fold, mel), 1e-7))
    apart = (target * (jnp.log(jnp.maximum(target, 1e-7)) - heard)).sum(axis=-1)
    apart = (apart * (1 + PEAK_WEIGHT * (1 - target[..., 0]))).mean()
    nothing = jnp.zeros(heard.shape[:2])
    unlikely = optax.ctc_loss(heard, nothing, phones, (phones == 0).astype(float))
    return apart + SEQUENCE_WEIGHT * unlikely.mean() / heard.shape[1]


@partial(jax.jit, donate_argnums=(0, 1, 2))
def step(
    change: Change, mean: Change, square: Change, tensors: dict[str, Array], fold: Array,
    mel: Array, target: Array, phones: Array, number: Array, rate: Array,
) -> tuple[Change, Change, Change, Array]:  # fmt: skip
    """One step of Adam (D. Kingma, J. Ba, 2015) with the gradient's length kept below 1."""
    value, gradient = jax.value_and_grad(loss)(change, tensors, fold, mel, target, phones)
    length = jnp.sqrt(sum((part**2).sum() for part in gradient.values()))
    shorter = jnp.minimum(1, 1 / length)
    result: Change = {}
    for name, part in gradient.items():
        mean[name] = 0.9 * mean[name] + 0.1 * part * shorter
        square[name] = 0.99 * square[name] + 0.01 * (part * shorter) ** 2
        towards = mean[name] / (1 - 0.9**number)
        towards /= jnp.sqrt(square[name] / (1 - 0.99**number)) + 1e-8
        own = rate if name.endswith((TALL, WIDE)) else SMALLER * rate
        result[name] = change[name] - own * towards
    return result, mean, square, value


# What is heard.


def evenly(
    speakers: NDArray[np.str_], aside: list[int], chance: np.random.Generator
) -> NDArray[np.intp]:
    """Numbers of clips, drawn so that a speaker of four times as many comes twice as often."""
    _, speaker, counts = np.unique(speakers, return_inverse=True, return_counts=True)
    weights = counts[speaker] ** -0.5
    weights[aside] = 0
    return chance.choice(len(speakers), len(speakers), p=weights / weights.sum())


class Lessons:
    """Clean examples with what the teacher hears in them, and noise to lay over them."""

    def __init__(self, file: Path, tensors: dict[str, Tensor], examples: int, seed: int) -> None:
        self._chance = np.random.default_rng(seed)
        self._filters = tensors["mel_fb"]
        self._tensors = {name: jnp.array(tensor) for name, tensor in tensors.items()}
        self._teacher = jax.jit(partial(probabilities, Weights(self._tensors, {}), folding()))
        with np.load(file) as stored:
            clips = np.split(stored["clips"].astype(np.float32), stored["ends"][:-1])
            phones = np.split(
                np.stack([stored["phones"], stored["starts"]], axis=1), stored["phone_ends"][:-1]
            )
            speakers = stored["speakers"]
        aside = [
            number
            for speaker in ASIDE
            for number in np.flatnonzero(speakers == speaker)[::5][:ASIDE_OF_EACH]
        ]
        chosen = evenly(speakers, aside, self._chance)
        learned = [clips[number] for number in chosen]
        self._noises = tracks(NOISES, learned, self._chance)
        made = [clean(learned, self._chance) for _ in range(examples)]
        self._clean = [sound for sound, _ in made]
        spoken = [[(phones[chosen[clip]], start) for clip, start in placed] for _, placed in made]
        self._phones = np.stack(list(map(phones_within, spoken)))
        self._targets = self.targets(self._clean)
        kept = [clean([clips[number]], self._chance)[0] for number in aside]
        self.watched_targets = self.targets(kept)
        self.watched = {
            ratio: np.stack([self._mel(self._beside(sound, ratio)) for sound in kept])
            for ratio in WATCHED_DB
        }

    def _beside(self, sound: Sound, ratio: float) -> Sound:
        """A sound above noise, at a level difference in decibels."""
        noise = self._noises[self._chance.integers(len(self._noises))][:LENGTH]
        return sound + noise * (sound.std() * 10 ** (-ratio / 20))

    def _mel(self, sound: Sound, filters: NDArray[np.float32] | None = None) -> NDArray[np.float32]:
        filters = self._filters if filters is None else filters
        return np.pad(log_mel(padded(sound), filters), ((1, 1), (0, 0)))

    def targets(self, sounds: list[Sound]) -> NDArray[np.float16]:
        """What the teacher hears."""
        heard = []
        for start in range(0, len(sounds), BATCH):
            mel = np.stack([self._mel(sound) for sound in sounds[start : start + BATCH]])
            heard.append(np.asarray(self._teacher(mel), np.float16))
        return np.concatenate(heard)

    def batch(self) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.int32]]:
        """Log-mel frames of noisy examples, what is to be heard in each, and the phones."""
        chosen = self._chance.integers(len(self._clean), size=BATCH)
        sounds = [noisy(self._clean[number], self._noises, self._chance) for number in chosen]
        filters = [warped(self._filters, self._chance) for _ in sounds]
        mel = np.stack(list(map(self._mel, sounds, filters)))
        return mel, self._targets[chosen].astype(np.float32), self._phones[chosen]


def warped(filters: NDArray[np.float32], chance: np.random.Generator) -> NDArray[np.float32]:
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


def phones_within(placed: list[tuple[NDArray[np.int32], int]]) -> NDArray[np.int32]:
    """The phones [MOST_PHONES] that begin in an example, in order; then 0.

    Given are the classes and beginnings [phones, 2] of clips, and where each of these begins.
    """
    classes = [
        phone
        for phones, start in placed
        for phone, begins in phones
        if 0 <= start + begins < LENGTH - LATEST
    ][:MOST_PHONES]
    return np.pad(np.array(classes, np.int32), (0, MOST_PHONES - len(classes)))


def agreement(heard: NDArray[np.float32], target: NDArray[np.float16]) -> float:
    """In how much of the frames with a phone the student hears the one that the teacher hears."""
    best = target.argmax(axis=-1)
    return float((heard.argmax(axis=-1) == best)[best > 0].mean())


def main() -> None:
    """Train for some minutes and write the file, now and then in between."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("speech", type=Path)
    parser.add_argument("file", type=Path)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--examples", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--start", type=Path)
    args = parser.parse_args()
    tensors = dict(read_tensors(find_weights()))
    lessons = Lessons(args.speech, tensors, args.examples, args.seed)
    change = beginning(tensors, args.start)
    learned = {name: jnp.array(tensor) for name, tensor in tensors.items()}
    fold = jnp.array(folding())
    student = jax.jit(lambda change, mel: probabilities(Weights(learned, change), fold, mel))

    def report(number: int, losses: list[float]) -> None:
        shares = []
        for ratio, mels in lessons.watched.items():
            heard = [student(change, mels[i : i + BATCH]) for i in range(0, len(mels), BATCH)]
            share = agreement(np.concatenate(heard), lessons.watched_targets)
            shares.append(f"{ratio:g} dB {share:.3f}")
        minutes = (time.perf_counter() - begun) / 60
        now = f"{minutes:5.1f} min, step {number}: loss {np.mean(losses or [math.nan]):.4f}"
        print(now, *shares, sep=", ", flush=True)
        write(change, args.file)

    mean = {name: jnp.zeros_like(part) for name, part in change.items()}
    square = {name: jnp.zeros_like(part) for name, part in change.items()}
    begun = time.perf_counter()
    losses: list[float] = []
    number = 0
    report(number, losses)
    with ThreadPoolExecutor(1) as reader:
        coming = reader.submit(lessons.batch)
        while (done := (time.perf_counter() - begun) / 60 / args.minutes) < 1:
            mel, target, phones = coming.result()
            coming = reader.submit(lessons.batch)
            number += 1
            rate = RATE_OF_LEARNING * min(1, number / WARM_UP) * (1 + math.cos(math.pi * done)) / 2
            change, mean, square, value = step(
                change, mean, square, learned, fold, mel, target, phones, float(number), rate
            )
            losses.append(float(value))
            if number % 300 == 0:
                report(number, losses[-300:])
    report(number, losses[-300:])


if __name__ == "__main__":
    main()
