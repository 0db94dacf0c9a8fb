"""A camera of this machine, read by a separate thread."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from hri.core.errors import NotAvailable
from hri.core.latest import Latest
from hri.core.signals import Frame
from hri.hal.camera import FIELD_OF_VIEW, Camera
from hri.hal.picture import LARGEST_SIDE

FIRST_PAUSE, LONGEST_PAUSE = 0.5, 30.0
"""Seconds between attempts to find a camera that went away; each is twice as long as the last."""
FAREWELL = 2.0
"""Seconds that closing waits for the thread; a camera that hangs is let go when it comes back."""


class Webcam(Camera):
    """The newest picture wins; a camera that is unplugged is looked for until it is back."""

    parameters = (
        *Camera.parameters, "device", "width", "height", "hres", "vres", "rate", "field_of_view",
    )  # fmt: skip
    is_hardware = True

    def _open(self) -> None:
        count = self.description.count
        self._wanted = (
            count("width", count("hres", 320, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
            count("height", count("vres", 240, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
        )
        self._rate = self.description.number_within("rate", 30.0, 1.0, 240.0)
        self.field_of_view = self.description.number_within("field_of_view", *FIELD_OF_VIEW)
        capture = self._find()
        readable, picture = capture.read() if capture else (False, None)
        if not readable or picture is None:
            if capture:
                capture.release()
            raise self._missing()
        # A camera gives the nearest size it can, not the one it was asked for.
        self._take_size(picture)
        self._latest: Latest[Frame] = Latest()
        self._given = -1
        self._ending = threading.Event()
        self._thread = threading.Thread(
            target=self._film, args=(capture, self._ending), name="webcam", daemon=True
        )
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

    def _read(self, now: float) -> Frame | None:
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

    def _film(self, capture: Any, ending: threading.Event) -> None:
        """Keep the newest picture; the capture belongs to this thread alone, and ends with it."""
        sequence = 0
        pauses = waits()
        while not ending.is_set():
            readable, picture = capture.read() if capture else (False, None)
            if readable and picture is not None:
                now = self.manager.clock.now()
                self._latest.set(Frame(rgb(picture), now, sequence), now)
                sequence += 1
                pauses = waits()
                continue
            if capture:
                capture.release()
            ending.wait(next(pauses))
            capture = None if ending.is_set() else self._find()
        if capture:
            capture.release()

    def _close(self) -> None:
        self._ending.set()
        self._thread.join(timeout=FAREWELL)


def waits() -> Iterator[float]:
    """Seconds between one attempt and the next: longer and longer, up to half a minute."""
    pause = FIRST_PAUSE
    while True:
        yield pause
        pause = min(LONGEST_PAUSE, 2 * pause)


def rgb(picture: Any) -> Any:
    """What OpenCV gives, in the order of colors that all others expect; gray stays gray."""
    if picture.ndim == 3 and picture.shape[2] == 3:
        return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)
    return np.asarray(picture)
