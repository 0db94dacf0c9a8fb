"""The phone network: a conformer, run by numpy.

Log-mel frames, a convolution that halves their rate, blocks of (half a feed-forward layer,
attention over all frames, a convolution over 31 frames, half a feed-forward layer), and a
projection onto the classes (A. Gulati et al., "Conformer", Interspeech 2020). The network that
comes with `hri` has 4 blocks; how it was made:
benchmarks/research/phone_network/README.md. Trained by
connectionist temporal classification: most frames are blank, a phone shows as a peak of one or
two frames.

With one thread of OpenBLAS on a core of 2.6 GHz with AVX-512, 2 s of sound take 7.5 ms, 9 s 34 ms
and 15 s 73 ms (attention grows with the square); weights and work take 22 to 35 MB, loading some
50 ms. More threads made it slower, so `hri` asks for one unless OPENBLAS_NUM_THREADS says another.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np
from numpy.typing import NDArray

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.features import BANDS, BINS, WIDTH, Sound, log_mel, padded
from hri.speech.recognizers.ctc.weights import FILE, Tensor, find_weights, read_tensors, take

FRAME = 0.02
"""Seconds from one frame of posteriors to the next; frame i is about the sound at i * FRAME."""
DIMENSION = 144
HIDDEN = 4 * DIMENSION
HEADS = 4
TAPS = 31
"""Frames under the convolution of a block."""
STRIDE = 2
"""Log-mel frames to one frame of posteriors."""
FARTHEST = 1000
"""Frames (20 s, the longest piece of speech) that attention looks back over."""
_STEM_TAPS = 3
_EPSILON = 1e-5
_LEAST = -23.0
"""Natural log of the probability under which classes are not told apart."""

_MEAN = np.full(DIMENSION, 1.0 / DIMENSION, np.float32)

Frames = NDArray[np.float32]
"""Shape [frames, width of the layer]."""


class Conformer:
    """The loaded weights, in the order that numpy multiplies fastest; it never changes.

    Raises HriError when the tensors are those of another network.
    """

    def __init__(self, tensors: Mapping[str, Tensor]) -> None:
        self._filters = take(tensors, "filters", BINS, BANDS)
        self._stem = take(tensors, "stem.matrix", _STEM_TAPS * BANDS, DIMENSION)
        self._stem_bias = take(tensors, "stem.bias", DIMENSION)
        self._blocks = [Block(tensors, str(number)) for number in range(block_count(tensors))]
        self._head = take(tensors, "head.matrix", DIMENSION, len(CLASSES))
        self._head_bias = take(tensors, "head.bias", len(CLASSES))

    def posteriors(self, samples: Sound) -> NDArray[np.float32]:
        """Natural logs of the probabilities of CLASSES, shape [frames, 40], of 16 kHz sound.

        A frame every FRAME seconds, the first at 0: 1 + n // 320 of them for n samples, none for
        less than one window (25 ms). Time grows with the square of the length: what is longer than
        one piece of speech (20 s) is for `Stream`.
        """
        if len(samples) < WIDTH:
            return np.zeros((0, len(CLASSES)), np.float32)
        mel = self.log_mel(padded(samples))
        # One frame of silence at each end; the last may lie beyond what the last window needs.
        around = np.zeros((len(mel) + 2, BANDS), np.float32)
        around[1:-1] = mel
        return self.run(around, self.past(), 0)

    def log_mel(self, sound: NDArray[np.float32]) -> Frames:
        """Log-mel frames of sound by the filters that come with the weights."""
        return log_mel(sound, self._filters)

    def past(self) -> list[Past]:
        """What is known of earlier frames at the start: nothing."""
        return [Past() for _ in self._blocks]

    def run(self, mel: Frames, past: list[Past], settled: int) -> NDArray[np.float32]:
        """Posteriors of some frames after others: two log-mel frames each, and one before them.

        `past` is what earlier calls left, and gains the first `settled` of these frames; the frames
        after those are what these look ahead to, and will come again.
        """
        windows = np.lib.stride_tricks.sliding_window_view(mel.ravel(), _STEM_TAPS * BANDS)
        frames = _gelu(windows[:: STRIDE * BANDS] @ self._stem + self._stem_bias)
        for block, before in zip(self._blocks, past, strict=True):
            frames = block.run(frames, before, settled)
        return self._log_probabilities(frames)

    def _log_probabilities(self, frames: Frames) -> Frames:
        scores = frames @ self._head
        scores += self._head_bias
        scores -= scores.max(axis=1, keepdims=True)
        scores -= np.log(np.exp(scores).sum(axis=1, keepdims=True))
        likely: Frames = np.maximum(scores, _LEAST, out=scores)
        return likely


def block_count(tensors: Mapping[str, Tensor]) -> int:
    """How many blocks a network has."""
    return sum(name.endswith(".attention.inward.matrix") for name in tensors)


class Past:
    """What the frames of a block need to know of the frames before them."""

    def __init__(self) -> None:
        self.keys = np.zeros((HEADS, 0, DIMENSION // HEADS), np.float32)
        self.values = self.keys
        self.gated = np.zeros((0, DIMENSION), np.float32)
        """What the convolution filters, of the last half of its taps."""


class Block:
    """One block of the conformer."""

    def __init__(self, tensors: Mapping[str, Tensor], name: str) -> None:
        self._first = FeedForward(tensors, f"{name}.first")
        self._attention = Attention(tensors, f"{name}.attention")
        self._convolution = Convolution(tensors, f"{name}.convolution")
        self._second = FeedForward(tensors, f"{name}.second")
        self._norm = Norm(tensors, f"{name}.norm")

    def run(self, frames: Frames, past: Past, settled: int) -> Frames:
        """The frames one block on; `frames` is used up. `past` gains the first `settled`."""
        frames += self._first.run(frames)
        frames += self._attention.run(frames, past, settled)
        frames += self._convolution.run(frames, past, settled)
        frames += self._second.run(frames)
        return self._norm.run(frames)


class Norm:
    """Mean 0 and variance 1 over the dimensions, then a gain and a shift."""

    def __init__(self, tensors: Mapping[str, Tensor], name: str) -> None:
        self._gain = take(tensors, f"{name}.gain", DIMENSION)
        self._shift = take(tensors, f"{name}.shift", DIMENSION)

    def run(self, frames: Frames) -> Frames:
        """`frames` is used up."""
        frames -= (frames @ _MEAN)[:, None]
        scaled = _normalized(frames)
        scaled *= self._gain
        scaled += self._shift
        return scaled


class Linear:
    """A matrix and a bias behind a normalization, whose gain, shift and mean they take over.

    (h - mean(h)) / deviation(h) * gain + shift, times the matrix, is h / deviation(h) times
    another matrix: one with the gain in its rows and the mean of each column taken off.
    """

    def __init__(
        self, tensors: Mapping[str, Tensor], norm: str, matrix: Tensor, bias: Tensor
    ) -> None:
        gain = take(tensors, f"{norm}.gain", DIMENSION)
        shift = take(tensors, f"{norm}.shift", DIMENSION)
        self._bias = shift @ matrix + bias
        scaled = gain[:, None] * matrix
        self._matrix = np.ascontiguousarray(scaled - scaled.mean(axis=0))

    def run(self, frames: Frames) -> Frames:
        output: Frames = _normalized(frames) @ self._matrix
        output += self._bias
        return output


class FeedForward:
    """Half a feed-forward layer: out to HIDDEN and back."""

    def __init__(self, tensors: Mapping[str, Tensor], name: str) -> None:
        out = take(tensors, f"{name}.out.matrix", DIMENSION, HIDDEN)
        bias = take(tensors, f"{name}.out.bias", HIDDEN)
        self._out = Linear(tensors, f"{name}.norm", out, bias)
        self._back = 0.5 * take(tensors, f"{name}.back.matrix", HIDDEN, DIMENSION)
        self._bias = 0.5 * take(tensors, f"{name}.back.bias", DIMENSION)

    def run(self, frames: Frames) -> Frames:
        hidden = self._out.run(frames)
        output = _gated(hidden, hidden) @ self._back
        output += self._bias
        return output


class Attention:
    """Every frame looks at every other, by HEADS measures of likeness."""

    def __init__(self, tensors: Mapping[str, Tensor], name: str) -> None:
        matrix = take(tensors, f"{name}.inward.matrix", DIMENSION, 3 * DIMENSION).copy()
        bias = take(tensors, f"{name}.inward.bias", 3 * DIMENSION).copy()
        scale = (DIMENSION / HEADS) ** -0.5
        matrix[:, :DIMENSION] *= scale
        bias[:DIMENSION] *= scale
        self._inward = Linear(tensors, f"{name}.norm", matrix, bias)
        self._outward = take(tensors, f"{name}.outward.matrix", DIMENSION, DIMENSION)
        self._bias = take(tensors, f"{name}.outward.bias", DIMENSION)

    def run(self, frames: Frames, past: Past, settled: int) -> Frames:
        count, before = len(frames), past.keys.shape[1]
        parts = self._inward.run(frames).reshape(count, 3, HEADS, -1)
        queries, keys, values = np.ascontiguousarray(parts.transpose(1, 2, 0, 3))
        keys = np.concatenate([past.keys, keys], axis=1)
        values = np.concatenate([past.values, values], axis=1)
        kept = slice(max(before + settled - FARTHEST, 0), before + settled)
        past.keys, past.values = keys[:, kept], values[:, kept]
        seen = np.empty((count, DIMENSION), np.float32)
        # One head after another: their tables are the largest there are, and stay in the cache.
        for part, query, key, value in zip(
            np.hsplit(seen, HEADS), queries, keys, values, strict=True
        ):
            likeness = query @ key.T
            likeness -= likeness.max(axis=1, keepdims=True)
            np.exp(likeness, out=likeness)
            np.divide(likeness @ value, likeness.sum(axis=1, keepdims=True), out=part)
        output = seen @ self._outward
        output += self._bias
        return output


class Convolution:
    """A gate, and a filter of each dimension along time."""

    def __init__(self, tensors: Mapping[str, Tensor], name: str) -> None:
        inward = take(tensors, f"{name}.inward.matrix", DIMENSION, 2 * DIMENSION)
        bias = take(tensors, f"{name}.inward.bias", 2 * DIMENSION)
        self._inward = Linear(tensors, f"{name}.norm", inward, bias)
        self._filter = _banded(take(tensors, f"{name}.taps.matrix", DIMENSION, TAPS))
        self._filter_bias = take(tensors, f"{name}.taps.bias", DIMENSION)
        self._outward = take(tensors, f"{name}.outward.matrix", DIMENSION, DIMENSION)
        self._bias = take(tensors, f"{name}.outward.bias", DIMENSION)

    def run(self, frames: Frames, past: Past, settled: int) -> Frames:
        both = self._inward.run(frames)
        before = len(past.gated)
        gated = _gated(both[:, :DIMENSION], both[:, DIMENSION:])
        gated = np.concatenate([past.gated, gated])
        past.gated = gated[max(before + settled - TAPS // 2, 0) : before + settled]
        filtered = self._filtered(gated)[before:]
        output = _gated(filtered, filtered) @ self._outward
        output += self._bias
        return output

    def _filtered(self, frames: Frames) -> Frames:
        """31 taps along time, as products of _SPAN + 30 frames with a banded matrix."""
        count = len(frames)
        pieces = -(-count // _SPAN)
        around = np.zeros((DIMENSION, pieces * _SPAN + TAPS - 1), np.float32)
        around[:, TAPS // 2 : TAPS // 2 + count] = frames.T
        windows = np.lib.stride_tricks.sliding_window_view(around, _SPAN + TAPS - 1, axis=1)
        filtered = windows[:, ::_SPAN] @ self._filter
        output = filtered.reshape(DIMENSION, -1)[:, :count].T + self._filter_bias
        return output


_SPAN = 32
"""Frames that one product of the convolution makes."""


def _banded(taps: Tensor) -> Tensor:
    """Matrices [DIMENSION, _SPAN + TAPS - 1, _SPAN]; column j has the taps from row j on."""
    banded = np.zeros((len(taps), _SPAN + TAPS - 1, _SPAN), np.float32)
    for column in range(_SPAN):
        banded[:, column : column + TAPS, column] = taps
    return banded


def _normalized(frames: Frames) -> Frames:
    """Frames divided by their standard deviation; the mean stays."""
    mean = frames @ _MEAN
    variance = np.einsum("ij,ij->i", frames, frames) / DIMENSION - mean * mean
    scaled: Frames = frames / np.sqrt(np.maximum(variance, 0.0) + _EPSILON)[:, None]
    return scaled


def _gated(values: Frames, gates: Frames) -> Frames:
    """values / (1 + exp(-gates)); values by themselves are the sigmoid linear unit."""
    output = np.negative(gates)
    with np.errstate(over="ignore"):  # To infinity, which closes the gate as it should.
        np.exp(output, out=output)
    output += 1.0
    return np.divide(values, output, out=output)


def _gelu(values: Frames) -> Frames:
    """x times the normal distribution's integral up to x.

    The error function by formula 7.1.26 of Abramowitz and Stegun, off by 1.5e-7 at most.
    """
    size = np.abs(values) * np.float32(0.5**0.5)
    t = 1.0 / (1.0 + np.float32(0.3275911) * size)
    tail = np.polyval(_ERF, t) * t * np.exp(-size * size)
    output: Frames = 0.5 * values * np.where(values < 0, tail, 2.0 - tail)
    return output


_ERF = np.array([1.061405429, -1.453152027, 1.421413741, -0.284496736, 0.254829592], np.float32)


def load_network(path: str = "") -> Conformer:
    """The network of a weight file (from `find_weights`). Raises NotAvailable, HriError.

    The one that comes with `hri` is loaded once, for ears and lips alike.
    """
    file = find_weights(path)
    return _own_network() if file == FILE else Conformer(read_tensors(file))


@cache
def _own_network() -> Conformer:
    return Conformer(read_tensors(FILE))
