"""A picture written as a file: JPEG, PNG or WebP."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.writing import write_bytes

STRIP = 256
"""Rows that are worked on at once, so that a large picture is not in the memory again."""
KINDS = (".jpg", ".jpeg", ".png", ".webp")
"""Suffixes of pictures that can be written."""
EXACT = {".png": [], ".webp": [cv2.IMWRITE_WEBP_QUALITY, 101]}
"""Settings of the kinds that lose nothing, and keep opacity; WebP does so above 100."""
_ORDERS = {1: [0], 3: [2, 1, 0], 4: [2, 1, 0, 3]}
"""Of channels, as OpenCV has them, by their number."""


def over_white(colors: NDArray[np.uint8], alpha: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Colors, [height, width, 3], as they are seen over white: a transparent one is not."""
    seen = np.empty(colors.shape, np.uint8)
    for top in range(0, len(colors), STRIP):
        rows = slice(top, top + STRIP)
        opaque = alpha[rows, :, None].astype(np.uint16)
        seen[rows] = (colors[rows] * opaque + 255 * (255 - opaque) + 127) // 255
    return seen


def write_picture(
    path: str | Path, image: NDArray[np.uint8], quality: float = 0.8, mode: int | None = None
) -> None:
    """Write a picture as its suffix says: .jpg, .jpeg, .png or .webp.

    `image` is gray, [height, width], RGB, or RGBA, which a JPEG has over white. `quality` is 0
    (small) to 1 (like the original) for a JPEG; PNG and WebP are always exact. `mode` sets the
    permissions of the file, such as PRIVATE for a picture of people. Raises HriError when it cannot
    be written, ValueError for a quality out of range.
    """
    path = Path(path)
    if not 0 <= quality <= 1:
        raise ValueError(f"a quality of {quality:g} - write 0 to 1")
    suffix = path.suffix.lower()
    if suffix not in KINDS:
        raise HriError(f'{path}: no pictures of the kind "{suffix}" - write .jpg, .png or .webp')
    settings = EXACT.get(suffix, [cv2.IMWRITE_JPEG_QUALITY, round(100 * quality)])
    if image.ndim == 3 and image.shape[2] == 4 and suffix not in EXACT:
        image = over_white(image[..., :3], image[..., 3])
    order = image if image.ndim == 2 else image[..., _ORDERS[image.shape[2]]]
    _, code = cv2.imencode(suffix, np.ascontiguousarray(order), settings)
    write_bytes(path, np.asarray(code).tobytes(), mode)
