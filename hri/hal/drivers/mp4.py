"""The boxes that an MP4 file is made of (ISO/IEC 14496-12)."""

from __future__ import annotations

from pathlib import Path


def is_whole(path: Path) -> bool:
    """Whether a file is made of whole boxes and has a table of contents, which is written last.

    Raises OSError when the file cannot be read.
    """
    size, place, names = path.stat().st_size, 0, set()
    with path.open("rb") as file:
        while place < size:
            file.seek(place)
            header = file.read(16)
            length = int.from_bytes(header[:4], "big")
            if length == 1:
                length = int.from_bytes(header[8:16], "big")
            if length < 8:
                return False
            names.add(header[4:8])
            place += length
    return place == size and b"moov" in names
