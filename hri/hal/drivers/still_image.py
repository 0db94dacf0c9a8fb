"""The reader of pictures of any kind: in colors, and upright as the camera was held.

docs/vision.md has a table of what becomes of each kind.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import IO, Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage, ImageCms, ImageOps

from hri.core import paths
from hri.core.errors import HriError
from hri.core.picture_writer import over_white
from hri.core.reading import opened
from hri.core.signals import Image
from hri.hal.drivers.image_size import FORMATS, Header, read_header, require_size
from hri.hal.drivers.other_pictures import AGAIN, DAMAGED, kind_of
from hri.hal.drivers.pixel_depth import STRIP, as_bytes, white_of
from hri.hal.drivers.silence import silenced_libraries

ORIENTATION = 0x0112
"""Tag of EXIF 2.3, section 4.6.4: how the stored picture is to be turned and mirrored."""
REMEDY = "name a JPEG or PNG"

Point = tuple[float, float]
Mask = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class StillImage:
    """A picture as it is to be looked at, and how it is stored."""

    image: Image
    """Uint8, [height, width, 3], RGB, upright; what is transparent lies over white."""
    alpha: Mask | None
    """How opaque it is, [height, width]; None without such a channel."""
    orientation: int
    """1 to 8, of EXIF."""

    @property
    def stored_size(self) -> tuple[int, int]:
        """Width and height in the file."""
        height, width = self.image.shape[:2]
        return (height, width) if self.orientation > 4 else (width, height)

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
_UPRIGHT: Mapping[int, Callable[[NDArray[Any]], NDArray[Any]]] = {
    1: lambda stored: stored,
    2: np.fliplr,
    3: lambda stored: np.rot90(stored, 2),
    4: np.flipud,
    5: lambda stored: stored.swapaxes(0, 1),
    6: lambda stored: np.rot90(stored, -1),
    7: lambda stored: np.rot90(stored, 2).swapaxes(0, 1),
    8: np.rot90,
}


def read_still(path: Path) -> StillImage:
    """Read a picture, of an animation the first.

    Raises HriError when it cannot be read to its end, or is too large.
    """
    if not paths.exists(path):
        raise HriError(f"{path}: no such file - check the path")
    with opened(path, "picture", None) as file:
        header = read_header(file)
        if header is None or header.is_preview:
            file.seek(0)
            raise HriError(f"{path}: {kind_of(file)}")
        require_size(path, file, header)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return (_of_opencv if header.is_deep_color else _of_pillow)(file, header)
        except Exception as error:  # of what Pillow raises for broken files there is no list
            why = f"{error} - {REMEDY}"
            if "truncated" in why.lower():
                why = f"{DAMAGED} - {AGAIN}"
            raise HriError(f"{path}: not a readable picture: {why}") from error


def _of_pillow(file: IO[bytes], header: Header) -> StillImage:
    with PillowImage.open(file, formats=FORMATS) as stored:
        orientation = stored.getexif().get(ORIENTATION, 1)
        ImageOps.exif_transpose(stored, in_place=True)  # a TIFF is upright when it is loaded
        pixels, alpha = _deep_gray(stored, header) if header.bits > 8 else _colors(stored)
    return _still(pixels, alpha, orientation)


def _still(pixels: NDArray[np.uint8], alpha: Mask | None, orientation: Any) -> StillImage:
    """A picture from upright pixels, [height, width, 3], and how opaque they are.

    `orientation` is whatever the file has there.
    """
    orientation = orientation if orientation in _STORED else 1
    seen = np.ascontiguousarray(pixels) if alpha is None else over_white(pixels, alpha)
    return StillImage(seen, alpha, orientation)


def _colors(picture: PillowImage.Image) -> tuple[NDArray[np.uint8], Mask | None]:
    """Pixels of 8 bits, strip by strip: a large picture is in the memory only twice."""
    has_alpha = picture.mode[-1] in "Aa" or "transparency" in picture.info
    mode = "RGBA" if has_alpha else "RGB"
    width, height = picture.size
    pixels = np.empty((height, width, len(mode)), np.uint8)
    for top in range(0, height, STRIP):
        strip = picture.crop((0, top, width, min(height, top + STRIP)))
        if strip.mode == "LAB":
            strip = ImageCms.applyTransform(strip, _from_lab()) or strip
        pixels[top : top + STRIP] = np.asarray(strip.convert(mode), np.uint8)
    if not has_alpha:
        return pixels, None
    return pixels[..., :3], np.ascontiguousarray(pixels[..., 3])


@cache
def _from_lab() -> ImageCms.ImageCmsTransform:
    """From CIE L*a*b* to sRGB."""
    lab, rgb = (ImageCms.createProfile(space) for space in ("LAB", "sRGB"))
    return ImageCms.buildTransform(lab, rgb, "LAB", "RGB")


def _deep_gray(picture: PillowImage.Image, header: Header) -> tuple[NDArray[np.uint8], Mask | None]:
    """Pixels from one channel of 16 or 32 bits."""
    samples = np.asarray(picture)
    if samples.dtype == np.int32 and header.bits == 32 and not header.is_signed:
        samples = samples.view(np.uint32)  # Pillow has integers with a sign alone
    alpha = None
    if isinstance(key := picture.info.get("transparency"), int):
        alpha = np.where(samples == key, 0, 255).astype(np.uint8)
    return np.dstack([_as_bytes(samples, header, header.white)] * 3), alpha


def _of_opencv(file: IO[bytes], header: Header) -> StillImage:
    """What Pillow would cut to 8 bits, or does not know."""
    data = np.frombuffer(file.read(), np.uint8)
    with silenced_libraries():
        samples = cv2.imdecode(data, cv2.IMREAD_UNCHANGED)
    del data
    if samples is None:
        raise ValueError("a rare kind, or damaged" if header.format == "TIFF" else "truncated")
    if 8 * samples.itemsize != header.bits:  # it changes what it cannot give
        raise ValueError(f"{header.channels} channels of {header.bits} bits are not known")
    orientation = header.orientation
    if header.format == "PNG":  # a TIFF is upright when it is decoded
        orientation = _orientation(file)
        samples = _UPRIGHT.get(orientation, _UPRIGHT[1])(samples)
    samples = samples.reshape(*samples.shape[:2], -1)
    pixels = _as_bytes(samples[..., :3], header)
    alpha = _as_bytes(samples[..., 3], header) if samples.shape[2] == 4 else None
    del samples  # it may be large
    pixels = np.repeat(pixels, 3, axis=2) if pixels.shape[2] == 1 else pixels[..., ::-1]
    return _still(pixels, alpha, orientation)


def _orientation(file: IO[bytes]) -> Any:
    with PillowImage.open(file, formats=FORMATS) as stored:
        return stored.getexif().get(ORIENTATION, 1)


def _as_bytes(
    samples: NDArray[Any], header: Header, white: float | None = None
) -> NDArray[np.uint8]:
    white = white or white_of(samples, header.bits - header.is_signed)
    return as_bytes(samples, white, header.is_negative)
