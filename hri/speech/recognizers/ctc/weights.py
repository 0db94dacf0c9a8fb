"""The trained weights: where the file is, that it is the right one, and its tensors.

The file is `asr_waveform.hama` of the package `hama`, whose own engine is never imported: its
network is small enough to be run by numpy.
"""

from __future__ import annotations

import hashlib
import importlib.util
import math
import os
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, NotAvailable
from hri.core.reading import read_bytes

VARIABLE = "HRI_CTC_WEIGHTS"
"""Environment variable that names a weight file elsewhere."""
PACKAGE = "hama==1.7.0"
"""Carries the file; the network changed between 1.6 and 1.7."""
SHA256 = "a9fcfe73e179ca48e399cd76a90a6b3e1887bf5037ecc52b778d13a149563328"
"""Of the file, as RECORD of that package's wheel has it."""
LARGEST = 64_000_000
"""Bytes; no weight file is larger."""

Tensor = NDArray[np.float32]

_MAGIC = b"HAMAPK\x01\x02"
_ALIGNMENT = 16
_TYPES: dict[int, np.dtype[Any]] = {
    0: np.dtype("<f4"),
    1: np.dtype("<f2"),
    2: np.dtype("<i8"),
    3: np.dtype("<i4"),
}
_DEEPEST = 8
_REMEDY = f"pip install --force-reinstall {PACKAGE}"


def find_weights(path: str = "") -> Path:
    """The weight file: as given, else of the environment, else of the installed package.

    Raises NotAvailable when it is not there, or when the package's file is another than the one
    this network was written for. A file that is named by hand may be a further trained one, so
    only its layout is checked, by `read_tensors` and the network.
    """
    chosen = path or os.environ.get(VARIABLE, "")
    if chosen:
        file = paths.expanded(chosen)
        if not file.is_file():
            raise NotAvailable(f"no weight file {file} - fix the path, or leave it out")
        return file
    # Looks the package up without running it.
    package = importlib.util.find_spec("hama")
    folders = list(package.submodule_search_locations or ()) if package else []
    if not folders:
        raise NotAvailable(f"the package hama is missing - pip install {PACKAGE}")
    file = Path(folders[0], "assets", "asr_waveform.hama")
    if _sha256(file) != SHA256:
        raise NotAvailable(f"{file}: not the file of {PACKAGE} - {_REMEDY}")
    return file


def _sha256(file: Path) -> str:
    try:
        with file.open("rb") as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()
    except OSError:
        return ""


def read_tensors(file: Path) -> Mapping[str, Tensor]:
    """All tensors of a weight file by name, as float32.

    The file: "HAMAPK", version 1, kind 2, u32 count; of each tensor u16 length of its name, name,
    u8 type (0 f32, 1 f16, 2 i64, 3 i32), u8 rank, u32 dimensions, u64 offset, u64 bytes; the data
    from the next multiple of 16 on. Everything is little endian.
    Raises NotAvailable when it cannot be read, or is not such a file.
    """
    try:
        raw = read_bytes(file, "weight file", LARGEST)
    except HriError as error:
        raise NotAvailable(f"{error}, or {_REMEDY}") from error
    try:
        return _tensors(raw)
    except (struct.error, ValueError, KeyError, UnicodeDecodeError) as error:
        raise NotAvailable(f"{file}: no weight file of this network - {_REMEDY}") from error


def _tensors(raw: bytes) -> dict[str, Tensor]:
    if not raw.startswith(_MAGIC):
        raise ValueError("another kind of file")
    (count,) = struct.unpack_from("<I", raw, len(_MAGIC))
    position = len(_MAGIC) + 4
    entries = []
    for _ in range(count):
        (length,) = struct.unpack_from("<H", raw, position)
        position += 2
        name = raw[position : position + length].decode()
        position += length
        kind, rank = struct.unpack_from("<BB", raw, position)
        if rank > _DEEPEST:
            raise ValueError("a tensor of too many dimensions")
        shape = struct.unpack_from(f"<{rank}I", raw, position + 2)
        offset, size = struct.unpack_from("<QQ", raw, position + 2 + 4 * rank)
        position += 18 + 4 * rank
        entries.append((name, _TYPES[kind], shape, offset, size))
    data = memoryview(raw)[-(-position // _ALIGNMENT) * _ALIGNMENT :]
    if sum(size for *_, size in entries) > len(data):
        raise ValueError("tensors that overlap")
    tensors = {}
    for name, kind_of, shape, offset, size in entries:
        if math.prod(shape) * kind_of.itemsize != size or offset + size > len(data):
            raise ValueError(f"{name} does not fit")
        flat = np.frombuffer(data[offset : offset + size], kind_of)
        tensors[name] = flat.reshape(shape).astype(np.float32)
        if not np.isfinite(tensors[name]).all():
            raise ValueError(f"{name} is not finite")
    return tensors


def take(tensors: Mapping[str, Tensor], name: str, *shape: int) -> Tensor:
    """A tensor that must be there in this shape. Raises HriError."""
    found = tensors.get(name)
    if found is None or found.shape != shape:
        what = "missing" if found is None else f"of shape {found.shape} instead of {shape}"
        raise HriError(f"the weight file is of another network: {name} is {what} - {_REMEDY}")
    return found
