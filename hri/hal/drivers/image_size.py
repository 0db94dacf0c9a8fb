"""Pictures as files: written as JPEG or PNG, and looked at before they are decoded."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from PIL import Image as PillowImage, ImageFile, TiffImagePlugin

from hri.core.errors import HriError
from hri.core.picture_writer import write_picture
from hri.core.reading import opened
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS

__all__ = ["Header", "count_scans", "picture_size", "read_header", "require_size", "write_picture"]

FORMATS = ("JPEG", "PNG", "BMP", "WEBP", "GIF", "TIFF", "PPM", "AVIF")
"""What is taken for a picture; Pillow starts other programs for some of the rest."""
ANIMATED = ("GIF", "WEBP", "PNG", "AVIF")
"""Formats in which several pictures are a film, not pages or views."""
LARGEST_FILE = 140_000_000
"""Bytes; the largest picture that is taken has fewer, however it is packed."""
MOST_SCANS = 40
"""Of a JPEG: each goes over the whole picture, however few bytes it has. Usual are 1 to 12."""
_BLOCK = 1 << 20
_SCAN = b"\xff\xda"
"""Marker of a scan, which no compressed data contains (ITU-T T.81, table B.1)."""
_MARKS_OF_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_KIND_OF_FILE, _WIDTH, _HEIGHT, _BITS, _PHOTOMETRIC = 254, 256, 257, 258, 262
_ORIENTATION, _CHANNELS, _NUMBERS = 274, 277, 339
"""Tags of TIFF 6.0, sections 8 and 19."""
_SIGNED = 2
_GRAY_OR_RGB = (0, 1, 2)
"""Photometric interpretations that are the colors themselves; 0 is white in the first."""


@dataclass(frozen=True, slots=True)
class Header:
    """What a picture's first bytes say of it."""

    format: str
    mode: str
    """The kind of its pixels, as Pillow names it: "RGB"; "" when Pillow does not know it."""
    size: tuple[int, int]
    """Width and height."""
    channels: int = 3
    bits: int = 8
    """Of a sample."""
    white: int | None = None
    """The sample that is white, where a gray file of more than 8 bits declares it."""
    is_signed: bool = False
    is_negative: bool = False
    """Whether 0 is white, in a file of more than 8 bits."""
    orientation: int = 1
    """Of a TIFF, as EXIF has it."""
    is_animated: bool = False
    is_preview: bool = False
    """Whether it is a small version of another picture, as in the raw files of cameras."""

    @property
    def is_deep_color(self) -> bool:
        """Whether it has more in it than Pillow keeps: 8 bits of each color."""
        return self.mode == "" or (self.bits > 8 and self.channels > 1)

    @property
    def cost(self) -> int:
        """How often it is in the memory, compared with a picture of three bytes a pixel."""
        if self.bits > 8:
            return math.ceil(max(1.5, self.channels) * self.bits / 24)
        # The fourth channel, and the readers of WebP and AVIF, take as much memory again.
        return 2 if self.format in ("WEBP", "AVIF") or "A" in self.mode else 1


