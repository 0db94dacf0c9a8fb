"""Writes weight files, for tests of what reads them."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hri.speech.recognizers.ctc.weights import Tensor

HALF = 1


def write_weights(path: Path, tensors: Mapping[str, Tensor]) -> Path:
    """A file in the layout of the package, its tensors in half precision."""
    header, data = b"HAMAPK\x01\x02" + struct.pack("<I", len(tensors)), b""
    for name, tensor in tensors.items():
        packed = tensor.astype("<f2").tobytes()
        header += struct.pack("<H", len(name)) + name.encode()
        header += struct.pack(f"<BB{tensor.ndim}I", HALF, tensor.ndim, *tensor.shape)
        header += struct.pack("<QQ", len(data), len(packed))
        data += packed
    path.write_bytes(header + bytes(-len(header) % 16) + data)
    return path


def some_tensors() -> dict[str, Tensor]:
    return {
        "a": np.arange(6, dtype=np.float32).reshape(2, 3),
        "b.bias": np.full(4, 0.5, np.float32),
    }
