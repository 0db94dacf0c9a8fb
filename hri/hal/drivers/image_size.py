"""Pictures as files: written as JPEG or PNG, and looked at before they are decoded."""

from __future__ import annotations

import warnings
from pathlib import Path

from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.core.picture_writer import write_picture
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS

__all__ = ["picture_size", "write_picture"]


def picture_size(path: Path) -> tuple[int, int] | None:
    """Width and height as the file's first bytes tell; None for an invalid picture.

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
