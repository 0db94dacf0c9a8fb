"""A camera of this machine, read by a separate thread."""

from __future__ import annotations

import math
import os
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from hri.core.clock import Clock
from hri.core.errors import NotAvailable
from hri.core.latest import Latest
from hri.core.native_path import native_path
from hri.core.signals import Frame
from hri.hal.camera import FIELD_OF_VIEW, STALL, Camera
from hri.hal.picture import LARGEST_SIDE, as_picture

FIRST_PAUSE, LONGEST_PAUSE = 0.5, 30.0
"""Seconds between attempts to find a camera that went away; each is twice as long as the last."""
FAREWELL = 2.0
"""Seconds that closing waits for the thread; a camera that hangs is let go when it comes back."""
PATIENCE = 5.0
"""Seconds for the first picture, and for any later one; a camera that takes longer hangs."""
TRY_AGAIN = 0.05
"""Seconds between a reading that failed and the next one."""
TRIES_AT_FIRST, TRIES = 60, 6
"""Readings in a row that may fail before the first picture, and later; then it is opened again."""
MOST_GIVEN_UP = 4
"""Threads that may hang at once; while there are as many, none is added."""
REPLUG = "unplug it and plug it in again"


class Webcam(Camera):
    """The newest picture wins; a camera that is unplugged is looked for until it is back.

    One that hangs is given up, and opened again, after five seconds.
    """

    parameters = (
        *Camera.parameters, "device", "width", "height", "hres", "vres", "rate", "field_of_view",
    )  # fmt: skip
    is_hardware = True
    _given_up: tuple[_Filming, ...] = ()

    def _open(self) -> None:
        count = self.description.count
        self._wanted = (
            count("width", count("hres", 320, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
            count("height", count("vres", 240, 16, LARGEST_SIDE), 16, LARGEST_SIDE),
        )
        self._rate = self.description.number_within("rate", 30.0, 1.0, 240.0)
        self.field_of_view = self.description.number_within("field_of_view", *FIELD_OF_VIEW)
        self._given = SIZE_ONLY
        if self._hanging() >= MOST_GIVEN_UP:
            raise self.not_available("it hangs", REPLUG)
        self._filming = _Filming(self._find, self.manager.clock, self.id)
        is_decided = self._filming.is_decided.wait(PATIENCE)
        first = self._filming.latest.value
        if first is None:
            self._give_up()
            raise self._missing() if is_decided else self.not_available("it hangs", REPLUG)
        # A camera gives the nearest size it can, not the one it was asked for.
        self._take_size(first.image)

    @property
    def path(self) -> Path:
        """Where Linux has the camera; `device` is its number or this path."""
        device = self.description.text("device", "0")
        return Path(f"/dev/video{device}" if device.isdigit() else device)

    def _missing(self) -> NotAvailable:
        if self._filming.was_found or self._filming.fault:
            why = self._filming.fault or "it gives no picture"
            return self.not_available(why, f"see what else uses it, or {REPLUG}")
        if sys.platform != "linux" or not self.path.exists():
            return self.not_available(
                f"no camera {self.path}", "plug one in, or `hri doctor --choose`"
            )
        if not os.access(self.path, os.R_OK | os.W_OK):
            return NotAvailable(f"Failure opening {self.path} - check permissions")
        return NotAvailable(f"Failure opening {self.path} - see what else uses it, or replug it")

    def _read(self, now: float) -> Frame | None:
        if fault := self._filming.fault:
            self._filming.fault = ""
            self._tell(f"{fault} - it is opened again; if that goes on, {REPLUG}")
        if self._filming.waited(now) > PATIENCE and self._hanging() < MOST_GIVEN_UP:
            self._give_up()
            self._filming = _Filming(
                self._find, self.manager.clock, self.id, self._filming.sequence
            )
        frame = self._filming.latest.value
        if frame is None or frame.sequence == self._given:
            return None
        self._given = frame.sequence
        return frame

    def _why_silent(self, now: float) -> str:
        if self._hanging() or self._filming.waited(now) > STALL / 2:
            return f"no picture for {STALL:g} s: it hangs - {REPLUG}"
        return super()._why_silent(now)

    def _give_up(self) -> None:
        """Let the thread go; it releases the camera when that answers."""
        self._filming.ending.set()
        self._given_up += (self._filming,)

    def _hanging(self) -> int:
        """How many threads were given up and have not ended yet."""
        self._given_up = tuple(filming for filming in self._given_up if filming.is_alive())
        return len(self._given_up)

    def _find(self) -> cv2.VideoCapture | None:
        device = self.description.text("device", "0")
        # A camera that is missing is ours to tell of, in one line.
        cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
        if device.isdigit():
            capture = cv2.VideoCapture(int(device))
        else:
            with native_path(device) as name:
                capture = cv2.VideoCapture(name, cv2.CAP_V4L2)
        if not capture.isOpened():
            capture.release()
            return None
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, self._wanted[0])
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, self._wanted[1])
        capture.set(cv2.CAP_PROP_FPS, self._rate)
        capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        return capture

    def _close(self) -> None:
        self._give_up()
        self._filming.join(timeout=FAREWELL)


