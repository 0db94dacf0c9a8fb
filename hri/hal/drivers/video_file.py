"""Video and image files as a camera and as a screen."""

from __future__ import annotations

import math
import queue
import threading
from contextlib import suppress
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.native_path import native_path
from hri.core.reading import opened, require_file
from hri.core.signals import Frame, Image
from hri.hal.camera import FIELD_OF_VIEW, Camera
from hri.hal.drivers.growing_movie import GrowingMovie
from hri.hal.drivers.image_size import read_header
from hri.hal.drivers.scaling import by_area
from hri.hal.drivers.still_image import read_still
from hri.hal.picture import LARGEST_SIDE, MOST_PIXELS, as_picture, fitted
from hri.hal.screen import Screen

WIDTH, HEIGHT = cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT

STILL_RATE = 10.0
"""Pictures a second that a single image is shown with."""
MOST_RATE = 1000.0
"""Pictures a second; a file that claims more is not believed."""
ASSUMED_RATE = 30.0
"""Of a file that does not say."""
SLACK = 1e-6
"""Seconds by which a picture may come early, for numbers that are not exact."""
MOST_AT_ONCE = 60
"""Pictures that are passed over in one go; a reader who was away for long catches up later."""
WHOLE = 0.95
"""Part of the pictures that a file promises; with fewer it was cut short."""
NEXT, MUCH = b"\xff\xd9\xff\xd8\xff", 20_000_000
"""Between two pictures of a film that is made of JPEGs alone, and bytes in which it must come."""
PACES = ("real", "fast")
"""How a file is shown: at its own pace, or each picture as soon as it is asked for."""


def check_video(path: Path) -> None:
    """Raises HriError unless the file is a video or an image that can be decoded."""
    if _still_of(path) is None:
        _opened(path).release()


def _still_of(path: Path) -> Image | None:
    """The picture in a file that is one; None for a film. Raises HriError."""
    require_file(path, "video or image")
    with opened(path, "video or image", None) as file:
        header = read_header(file)
        file.seek(0)
        has_more = header is not None and header.format == "JPEG" and NEXT in file.read(MUCH)
    if header is None:
        return None
    if header.is_animated or has_more:
        with suppress(HriError):  # of some animations FFmpeg knows the first picture at most
            _opened(path).release()
            return None
    return read_still(path).image


def _opened(path: Path) -> cv2.VideoCapture:
    """A film before its first picture, which is sure to be there. Raises HriError."""
    capture = _capture(path)
    width, height = (capture.get(way) for way in (WIDTH, HEIGHT))
    if width * height > MOST_PIXELS or max(width, height) > LARGEST_SIDE:
        capture.release()
        what = f"pictures of {width:.0f} x {height:.0f} pixels"
        raise HriError(f"{path}: {what} - keep them below {LARGEST_SIDE} pixels a side")
    readable, picture = capture.read()
    # Opened again, since not every kind of file can be wound back.
    capture.release()
    if not readable or picture is None or max(picture.shape[:2]) > LARGEST_SIDE:
        raise HriError(f"{path}: not a readable video or image - try an MP4, AVI, PNG or JPEG")
    del picture  # it may be large, and is decoded once more
    return _capture(path)


def _capture(path: Path) -> cv2.VideoCapture:
    # OpenCV's own readers of pictures decode them before they tell their size.
    with native_path(path) as name:
        return cv2.VideoCapture(name, cv2.CAP_FFMPEG)


def _single_of(path: Path) -> Image | None:
    """The picture of a film of only one, which need not say how many it has."""
    capture = _capture(path)
    _, picture = capture.read()
    has_more = capture.get(cv2.CAP_PROP_FRAME_COUNT) > 1 or capture.grab()
    capture.release()
    return None if has_more or picture is None else _in_rgb(picture)


def _in_rgb(picture: NDArray[Any]) -> Image:
    return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)


class _Timing:
    """When the pictures of a file were taken: as it says of each, or else at its rate."""

    def __init__(self, capture: cv2.VideoCapture) -> None:
        self._capture = capture
        rate = capture.get(cv2.CAP_PROP_FPS)
        self.step = 1 / rate if 0 < rate <= MOST_RATE else 1 / ASSUMED_RATE
        self._first = self._last = math.nan

    def time_of(self, sequence: int) -> float:
        """Seconds from the first picture to the one that was read just now."""
        told = self._capture.get(cv2.CAP_PROP_POS_MSEC) / 1000
        if sequence == 0:
            self._first, self._last = told, 0.0
            return 0.0
        time = told - self._first
        # Phones film at a variable rate, but not every format has times.
        if not self._last < time < self._last + 100 * self.step:
            time = self._last + self.step
        self._last = time
        return time


