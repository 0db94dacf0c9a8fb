"""The boxes that an MP4 file is made of: ISO/IEC 14496-12, whose names stand here.

A box is its length (32 bits, or 1 and 64 bits behind the name), a name of four letters, and what it
holds, which may be boxes again.
"""

from __future__ import annotations

import struct
import sys
from array import array
from collections.abc import Iterator, MutableSequence, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from hri.core.errors import HriError

TICKS = 1000
"""Parts of a picture's time, of which times are whole numbers."""
UNITY = struct.pack(">9I", 0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x40000000)
"""The matrix that leaves a picture as it is."""
_KEY, _OTHER = 0x02000000, 0x01010000
"""Flags of a picture that stands alone, and of one that builds on those before."""


LEAST_SIDE, MOST_SIDE = 2, 8191
"""Pixels of a side of a picture that MPEG-4 part 2 can code (ISO/IEC 14496-2: 13 bits a side)."""


def check_size(path: Path, width: int, height: int) -> None:
    """Raises HriError for pictures of a size that the film `path` cannot have."""
    if not LEAST_SIDE <= min(width, height) <= max(width, height) <= MOST_SIDE:
        what = f"{path}: pictures of {width} x {height} pixels make no MP4"
        raise HriError(f"{what} - take sides of {LEAST_SIDE} to {MOST_SIDE} pixels")


def box(name: str, *parts: bytes) -> bytes:
    """A box of these parts."""
    content = b"".join(parts)
    return struct.pack(">I", 8 + len(content)) + name.encode() + content


def full_box(name: str, version: int, flags: int, *parts: bytes) -> bytes:
    """A box with a version and flags, as most tables are."""
    return box(name, struct.pack(">I", version << 24 | flags), *parts)


def boxes(data: bytes) -> Iterator[tuple[str, bytes]]:
    """Names and contents of the boxes in some bytes. Raises ValueError for what is cut short."""
    place = 0
    while place < len(data):
        length, name = struct.unpack_from(">I4s", data, place)
        begin = 8
        if length == 1:
            (length,), begin = struct.unpack_from(">Q", data, place + 8), 16
        if not begin <= length <= len(data) - place:
            raise ValueError("a box is cut short")
        yield name.decode("latin-1"), data[place + begin : place + length]
        place += length


def inner(data: bytes, *names: str) -> bytes:
    """The content of a box in boxes, the outermost name first. Raises ValueError without one."""
    for name in names:
        found = next((content for found, content in boxes(data) if found == name), None)
        if found is None:
            raise ValueError(f"no {name}")
        data = found
    return data


def _words(data: bytes, place: int, count: int) -> tuple[int, ...]:
    """Packs 32-bit numbers."""
    return struct.unpack_from(f">{count}I", data, place)


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


@dataclass(frozen=True, slots=True)
class Pictures:
    """Coded pictures that follow each other; the first stands alone."""

    coding: bytes
    """The description of how they are coded: the content of stsd."""
    sizes: tuple[int, ...]
    """Bytes of each picture."""
    keys: frozenset[int]
    """Numbers of those that stand alone, from 0."""
    data: bytes

    @classmethod
    def of_movie(cls, movie: bytes) -> Pictures:
        """Those of a movie without sound. Raises ValueError for another one, or half of one."""
        try:
            tables = dict(boxes(inner(movie, "moov", "trak", "mdia", "minf", "stbl")))
            same, count = struct.unpack_from(">II", tables["stsz"], 4)
            sizes = (same,) * count if same else _words(tables["stsz"], 12, count)
            keys = frozenset(range(count))
            if "stss" in tables:
                (number,) = _words(tables["stss"], 4, 1)
                keys = frozenset(key - 1 for key in _words(tables["stss"], 8, number))
            (begin,) = _words(tables["stco"], 8, 1)
        except (KeyError, struct.error) as error:
            raise ValueError(f"not a movie: {error}") from error
        data = movie[begin : begin + sum(sizes)]
        if not sizes or len(data) < sum(sizes):
            raise ValueError("pictures are missing")
        return cls(tables["stsd"], sizes, keys, data)


def file_type() -> bytes:
    """The box that an MP4 file begins with."""
    return box("ftyp", b"isom", struct.pack(">I", 512), b"isomiso2iso6mp41")


def empty_table(size: tuple[int, int], rate: float, coding: bytes) -> bytes:
    """The table of contents of a file whose pictures come in fragments."""
    empty = [full_box(name, 0, 0, bytes(4)) for name in ("stts", "stsc", "stco")]
    tables = [*empty, full_box("stsz", 0, 0, bytes(8))]
    extends = full_box("trex", 0, 0, struct.pack(">5I", 1, 1, TICKS, 0, _OTHER))
    return _table(size, rate, 0, coding, tables, box("mvex", extends))