SIZE_ONLY = -1
"""Number of the first picture, which only shows the size."""


class _Filming(threading.Thread):
    """Opens a camera and keeps its newest picture, until `ending`; only this thread uses it.

    Whatever the camera does, the thread goes on: it opens it again.
    """

    def __init__(
        self, find: Callable[[], Any], clock: Clock, id: str, sequence: int = SIZE_ONLY
    ) -> None:
        """`sequence` is the number of the first picture."""
        super().__init__(name=f"webcam {id}", daemon=True)
        self.latest: Latest[Frame] = Latest()
        self.ending = threading.Event()
        self.is_decided = threading.Event()
        """Whether it is known that there is a picture, or that the first attempt gave none."""
        self.was_found = False
        """Whether the camera could be opened."""
        self.fault = ""
        """The last exception of the camera that nobody was told of."""
        self.sequence = sequence
        """Number of the next picture."""
        self._find, self._clock = find, clock
        self._asked = math.inf
        """Seconds, when the camera was asked for what it has not answered yet."""
        self.start()

    def waited(self, now: float) -> float:
        """Seconds for which the camera has not answered; negative when it is not asked."""
        return now - self._asked

    def run(self) -> None:
        pauses = waits()
        while not self.ending.is_set():
            before = self.sequence
            try:
                self._film()
            except Exception as error:  # of OpenCV, or no memory
                self.fault = " ".join(f"{type(error).__name__}: {error}".split())
            if self.sequence > before:
                pauses = waits()
            self.is_decided.set()
            self._pause(next(pauses))

    def _film(self) -> None:
        """Open the camera and read it until readings fail."""
        self._asked = self._clock.now()
        capture = self._find()
        if capture is None:
            return
        self.was_found = True
        try:
            tries = TRIES_AT_FIRST
            while tries and not self.ending.is_set():
                self._asked = self._clock.now()
                readable, picture = capture.read()
                if readable and picture is not None and self._keep(rgb(picture)):
                    tries = TRIES
                elif tries := tries - 1:
                    self._pause(TRY_AGAIN)
        finally:
            capture.release()

    def _keep(self, picture: Any) -> bool:
        """Whether it is taken; a bad one is for the camera to tell of, unless it is the first."""
        if not self.is_decided.is_set() and not _is_valid(picture):
            return False
        now = self._clock.now()
        self.latest.set(Frame(picture, now, self.sequence), now)
        self.sequence += 1
        self.is_decided.set()
        return True

    def _pause(self, seconds: float) -> None:
        self._asked = math.inf
        self.ending.wait(seconds)


def waits() -> Iterator[float]:
    """Seconds between one attempt and the next: longer and longer, up to half a minute."""
    pause = FIRST_PAUSE
    while True:
        yield pause
        pause = min(LONGEST_PAUSE, 2 * pause)


def rgb(picture: Any) -> Any:
    """What OpenCV gives, in the order of colors that all others expect; gray stays gray."""
    if not isinstance(picture, np.ndarray) or picture.ndim != 3 or picture.shape[2] not in (3, 4):
        return picture
    if picture.dtype == np.uint8 and picture.shape[2] == 3 and picture.size:
        return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)  # ten times as fast
    return picture[:, :, 2::-1]


def _is_valid(picture: Any) -> bool:
    try:
        return as_picture(picture).size > 0
    except ValueError:
        return False