class VideoFileCamera(Camera):
    """Shows a file from the moment it is opened; an image stands still.

    `pace`: "real" shows each picture when it is due and passes over those that nobody read in
    time, "fast" gives the next one each time it is asked, for work on recordings. Pictures have
    the times that the file gives them. A file that breaks off in the middle ends there.
    """

    parameters = (*Camera.parameters, "file", "pace", "field_of_view")

    def _open(self) -> None:
        path = Path(self.description.text("file"))
        self.is_recording = self.description.choice("pace", "real", PACES) == "fast"
        self.field_of_view = self.description.number_within("field_of_view", *FIELD_OF_VIEW)
        self._start = self.manager.clock.now()
        self._number = -1
        self._due: float | None = None
        """Seconds from the start to the next picture; None at the end."""
        self._capture = cv2.VideoCapture()
        self._still = _still_of(path)
        if self._still is None:
            self._begin(path)
        if self._still is not None:
            self._take_size(self._still)

    def _begin(self, path: Path) -> None:
        """Open a film; one of a single picture is a still."""
        self._capture = _opened(path)
        self._still = _single_of(path)
        if self._still is not None:
            return
        width, height = int(self._capture.get(WIDTH)), int(self._capture.get(HEIGHT))
        self._take_size(np.empty((height, width), np.uint8))
        self._timing = _Timing(self._capture)
        self._grab()

    def _read(self, now: float) -> Frame | None:
        elapsed = now - self._start + SLACK
        if self._still is not None:
            return self._read_still(self._still, elapsed)
        for _ in range(MOST_AT_ONCE):
            if self._due is None or (self._due > elapsed and not self.is_recording):
                return None
            is_late = self._due + self._timing.step <= elapsed and not self.is_recording
            image = None if is_late else self._retrieve()
            time, number = self._start + self._due, self._number
            self._grab()
            if image is not None:
                return Frame(image, time, number)
        return None

    def _grab(self) -> None:
        """Go to the next picture; it is not converted before it is wanted."""
        if self._capture.grab():
            self._number += 1
            self._due = self._timing.time_of(self._number)
            return
        self._due = None
        promised = self._capture.get(cv2.CAP_PROP_FRAME_COUNT)
        if self._number + 1 < WHOLE * promised:
            seen = f"{self._number + 1} of {promised:.0f} pictures"
            self._tell(f"breaks off after {seen} - copy or record the file again")

    def _retrieve(self) -> Image | None:
        readable, picture = self._capture.retrieve()
        return _in_rgb(picture) if readable and picture is not None else None

    def _read_still(self, still: Image, elapsed: float) -> Frame | None:
        due = int(elapsed * STILL_RATE)
        if due <= self._number:
            return None
        self._number = due
        return Frame(still, self._start + due / STILL_RATE, due)

    @property
    def has_ended(self) -> bool:
        return self._due is None or self._still is not None

    def _close(self) -> None:
        self._capture.release()


class VideoFileScreen(Screen):
    """Writes pictures to an MP4 file with a constant rate.

    A picture that comes late is held for the missing ones, one that comes early replaces none.
    Encoding runs in a thread; when it falls far behind real time, pictures are dropped. The file
    can be watched at any time, up to a second ago, also when the program is killed.
    """

    parameters = ("file", "width", "height", "rate")

    def _open(self) -> None:
        self._take_size()
        self.rate = self.description.number_within("rate", 30.0, 1.0, 240.0)
        path = Path(self.description.text("file"))
        self._movie = GrowingMovie(path, (self.width, self.height), self.rate)
        self.origin = self.manager.clock.now()
        """Seconds of the clock at which the film begins; the first picture is held from here on."""
        self._count = 0
        self._pictures: queue.Queue[tuple[Image, int] | None] = queue.Queue(maxsize=60)
        self._thread = threading.Thread(target=self._encode, name="video encoder", daemon=True)
        self._thread.start()

    def show(self, image: Image, time: float) -> None:
        repeats = round((time - self.origin) * self.rate) + 1 - self._count
        if repeats < 1:
            return
        try:
            # On fake time the encoder is waited for: every picture counts.
            self._pictures.put((as_picture(image), repeats), block=self.manager.clock.is_fake)
            self._count += repeats
        except queue.Full:
            return

    def _encode(self) -> None:
        while (item := self._pictures.get()) is not None:
            image, repeats = item
            image = fitted(image, self.width, self.height, by_area)
            for _ in range(repeats):
                self._movie.write(image)

    def _close(self) -> None:
        self._pictures.put(None)
        self._thread.join()
        self._movie.close()
