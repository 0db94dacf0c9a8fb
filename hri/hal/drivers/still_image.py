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
            orientation = stored.getexif().get(ORIENTATION, 1)
            upright = ImageOps.exif_transpose(stored)
            size = stored.size
            has_alpha = "A" in upright.getbands() or "transparency" in upright.info
            pixels = np.asarray(upright.convert("RGBA" if has_alpha else "RGB"), np.uint8)
    except (OSError, ValueError, SyntaxError, EOFError) as error:  # Pillow raises all of these
        raise HriError(f"{path}: not a readable picture: {error} - {REMEDY}") from error
    return StillImage(
        np.ascontiguousarray(pixels[..., :3]),
        np.ascontiguousarray(pixels[..., 3]) if has_alpha else None,
        orientation if orientation in _STORED else 1,
        size,
    )
