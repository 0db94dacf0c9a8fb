"""The films of recordings: the picture at a time, as a JPEG.

No browser plays the films that OpenCV writes. To go on to the next picture takes a part of a
millisecond, to go anywhere else some ten: a film stays open, and knows where it is.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np

import hri.hal.drivers  # noqa: F401 - FFmpeg then writes nothing to the terminal
from hri.core.errors import HriError
from hri.core.recorded import FACE
from hri.core.signals import Image
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS
from hri.studio.recordings import LONGEST, opened, times_of

MOST_OPEN = 2
"""Films at once; the one that was looked at longest ago is closed."""
MOST_RATE = 1000.0
"""Pictures a second; a file that claims more is not believed."""
QUALITY = 85
"""Of pictures, as JPEG has it."""
AHEAD = 15
"""Pictures up to which going on is faster than going there."""
PATIENCE = 3000
"""Milliseconds that a file may take to open, or to give a picture."""
_OPTIONS = (
    *(cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, PATIENCE, cv2.CAP_PROP_READ_TIMEOUT_MSEC, PATIENCE),
    *(cv2.CAP_PROP_N_THREADS, 1),
)


class Film:
    """A film that is open. One thread at a time may use it."""

    def __init__(self, folder: Path) -> None:
        """Raises HriError for what is not a film."""
        self.path = folder / FACE
        self.start = times_of(folder).face
        """Seconds of the recording's clock."""
        with opened(folder, FACE) as file:
            self._mark = _mark(os.fstat(file.fileno()))
            is_film = file.read(8)[4:] == b"ftyp"
            # By its number, so that it is the file that was looked at, whatever lies there now.
            path = f"/proc/self/fd/{file.fileno()}" if is_film else ""
            try:
                self._capture = cv2.VideoCapture(path, cv2.CAP_FFMPEG, _OPTIONS)
            except cv2.error:
                raise self._damaged() from None
        width, height = self._number(cv2.CAP_PROP_FRAME_WIDTH), self._number(4)
        self.rate = self._number(cv2.CAP_PROP_FPS)
        """Pictures a second."""
        self.count = int(self._number(cv2.CAP_PROP_FRAME_COUNT))
        """Pictures that the file promises."""
        self._next = 0
        self._shown: tuple[int, bytes] = (-1, b"")
        is_possible = min(width, height) >= 1 and max(width, height) <= LARGEST_SIDE
        is_possible &= width * height <= MOST_PIXELS and 0 < self.rate <= MOST_RATE
        if not is_possible or self.count < 1 or self.length > LONGEST:
            self.close()
            raise self._damaged()

    def _number(self, which: int) -> float:
        return float(self._capture.get(which))

    @property
    def length(self) -> float:
        """Seconds."""
        return self.count / self.rate

    @property
    def has_changed(self) -> bool:
        """Whether the file is another one by now, or has grown."""
        with suppress(OSError):
            return _mark(self.path.lstat()) != self._mark
        return True

    def jpeg(self, time: float) -> bytes:
        """The picture that is shown at a time of the recording, or else the nearest.

        Raises HriError where the file is damaged.
        """
        # A time that was computed from a picture's number may come out a bit early.
        number = min(max(0, int((time - self.start) * self.rate + 0.01)), self.count - 1)
        if number != self._shown[0]:
            self._shown = (number, _coded(self._picture(number)))
        return self._shown[1]

    def _picture(self, number: int) -> Image:
        try:
            if not self._next <= number <= self._next + AHEAD:
                self._capture.set(cv2.CAP_PROP_POS_FRAMES, number)
                self._next = number
            while self._next < number and self._capture.grab():
                self._next += 1
            readable, picture = self._capture.read()
        except cv2.error:
            readable, picture = False, None
        self._next += 1
        if not readable or picture is None:
            self._next = self.count  # wherever it stands: it goes there the next time
            raise self._damaged()
        return np.asarray(picture, np.uint8)

    def _damaged(self) -> HriError:
        return HriError(f"{self.path}: no picture there that can be shown - the film is damaged")

    def close(self) -> None:
        self._capture.release()


def _mark(status: os.stat_result) -> tuple[int, int, int]:
    return status.st_ino, status.st_size, status.st_mtime_ns


def _coded(picture: Image) -> bytes:
    """An image in the order of OpenCV, as a JPEG."""
    return cv2.imencode(".jpg", picture, (cv2.IMWRITE_JPEG_QUALITY, QUALITY))[1].tobytes()


class Films:
    """The last films that someone looked at. One thread at a time may use them."""

    def __init__(self) -> None:
        self._films: OrderedDict[Path, Film] = OrderedDict()
        self._used: set[Path] = set()

    def film(self, folder: Path) -> Film:
        """The film of a recording, as it is now. Raises HriError."""
        self._used.add(folder)
        film = self._films.pop(folder, None)
        if film is not None and film.has_changed:
            film.close()
            film = None
        self._films[folder] = film = film or Film(folder)
        while len(self._films) > MOST_OPEN:
            self._films.popitem(last=False)[1].close()
        return film

    def close_unused(self) -> None:
        """Close those that were not looked at since the last call: the disk keeps a deleted film
        as long as it is open.
        """
        for folder in self._films.keys() - self._used:
            self._films.pop(folder).close()
        self._used.clear()
