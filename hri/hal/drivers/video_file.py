"""Video and image files as a camera and as a screen."""

from __future__ import annotations

import queue
import threading
from pathlib import Path

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Frame, Image
from hri.hal.camera import Camera
from hri.hal.drivers.picture_file import LARGEST_SIDE, picture_size
from hri.hal.screen import Screen

STILL_RATE = 10.0
"""Pictures a second that a single image is shown with."""


def check_video(path: Path) -> None:
    """Raises HriError unless the file is a video or an image that can be decoded."""
    if not path.is_file():
        raise HriError(f"{path}: no such file - check the path")
    picture_size(path)  # raises before a giant is decoded
    capture = cv2.VideoCapture(str(path))
    try:
        readable, picture = capture.read()
        if not readable or picture is None or max(picture.shape[:2]) > LARGEST_SIDE:
            raise HriError(f"{path}: not a readable video or image - try an MP4, AVI, PNG or JPEG")
    finally:
        capture.release()


class VideoFileCamera(Camera):
    """Shows a file at its own pace, from the moment it is opened; an image stands still."""

    parameters = ("file",)

    def _open(self) -> None:
        path = Path(self.description.text("file"))
        check_video(path)
        self._capture = cv2.VideoCapture(str(path))
        self.width = int(self._capture.get(cv2.CAP_PROP_FRAME_WIDTH))
        self.height = int(self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT))
        self._is_still = self._capture.get(cv2.CAP_PROP_FRAME_COUNT) <= 1
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        self._rate = STILL_RATE if self._is_still or not 0 < rate <= 1000 else rate
        self._start = self.manager.clock.now()
        self._next = 0
        self._still: Image | None = None
        self._ended = False

    def read(self, now: float) -> Frame | None:
        due = int((now - self._start) * self._rate + 1e-6)
        if due < self._next or self._ended:
            return None
        image = self._read_still() if self._is_still else self._read_until(due)
        if image is None:
            self._ended = True
            return None
        self._next = due + 1
        return Frame(image, self._start + due / self._rate, due)

    def _read_until(self, due: int) -> Image | None:
        """Decode up to the picture that is due; those skipped are not converted."""
        for _ in range(due - self._next):
            if not self._capture.grab():
                return None
        return self._decode()

    def _read_still(self) -> Image | None:
        if self._still is None:
            self._still = self._decode()
        return self._still

    def _decode(self) -> Image | None:
        readable, picture = self._capture.read()
        if not readable or picture is None:
            return None
        return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)

    @property
    def has_ended(self) -> bool:
        return self._ended or self._is_still

    def _close(self) -> None:
        self._capture.release()


class VideoFileScreen(Screen):
    """Writes pictures to an MP4 file with a constant rate.

    A picture that comes late is held for the missing ones, one that comes early replaces none.
    Encoding runs in a thread; when it falls far behind real time, pictures are dropped.
    """

    parameters = ("file", "width", "height", "rate")

    def _open(self) -> None:
        self._take_size()
        self.rate = self.description.number_within("rate", 30.0, 1.0, 240.0)
        path = self.description.text("file")
        code = cv2.VideoWriter.fourcc(*"mp4v")
        self._writer = cv2.VideoWriter(path, code, self.rate, (self.width, self.height))
        if not self._writer.isOpened():
            raise HriError(f"{path}: cannot write this video - check the folder")
        # Sound and events begin now, too; the first picture is held from here on.
        self._start = self.manager.clock.now()
        self._count = 0
        self._pictures: queue.Queue[tuple[Image, int] | None] = queue.Queue(maxsize=60)
        self._thread = threading.Thread(target=self._encode, name="video encoder", daemon=True)
        self._thread.start()

    def show(self, image: Image, time: float) -> None:
        repeats = round((time - self._start) * self.rate) + 1 - self._count
        if repeats < 1:
            return
        try:
            # On fake time the encoder is waited for: every picture counts.
            self._pictures.put((image, repeats), block=self.manager.clock.is_fake)
            self._count += repeats
        except queue.Full:
            return

    def _encode(self) -> None:
        while (item := self._pictures.get()) is not None:
            image, repeats = item
            if image.shape[:2] != (self.height, self.width):
                size = (self.width, self.height)
                image = np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)
            picture = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
            for _ in range(repeats):
                self._writer.write(picture)

    def _close(self) -> None:
        self._pictures.put(None)
        self._thread.join()
        self._writer.release()
