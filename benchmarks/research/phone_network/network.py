"""The network of `hri.speech.recognizers.ctc.conformer` in PyTorch, to learn; and its files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from hri.speech.recognizers.ctc.conformer import DIMENSION, HEADS, STRIDE, TAPS, block_count

Weights = Mapping[str, Tensor]
Stored = Mapping[str, NDArray[np.float32]]


def log_probabilities(weights: Weights, mel: Tensor) -> Tensor:
    """Of CLASSES, [batch, frames, classes], of log-mel frames [batch, 2 * frames + 1, 80]."""
    count = (mel.shape[1] - 1) // STRIDE
    taps = [mel[:, tap : tap + STRIDE * count : STRIDE] for tap in range(3)]
    frames = functional.gelu(_product(torch.cat(taps, dim=-1), weights, "stem"))
    for block in map(str, range(block_count(weights))):
        for name, layer in LAYERS.items():
            frames = frames + layer(frames, weights, f"{block}.{name}")
        frames = _normalized(frames, weights, f"{block}.norm")
    return _product(frames, weights, "head").float().log_softmax(dim=-1)


def _product(frames: Tensor, weights: Weights, name: str) -> Tensor:
    return functional.linear(frames, weights[f"{name}.matrix"].T, weights[f"{name}.bias"])


def _normalized(frames: Tensor, weights: Weights, name: str) -> Tensor:
    gain, shift = weights[f"{name}.gain"], weights[f"{name}.shift"]
    return functional.layer_norm(frames, (DIMENSION,), gain, shift)


def _feed_forward(frames: Tensor, weights: Weights, name: str) -> Tensor:
    inward = _normalized(frames, weights, f"{name}.norm")
    hidden = functional.silu(_product(inward, weights, f"{name}.out"))
    return 0.5 * _product(hidden, weights, f"{name}.back")


def _attention(frames: Tensor, weights: Weights, name: str) -> Tensor:
    inward = _product(_normalized(frames, weights, f"{name}.norm"), weights, f"{name}.inward")
    batch, count, _ = frames.shape
    parts = inward.reshape(batch, count, 3, HEADS, DIMENSION // HEADS).permute(2, 0, 3, 1, 4)
    seen = functional.scaled_dot_product_attention(*parts)
    seen = seen.transpose(1, 2).reshape(batch, count, DIMENSION)
    return _product(seen, weights, f"{name}.outward")


def _convolution(frames: Tensor, weights: Weights, name: str) -> Tensor:
    inward = _product(_normalized(frames, weights, f"{name}.norm"), weights, f"{name}.inward")
    gated = functional.glu(inward, dim=-1).transpose(1, 2)[:, :, None]
    # As a picture of one line: PyTorch is faster at those.
    filtered = functional.conv2d(
        gated,
        weights[f"{name}.taps.matrix"][:, None, None],
        weights[f"{name}.taps.bias"],
        padding=(0, TAPS // 2),
        groups=DIMENSION,
    )
    return _product(functional.silu(filtered[:, :, 0].transpose(1, 2)), weights, f"{name}.outward")


LAYERS = {
    "first": _feed_forward,
    "attention": _attention,
    "convolution": _convolution,
    "second": _feed_forward,
}


def read(file: Path) -> dict[str, NDArray[np.float32]]:
    """The tensors of a weight file."""
    with np.load(file) as stored:
        return {name: stored[name].astype(np.float32) for name in stored.files}


def write(tensors: Stored, file: Path) -> None:
    """As 16-bit floats, whole or not at all."""
    halves = {name: tensor.astype(np.float16) for name, tensor in tensors.items()}
    with file.with_suffix(".part").open("wb") as opened:
        np.savez_compressed(opened, **halves)
    file.with_suffix(".part").replace(file)
