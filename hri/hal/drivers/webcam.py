"""A camera of this machine, read by a thread of its own."""

from __future__ import annotations

import os
import sys
import threading
from pathlib import Path

import cv2
import numpy as np

from hri.core.errors import NotAvailable
from hri.core.latest import Latest
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drivers.picture_file import LARGEST_SIDE

REOPEN_AFTER = 2.0
"""Seconds between attempts to find a camera that went away."""


class Webcam(Camera):
    """The newest picture wins; a camera that is unplugged is looked for until it is back."""

    parameters = ("device", "width", "height", "hres", "vres", "rate")
    is_hardware = True

    def _open(self) -> None:
        count = self.description.count
        self._wanted = (
            count("width", count("hres", 320, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
            count("height", count("vres", 240, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
        )
        self._rate = self.description.number_within("rate", 30.0, 1.0, 240.0)
        self._capture = self._find()
        readable, picture = self._capture.read() if self._capture else (False, None)
        if not readable or picture is None:
            if self._capture:
                self._capture.release()
            raise self._missing()
        # A camera gives the nearest size it can, not the one it was asked for.
        self.height, self.width = picture.shape[:2]
        self._latest: Latest[Frame] = Latest()
        self._given = -1
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="webcam", daemon=True)
        self._thread.start()

    @property
    def path(self) -> Path:
        """Where Linux has the camera; `device` is its number or this path."""
        device = self.description.text("device", "0")
        return Path(f"/dev/video{device}" if device.isdigit() else device)

    def _missing(self) -> NotAvailable:
        if sys.platform != "linux" or not self.path.exists():
            return self.not_available(
                f"no camera {self.path}", "plug one in, or `hri doctor --choose`"
            )
        if not os.access(self.path, os.R_OK | os.W_OK):
            return NotAvailable(f"Failure opening {self.path} - check permissions")
        return NotAvailable(f"Failure opening {self.path} - see what else uses it, or replug it")

    def read(self, now: float) -> Frame | None:
        frame = self._latest.value
        if frame is None or frame.sequence == self._given:
            return None
        self._given = frame.sequence
        return frame

    def _find(self) -> cv2.VideoCapture | None:
        device = self.description.text("device", "0")
        # A camera that is missing is ours to tell of, in one line.
        cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
        if device.isdigit():
            capture = cv2.VideoCapture(int(device))
        else:
            capture = cv2.VideoCapture(device, cv2.CAP_V4L2)
        if not capture.isOpened():
            capture.release()
            return None
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, self._wanted[0])
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, self._wanted[1])
        capture.set(cv2.CAP_PROP_FPS, self._rate)
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
