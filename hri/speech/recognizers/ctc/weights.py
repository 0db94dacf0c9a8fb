"""The trained weights of the phone network: where their file is, and its tensors."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, NotAvailable
from hri.core.reading import opened
from hri.core.zip_archive import BROKEN, opened_archive, unpacked_size

FILE = Path(__file__).with_name("network.npz")
VARIABLE = "HRI_CTC_WEIGHTS"
"""Environment variable that names a weight file elsewhere."""
LARGEST = 64_000_000
"""Bytes of a weight file, and of all that is packed in it."""
LONGEST_DIRECTORY = 100_000
"""Bytes of the directory of its tensors."""

Tensor = NDArray[np.float32]


def find_weights(path: str = "") -> Path:
    """The weight file: as given, else of the environment, else the one that comes with `hri`.

    Raises NotAvailable when a file that is named is not there.
    """
    chosen = path or os.environ.get(VARIABLE, "")
    if not chosen:
        return FILE
    file = paths.expanded(chosen)
    if not file.is_file():
        raise NotAvailable(f"no weight file {file} - fix the path, or leave it out")
    return file


def read_tensors(file: Path) -> Mapping[str, Tensor]:
    """All tensors of a weight file by name; `benchmarks/research/phone_network` writes such files.

    Raises NotAvailable when it cannot be read, or is not such a file.
    """
    try:
        with opened(file, "weight file", LARGEST) as raw:
            with opened_archive(raw, LONGEST_DIRECTORY) as archive:
                if unpacked_size(archive) > LARGEST:
                    raise ValueError("it swells")
            raw.seek(0)
            with np.load(raw) as stored:
                tensors = {name: _tensor(stored[name]) for name in stored.files}
    except HriError as error:
        raise NotAvailable(str(error)) from error
    except (OSError, TypeError, AttributeError, MemoryError, *BROKEN) as error:
        raise NotAvailable(f"{file}: not a weight file of this network - reinstall hri") from error
    for name, tensor in tensors.items():
        if not np.isfinite(tensor).all():
            raise NotAvailable(f"{file}: {name} is not finite - reinstall hri")
    return tensors


def _tensor(stored: NDArray[Any]) -> Tensor:
    if stored.dtype.kind != "f":  # a byte would grow to four
        raise ValueError(f"a tensor of {stored.dtype}")
    return stored.astype(np.float32)


def take(tensors: Mapping[str, Tensor], name: str, *shape: int) -> Tensor:
    """A tensor that must be there in this shape. Raises HriError."""
    found = tensors.get(name)
    if found is None or found.shape != shape:
        what = "missing" if found is None else f"of shape {found.shape} instead of {shape}"
        raise HriError(f"the weight file is of another network: {name} is {what} - reinstall hri")
    return found