def read_header(source: IO[bytes]) -> Header | None:
    """What the first bytes of a picture say; None when it is not a picture of FORMATS.

    One that is larger than Pillow dares to open is said to be one pixel larger than LARGEST_SIDE.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", PillowImage.DecompressionBombWarning)
        try:
            with PillowImage.open(source, formats=FORMATS) as picture:
                return _header(picture)
        except (PillowImage.DecompressionBombWarning, PillowImage.DecompressionBombError):
            return Header("", "", (LARGEST_SIDE + 1, LARGEST_SIDE + 1))
        except Exception:  # of what Pillow raises for broken files there is no list
            return _header_of_tiff(source)


def _header(picture: ImageFile.ImageFile) -> Header:
    if isinstance(picture, TiffImagePlugin.TiffImageFile):
        return _of_tags(picture.tag_v2, picture.mode, picture.size)
    first = picture.tile[0].args if picture.tile else ""
    mode, size = picture.mode, picture.size
    is_animated = picture.format in ANIMATED and getattr(picture, "is_animated", False)
    channels = len(picture.getbands())
    if picture.format == "PPM" and isinstance(first, tuple) and mode in ("RGB", "I"):
        # Pillow stretches the samples of a file whose white is another than the largest.
        is_full = first[-1] == 65535
        is_binary = picture.tile[0].codec_name != "ppm_plain"  # OpenCV misreads large numbers
        bits = 16 if mode == "I" or (is_full and is_binary) else 8
        return Header("PPM", mode, size, channels, bits, None if is_full else 65535)
    bits = 32 if mode == "F" else 16 if ";16" in str(first) or mode.startswith("I;16") else 8
    return Header(picture.format or "", mode, size, channels, bits, is_animated=is_animated)


def _header_of_tiff(source: IO[bytes]) -> Header | None:
    """That of a TIFF that only OpenCV reads: colors of 32 bits, numbers of 64."""
    try:
        source.seek(0)
        beginning = source.read(8)
        if not beginning.startswith(_MARKS_OF_TIFF):
            return None
        if beginning[2] == 43 or beginning[3] == 43:
            beginning += source.read(8)
        tags = TiffImagePlugin.ImageFileDirectory_v2(beginning)
        source.seek(tags.next)
        tags.load(source)
        header = _of_tags(tags, "", (int(tags[_WIDTH]), int(tags[_HEIGHT])))
        is_usual = tags.get(_PHOTOMETRIC) in _GRAY_OR_RGB and header.bits > 8
        return header if is_usual and min(header.size) > 0 else None
    except Exception:  # nor of these
        return None


def _of_tags(tags: Any, mode: str, size: tuple[int, int]) -> Header:
    bits, kind = (tags.get(tag, (1,))[0] for tag in (_BITS, _NUMBERS))
    return Header(
        "TIFF",
        mode,
        size,
        channels=int(tags.get(_CHANNELS, 1)),
        bits=16 if 8 < bits < 16 else bits,
        white=2**bits - 1 if 8 < bits < 16 else None,
        is_signed=kind == _SIGNED,
        is_negative=bits > 8 and tags.get(_PHOTOMETRIC) == 0,
        orientation=tags.get(_ORIENTATION, 1),
        is_preview=bool(tags.get(_KIND_OF_FILE, 0) & 1),
    )


def count_scans(source: IO[bytes]) -> int:
    """How often a JPEG goes over its picture."""
    count, last = 0, b""
    while block := source.read(_BLOCK):
        count += (last + block).count(_SCAN)
        last = block[-1:]
    return count


def picture_size(path: Path) -> tuple[int, int] | None:
    """Width and height as the file's first bytes tell; None for an invalid picture.

    Raises HriError for what `require_size` refuses.
    """
    with opened(path, "picture", None) as file:
        header = read_header(file)
        if header is None:
            return None
        require_size(path, file, header)
        return header.size


def require_size(path: Path, file: IO[bytes], header: Header) -> None:
    """Raise HriError for a picture that would take too much memory, or time.

    That is one that claims to be larger than 8192 pixels a side, or than MOST_PIXELS divided by
    its cost, a file of more than LARGEST_FILE bytes, and a JPEG of more than MOST_SCANS scans.
    """
    width, height = header.size
    if max(width, height) > LARGEST_SIDE:
        raise HriError(f"{path}: this picture is too large - keep it below {LARGEST_SIDE} pixels")
    most = MOST_PIXELS // header.cost
    if width * height > most:
        what = f"{width} x {height} pixels are too many"
        raise HriError(f"{path}: {what} - keep it below {most:,}")
    if file.seek(0, 2) > LARGEST_FILE:
        raise HriError(f"{path}: this picture is too large - keep it below {LARGEST_FILE} bytes")
    file.seek(0)
    if header.format in ("JPEG", "MPO") and count_scans(file) > MOST_SCANS:
        what = f"this JPEG has more than {MOST_SCANS} scans"
        raise HriError(f"{path}: {what} - save it again, not progressive")
    file.seek(0)