def fragment(number: int, first: int, pictures: Pictures) -> bytes:
    """Some pictures with what is to be known of them; `number` counts from 1.

    `first` is how many pictures there were before.
    """

    def head(offset: int) -> bytes:
        each = b"".join(
            struct.pack(">II", size, _KEY if number in pictures.keys else _OTHER)
            for number, size in enumerate(pictures.sizes)
        )
        run = struct.pack(">II", len(pictures.sizes), offset)
        track = box(
            "traf",
            full_box("tfhd", 0, 0x20000, struct.pack(">I", 1)),
            full_box("tfdt", 1, 0, struct.pack(">Q", first * TICKS)),
            full_box("trun", 0, 0x601, run, each),
        )
        return box("moof", full_box("mfhd", 0, 0, struct.pack(">I", number)), track)

    return head(len(head(0)) + 8) + box("mdat", pictures.data)


@dataclass(slots=True)
class Contents:
    """Where all pictures of a file are; small, since a robot may film for days."""

    sizes: MutableSequence[int] = field(default_factory=lambda: array("I"))
    """Bytes of each picture."""
    keys: MutableSequence[int] = field(default_factory=lambda: array("I"))
    """Numbers of those that stand alone, from 1."""
    counts: MutableSequence[int] = field(default_factory=lambda: array("I"))
    """Pictures of each fragment."""
    places: MutableSequence[int] = field(default_factory=lambda: array("Q"))
    """Of the first byte of each fragment in the file."""

    def add(self, place: int, pictures: Pictures) -> None:
        """Take a fragment whose pictures begin at a place."""
        self.keys.extend(len(self.sizes) + key + 1 for key in sorted(pictures.keys))
        self.sizes.extend(pictures.sizes)
        self.counts.append(len(pictures.sizes))
        self.places.append(place)


def whole_table(size: tuple[int, int], rate: float, coding: bytes, contents: Contents) -> bytes:
    """The table of contents of a file that is complete."""
    runs, number = array("I"), 1
    for count, group in groupby(contents.counts):
        runs.extend((number, count, 1))
        number += len(list(group))
    sizes = contents.sizes
    tables = [
        numbers("stts", 1, array("I", [len(sizes), TICKS])),
        numbers("stss", len(contents.keys), contents.keys),
        numbers("stsc", len(runs) // 3, runs),
        full_box("stsz", 0, 0, struct.pack(">II", 0, len(sizes)), _in_file_order("I", sizes)),
        numbers("co64", len(contents.places), contents.places, "Q"),
    ]
    return _table(size, rate, len(sizes), coding, tables)


IN_THIS_FILE = box("dinf", full_box("dref", 0, 0, struct.pack(">I", 1), full_box("url ", 0, 1)))
"""Where the data of a track is."""


def numbers(name: str, count: int, values: Sequence[int], code: str = "I") -> bytes:
    """A table of entries, which are made of numbers: of 32 bits, or as an array's code says."""
    return full_box(name, 0, 0, struct.pack(">I", count), _in_file_order(code, values))


def _in_file_order(code: str, values: Sequence[int]) -> bytes:
    """Numbers, of the size that the code of an array means, with their highest byte first."""
    swapped = array(code, values)
    if sys.byteorder == "little":
        swapped.byteswap()
    return swapped.tobytes()


def _table(
    size: tuple[int, int],
    rate: float,
    count: int,
    coding: bytes,
    tables: Sequence[bytes],
    *rest: bytes,
) -> bytes:
    width, height = size
    scale, duration = round(rate * TICKS), count * TICKS
    times = struct.pack(">QQIQ", 0, 0, scale, duration)
    movie = full_box(
        "mvhd", 1, 0, times, struct.pack(">IHH8x", 0x10000, 0x100, 0), UNITY, bytes(24),
        struct.pack(">I", 2),
    )  # fmt: skip
    track = full_box(
        "tkhd", 1, 3, struct.pack(">QQIIQ16x", 0, 0, 1, 0, duration), UNITY,
        struct.pack(">II", width << 16, height << 16),
    )  # fmt: skip
    media = box(
        "mdia",
        full_box("mdhd", 1, 0, times, struct.pack(">HH", 0x55C4, 0)),
        full_box("hdlr", 0, 0, struct.pack(">I4s12x", 0, b"vide"), b"face\0"),
        box(
            "minf",
            full_box("vmhd", 0, 1, bytes(8)),
            IN_THIS_FILE,
            box("stbl", box("stsd", coding), *tables),
        ),
    )
    return box("moov", movie, box("trak", track, media), *rest)
