"""A movie that can be watched whatever happens to the program that writes it.

OpenCV writes the table of contents of an MP4 when it ends, so a killed program leaves nothing. Here
the pictures are coded a second at a time, and each second is appended as a fragment that carries
its own table (ISO/IEC 14496-12, 8.8). At the end the file gets one table of contents and becomes an
ordinary MP4: what came before is then declared to be mere data, in one write.
"""

from __future__ import annotations

import struct
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np

from hri.core.growing_files import GrowingFile, log
from hri.core.native_path import native_path
from hri.core.signals import Image
from hri.core.writing import PRIVATE, NotWritten, delete_leftovers, name_beside
from hri.hal.drivers import mp4
from hri.hal.drivers.scaling import by_area
from hri.hal.picture import fitted

FRAGMENT_S = 1.0
"""Seconds of a fragment, which is what a killed program loses."""
_BEGINNING = mp4.file_type()


class GrowingMovie:
    """Appends pictures to an MP4 file (MPEG-4 part 2) with a constant rate."""

    def __init__(self, path: Path, size: tuple[int, int], rate: float) -> None:
        """`size` is width and height. Raises HriError for one that an MP4 cannot have, and when the
        file cannot be written.
        """
        mp4.check_size(path, *size)
        self._size, self._rate = size, rate
        self._file = GrowingFile(path)
        with suppress(NotWritten):
            delete_leftovers(path)  # of a program that was killed
        self._file.append(_BEGINNING + mp4.box("free", bytes(8)))
        self._scratch = name_beside(path, ".mp4")
        """Where OpenCV writes the pictures of the next fragment."""
        self._writer: cv2.VideoWriter | None = None
        self._pending = 0
        """Pictures of the next fragment."""
        self._contents = mp4.Contents()
        self._coding = b""

    def write(self, picture: Image) -> None:
        """Append an RGB picture; one of another size is fitted into it, with black bars."""
        if self._file.has_ended:
            return
        if self._writer is None:
            self._writer = self._begun()
        picture = fitted(picture, *self._size, by_area)
        self._writer.write(cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
        self._pending += 1
        # The very first picture is there at once.
        if not self._contents.counts or self._pending >= self._rate * FRAGMENT_S:
            self._flush()

    def _begun(self) -> cv2.VideoWriter:
        """What codes the next fragment; its scratch file is the owner's alone."""
        with suppress(OSError):  # OpenCV meets it again
            self._scratch.touch(PRIVATE)
        code = cv2.VideoWriter.fourcc(*"mp4v")
        with native_path(self._scratch) as name:
            return cv2.VideoWriter(name, code, self._rate, self._size)

    def close(self) -> None:
        """Make an ordinary MP4 of it; a second call does nothing.

        One without pictures shows a black one, since players refuse a film of none.
        """
        self._flush()
        if not self._contents.counts:
            self.write(np.zeros((self._size[1], self._size[0], 3), np.uint8))
        end = self._file.size
        if self._contents.counts and not self._file.has_ended:
            table = mp4.whole_table(self._size, self._rate, self._coding, self._contents)
            if self._append_box(table):
                data = struct.pack(">I4sQ", 1, b"mdat", end - len(_BEGINNING))
                self._file.patch(len(_BEGINNING), data)
        self._file.close()

    def _flush(self) -> None:
        """Append what OpenCV has coded as a fragment."""
        if self._writer is None:
            return
        self._writer.release()
        self._writer, self._pending = None, 0
        try:
            coded = mp4.Pictures.of_movie(self._scratch.read_bytes())
        except (OSError, ValueError):  # OpenCV does not say what went wrong
            log.error("%s ends here: no room for its pictures", self._file.path)
            self._file.close()
            return
        finally:
            with suppress(OSError):
                self._scratch.unlink(missing_ok=True)
        self._append(coded)

    def _append(self, coded: mp4.Pictures) -> None:
        contents = self._contents
        if not contents.counts:
            self._coding = coded.coding
            self._append_box(mp4.empty_table(self._size, self._rate, coded.coding))
        if self._append_box(mp4.fragment(len(contents.counts) + 1, len(contents.sizes), coded)):
            contents.add(self._file.size - len(coded.data), coded)

    def _append_box(self, box: bytes) -> bool:
        """Append a box, and what follows it; whether it is there.

        It counts as free space until it is there whole: players give up a file with half a table.
        """
        name = self._file.size + 4
        if not self._file.append(box[:4] + b"free" + box[8:]):
            return False
        self._file.patch(name, box[4:8])
        return True
