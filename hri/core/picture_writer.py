"""A picture written as a file, JPEG or PNG."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.writing import write_bytes


def write_picture(
    path: str | Path, image: NDArray[np.uint8], quality: float = 0.8, mode: int | None = None
) -> None:
    """Write a picture as its suffix says: .jpg, .jpeg or .png.

    `quality` is 0 (small) to 1 (like the original) for a JPEG; a PNG is always exact. `mode` sets
    the permissions of the file, such as PRIVATE for a picture of people. Raises
    HriError when it cannot be written, ValueError for a quality out of range.
    """
    path = Path(path)
    if not 0 <= quality <= 1:
        raise ValueError(f"a quality of {quality:g} - write 0 to 1")
    suffix = path.suffix.lower()
    if suffix not in (".jpg", ".jpeg", ".png"):
        raise HriError(f'{path}: no pictures of the kind "{suffix}" - write .jpg or .png')
    settings = [] if suffix == ".png" else [cv2.IMWRITE_JPEG_QUALITY, round(100 * quality)]
    _, code = cv2.imencode(suffix, cv2.cvtColor(image, cv2.COLOR_RGB2BGR), settings)
    write_bytes(path, np.asarray(code).tobytes(), mode)
