"""Pictures as files: written as JPEG or PNG, and looked at before they are decoded."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.core.picture_writer import write_picture
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS

__all__ = ["Header", "count_scans", "picture_size", "read_header", "write_picture"]

FORMATS = ("JPEG", "PNG", "BMP", "WEBP", "GIF", "TIFF", "PPM")
"""What is taken for a picture; Pillow starts other programs for some of the rest."""
MOST_SCANS = 40
"""Of a JPEG: each goes over the whole picture, however few bytes it has. Usual are 1 to 12."""
_BLOCK = 1 << 20
_SCAN = b"\xff\xda"
"""Marker of a scan, which no compressed data contains (ITU-T T.81, table B.1)."""


@dataclass(frozen=True, slots=True)
class Header:
    """What a picture's first bytes say of it."""

    format: str
    mode: str
    """The kind of its pixels, as Pillow names it: "RGB"."""
    size: tuple[int, int]
    """Width and height."""


def read_header(source: Path | IO[bytes]) -> Header | None:
    """What the first bytes of a picture say; None when it is not a picture of FORMATS.

    One that is larger than Pillow dares to open is said to be one pixel larger than LARGEST_SIDE.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.simplefilter("error", PillowImage.DecompressionBombWarning)
            with PillowImage.open(source, formats=FORMATS) as picture:
                return Header(picture.format or "", picture.mode, picture.size)
    except (PillowImage.DecompressionBombWarning, PillowImage.DecompressionBombError):
        return Header("", "", (LARGEST_SIDE + 1, LARGEST_SIDE + 1))
    except Exception:  # of what Pillow raises for broken files there is no list
        return None


def count_scans(source: IO[bytes]) -> int:
    """How often a JPEG goes over its picture."""
    count, last = 0, b""
    while block := source.read(_BLOCK):
        count += (last + block).count(_SCAN)
        last = block[-1:]
    return count


def picture_size(path: Path) -> tuple[int, int] | None:
    """Width and height as the file's first bytes tell; None for an invalid picture.

    Raises HriError for one that claims to be larger than 8192 pixels a side, or than MOST_PIXELS
    (half of them with transparency, and for WebP), and for a JPEG of more than MOST_SCANS scans.
    """
    header = read_header(path)
    if header is None:
        return None
    width, height = header.size
    if max(width, height) > LARGEST_SIDE:
        raise HriError(f"{path}: this picture is too large - keep it below {LARGEST_SIDE} pixels")
    # The fourth channel, and the reader of WebP, take as much memory again.
    is_costly = header.format == "WEBP" or "A" in header.mode
    most = MOST_PIXELS // 2 if is_costly else MOST_PIXELS
    if width * height > most:
        what = f"{width} x {height} pixels are too many"
        raise HriError(f"{path}: {what} - keep it below {most:,}")
    if header.format == "JPEG":
        with path.open("rb") as file:
            if count_scans(file) > MOST_SCANS:
                what = f"this JPEG has more than {MOST_SCANS} scans"
                raise HriError(f"{path}: {what} - save it again, not progressive")
    return width, height
