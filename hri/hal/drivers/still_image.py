"""A picture from a file, upright as its camera was held."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage, ImageOps

from hri.core.errors import HriError
from hri.core.reading import require_file
from hri.core.signals import Image
from hri.hal.drivers.image_size import picture_size

ORIENTATION = 0x0112
"""Tag of EXIF 2.3, section 4.6.4: how the stored picture is to be turned and mirrored."""
REMEDY = "name a JPEG or PNG"
STRIP = 256
"""Rows that are converted at once."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class StillImage:
    """A picture as it is to be looked at, and how it is stored."""

    image: Image
    """Uint8, [height, width, 3], RGB, upright."""
    alpha: NDArray[np.uint8] | None
    """How opaque it is, [height, width]; None without such a channel."""
    orientation: int
    """1 to 8, of EXIF."""
    stored_size: tuple[int, int]
    """Width and height in the file."""

    def stored(self, x: float, y: float) -> Point:
        """Where a point of the upright picture is in the stored one, pixels."""
        return _STORED[self.orientation](x, y, *self.stored_size)


_STORED: Mapping[int, Callable[[float, float, int, int], Point]] = {
    1: lambda x, y, width, height: (x, y),
    2: lambda x, y, width, height: (width - x, y),
    3: lambda x, y, width, height: (width - x, height - y),
    4: lambda x, y, width, height: (x, height - y),
    5: lambda x, y, width, height: (y, x),
    6: lambda x, y, width, height: (y, height - x),
    7: lambda x, y, width, height: (width - y, height - x),
    8: lambda x, y, width, height: (width - y, x),
}


def read_still(path: Path) -> StillImage:
    """Read a picture. Raises HriError when it cannot be read or is too large."""
    require_file(path, "picture")
    if picture_size(path) is None:
        raise HriError(f"{path}: not a readable picture - {REMEDY}")
    try:
        with PillowImage.open(path) as stored:
            size = stored.size
            orientation = stored.getexif().get(ORIENTATION, 1)
            ImageOps.exif_transpose(stored, in_place=True)
            image, alpha = _pixels(stored)
    except (OSError, ValueError, SyntaxError, EOFError) as error:  # Pillow raises all of these
        raise HriError(f"{path}: not a readable picture: {error} - {REMEDY}") from error
    return StillImage(image, alpha, orientation if orientation in _STORED else 1, size)


def _pixels(picture: PillowImage.Image) -> tuple[Image, NDArray[np.uint8] | None]:
    """The colors and the opacity, strip by strip: a large picture is in the memory only twice."""
    has_alpha = "A" in picture.getbands() or "transparency" in picture.info
    width, height = picture.size
    image = np.empty((height, width, 3), np.uint8)
    alpha = np.empty((height, width), np.uint8) if has_alpha else None
    for top in range(0, height, STRIP):
        strip = picture.crop((0, top, width, min(height, top + STRIP)))
        pixels = np.asarray(strip.convert("RGBA" if has_alpha else "RGB"), np.uint8)
        image[top : top + STRIP] = pixels[..., :3]
        if alpha is not None:
            alpha[top : top + STRIP] = pixels[..., 3]
    return image, alpha
