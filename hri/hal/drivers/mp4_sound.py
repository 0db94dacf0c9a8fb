"""Adds sound to a film: PCM as a second track of an MP4 file that has pictures only.

The samples are "sowt" of the QuickTime File Format: 16 bits, the lowest byte first, as a WAV file
has them. Nothing that is in the file moves: the samples follow the pictures, and behind them the
table of contents is written again, with both tracks.
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.hal.drivers.mp4 import IN_THIS_FILE, UNITY, box, boxes, full_box, numbers

CHUNK = 1.0
"""Seconds of sound that the table of contents lists together: how finely a player can seek."""
MOST_BYTES = 2**32 - 16
"""Bytes of sound; more need a longer header."""
_BYTES = 2
"""Of a sample."""
_WHOLE, _TRACK = 0x100, 2
"""Full volume; the number of the track."""


def add_sound(path: Path, samples: Samples, rate: int) -> None:
    """Put sound, one channel at `rate` samples a second, into an MP4 file of one track.

    Raises HriError when it is not a whole file with pictures only, as OpenCV writes it, or for too
    much sound, OSError when it cannot be written.
    """
    if samples.size * _BYTES > MOST_BYTES or not 0 < rate < 2**16:
        raise HriError(f"{path}: {samples.size} samples at {rate} Hz - make the sound shorter")
    with path.open("r+b") as file:
        try:
            place, contents = _table_of(file)
            mvhd, trak, *rest = contents
            if (mvhd[0], trak[0]) != ("mvhd", "trak") or any(name == "trak" for name, _ in rest):
                raise ValueError("not one track")
            (scale, lasting) = struct.unpack_from(">II", mvhd[1], 12)
        except (ValueError, struct.error) as error:
            raise HriError(f"{path}: no film without sound: {error} - write it again") from error
        sound = round(samples.size * scale / rate)
        track = _track(place + 8, samples.size, rate, sound)
        header = bytearray(mvhd[1])
        struct.pack_into(">I", header, 16, max(lasting, sound))
        struct.pack_into(">I", header, len(header) - 4, _TRACK + 1)
        others = [box(name, content) for name, content in rest]
        file.seek(place)
        file.write(box("mdat", np.ascontiguousarray(samples, "<i2").tobytes()))
        file.write(box("moov", box("mvhd", bytes(header)), box("trak", trak[1]), track, *others))


def _table_of(file: BinaryIO) -> tuple[int, list[tuple[str, bytes]]]:
    """Where the table of contents begins, and the boxes in it.

    Raises ValueError when there is none, or something follows it.
    """
    place = 0
    while header := file.read(16):
        length, name = struct.unpack_from(">I4s", header)
        if name == b"moov":
            content = header[8:] + file.read()
            if len(content) != length - 8:
                raise ValueError("something follows its table of contents")
            return place, list(boxes(content))
        if length == 1:
            (length,) = struct.unpack_from(">Q", header, 8)
        place += max(length, 8)
        file.seek(place)
    raise ValueError("no table of contents")


def _track(place: int, count: int, rate: int, lasting: int) -> bytes:
    """A track of samples that begin at a place in the file, `lasting` in the units of the film."""
    chunk = round(CHUNK * rate)
    whole, rest = divmod(count, chunk)
    runs = [(1, chunk, 1)] * (whole > 0) + [(whole + 1, rest, 1)] * (rest > 0)
    places = [place + number * chunk * _BYTES for number in range(whole + (rest > 0))]
    head = struct.pack(">5I8x4H", 0, 0, _TRACK, 0, lasting, 0, 0, _WHOLE, 0)
    coding = struct.pack(">6xHHHIHHHHI", 1, 0, 0, 0, 1, 8 * _BYTES, 0, 0, rate << 16)
    tables = box(
        "stbl",
        full_box("stsd", 0, 0, struct.pack(">I", 1), box("sowt", coding)),
        numbers("stts", 1, (count, 1)),
        numbers("stsc", len(runs), [number for run in runs for number in run]),
        full_box("stsz", 0, 0, struct.pack(">II", _BYTES, count)),
        numbers("co64", len(places), places, "Q"),
    )
    return box(
        "trak",
        full_box("tkhd", 0, 3, head, UNITY, bytes(8)),
        box(
            "mdia",
            full_box("mdhd", 0, 0, struct.pack(">4IHH", 0, 0, rate, count, 0x55C4, 0)),
            full_box("hdlr", 0, 0, struct.pack(">I4s12x", 0, b"soun"), b"voice\0"),
            box("minf", full_box("smhd", 0, 0, bytes(4)), IN_THIS_FILE, tables),
        ),
    )
