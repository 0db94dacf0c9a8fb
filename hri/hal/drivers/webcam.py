"""A camera of this machine, read by a thread of its own."""

from __future__ import annotations

import threading

import cv2
import numpy as np

from hri.core.latest import Latest
from hri.core.signals import Frame
from hri.hal.camera import Camera

REOPEN_AFTER = 2.0
"""Seconds between attempts to find a camera that went away."""


class Webcam(Camera):
    """The newest picture wins; a camera that is unplugged is looked for until it is back."""

    parameters = ("device", "width", "height", "rate")
    is_hardware = True

    def _open(self) -> None:
        self.width = int(self.description.number("width", 640))
        self.height = int(self.description.number("height", 480))
        self._capture = self._find()
        if self._capture is None:
            raise self.not_available(f"no camera {self.device}", "plug one in, or see `hri doctor`")
        self._latest: Latest[Frame] = Latest()
        self._given = -1
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="webcam", daemon=True)
        self._thread.start()

    @property
    def device(self) -> int:
        """Index of the camera."""
        return int(self.description.number("device", 0))

    def read(self, now: float) -> Frame | None:
        frame = self._latest.value
        if frame is None or frame.sequence == self._given:
            return None
        self._given = frame.sequence
        return frame

    def _find(self) -> cv2.VideoCapture | None:
        capture = cv2.VideoCapture(self.device)
        if not capture.isOpened():
            capture.release()
            return None
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, self.width)
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, self.height)
        capture.set(cv2.CAP_PROP_FPS, self.description.number("rate", 30))
        capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        return capture

    def _watch(self) -> None:
        sequence = 0
        while not self._ending.is_set():
            readable, picture = self._capture.read() if self._capture else (False, None)
            if not readable or picture is None:
                self._look_again()
                continue
            image = np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)
            now = self.manager.clock.now()
            self._latest.set(Frame(image, now, sequence), now)
            sequence += 1

    def _look_again(self) -> None:
        if self._capture:
            self._capture.release()
        self._capture = None
        self._ending.wait(REOPEN_AFTER)
        if not self._ending.is_set():
            self._capture = self._find()

    def _close(self) -> None:
        self._ending.set()
        self._thread.join(timeout=REOPEN_AFTER + 1)
        if self._capture:
            self._capture.release()
