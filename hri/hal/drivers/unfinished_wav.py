"""WAV files whose recorder was killed: the sound is there, its size was never written.

A recorder writes the header first, with sizes of 0 or of what there is by then, and corrects them
at the end.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from hri.core.native_path import native_path

RIFF_SIZE = 4
"""Place of the size of the file, which counts what comes after it."""
FIRST_CHUNK = 12
MOST_CHUNKS = 100
"""Chunks before the sound."""
LARGEST = 2**32 - 1
"""Bytes that a size can count."""


@contextmanager
def finished(path: Path) -> Iterator[tuple[str | BinaryIO, bool]]:
    """What a reader opens, and whether sizes were missing: the path, or the file with its sizes.

    Raises OSError when it cannot be read.
    """
    length = path.stat().st_size
    with path.open("rb") as file:
        sizes = _missing_sizes(file, length)
    if not sizes:
        with native_path(path) as name:
            yield name, False
        return
    patches = {place: struct.pack("<I", min(size, LARGEST)) for place, size in sizes.items()}
    with io.BufferedReader(_Patched(path, patches)) as whole:
        yield whole, True


def _missing_sizes(file: io.BufferedReader, length: int) -> dict[int, int]:
    """The sizes that the file should have, by their place; none when it has them."""
    riff, riff_size, form = struct.unpack("<4sI4s", file.read(FIRST_CHUNK).ljust(FIRST_CHUNK))
    if (riff, form) != (b"RIFF", b"WAVE"):
        return {}
    place = FIRST_CHUNK
    for _ in range(MOST_CHUNKS):
        name, size = _chunk(file, place)
        place += 8
        if name == b"data":
            break
        place += size + size % 2
    else:
        return {}
    there, end = length - place, RIFF_SIZE + 4 + riff_size
    missing = {}
    if end < place + min(size, there):
        missing[RIFF_SIZE] = length - RIFF_SIZE - 4
    is_whole = abs(length - end) <= 1  # what comes after the sound are other chunks
    if size < there and not is_whole and not _is_chunk(file, place + size, length):
        missing |= {RIFF_SIZE: length - RIFF_SIZE - 4, place - 4: there}
    return missing


def _chunk(file: io.BufferedReader, place: int) -> tuple[bytes, int]:
    """Name and size of the chunk there."""
    file.seek(place)
    name, size = struct.unpack("<4sI", file.read(8).ljust(8, b"\0"))
    return name, size


def _is_chunk(file: io.BufferedReader, place: int, length: int) -> bool:
    """Whether another chunk begins there, not more sound."""
    name, size = _chunk(file, place)
    return all(32 <= letter < 127 for letter in name) and place + 8 + size <= length


class _Patched(io.FileIO):
    """A file, some bytes of which read as others."""

    def __init__(self, path: Path, patches: Mapping[int, bytes]) -> None:
        super().__init__(path)
        self._patches = patches

    def readinto(self, buffer: bytearray | memoryview) -> int:  # type: ignore[override]
        start = self.tell()
        count = super().readinto(buffer) or 0
        for place, patch in self._patches.items():
            for index, byte in enumerate(patch, place - start):
                if 0 <= index < count:
                    buffer[index] = byte
        return count
