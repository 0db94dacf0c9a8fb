"""Pictures as files: written as JPEG or PNG, and looked at before they are decoded."""

from __future__ import annotations

import warnings
from pathlib import Path

import cv2
import numpy as np
from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.core.writing import write_bytes
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS


def write_picture(
    path: str | Path, image: Image, quality: float = 0.8, mode: int | None = None
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


def picture_size(path: Path) -> tuple[int, int] | None:
    """Width and height as the file's first bytes tell; None for what is no picture.

    Raises HriError for one that claims to be larger than 8192 pixels a side, or than MOST_PIXELS.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", PillowImage.DecompressionBombWarning)
            with PillowImage.open(path) as picture:
                size = picture.size
    except (PillowImage.DecompressionBombWarning, PillowImage.DecompressionBombError):
        size = (LARGEST_SIDE + 1, LARGEST_SIDE + 1)
    except (OSError, ValueError, SyntaxError):  # Pillow raises all of these for broken files
        return None
    if size[0] * size[1] > MOST_PIXELS and max(size) <= LARGEST_SIDE:
        what = f"{size[0]} x {size[1]} pixels are too many"
        raise HriError(f"{path}: {what} - keep it below {MOST_PIXELS:,}")
    if max(size) > LARGEST_SIDE:
        raise HriError(f"{path}: this picture is too large - keep it below {LARGEST_SIDE} pixels")
    return size
