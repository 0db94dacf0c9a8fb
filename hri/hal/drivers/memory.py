"""Devices that live in memory, moved by code: camera, microphone, speaker, screen, joystick."""

from __future__ import annotations

import math
from collections import deque
from typing import TypeVar

import numpy as np

from hri.core.signals import Frame, Image, Samples
from hri.hal.camera import FIELD_OF_VIEW, Camera
from hri.hal.joystick import Joystick
from hri.hal.microphone import Microphone
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker

T = TypeVar("T")


class MemoryCamera(Camera):
    """Sees the pictures it was shown, each at its time; the newest that is due wins."""

    parameters = (*Camera.parameters, "field_of_view")

    def _open(self) -> None:
        self.field_of_view = self.description.number_within("field_of_view", *FIELD_OF_VIEW)
        self._frames: deque[Frame] = deque()
        self._count = 0

    def show(self, image: Image, time: float | None = None) -> None:
        """Put a picture before it, taken at a time of the clock; without one, now."""
        when = self.manager.clock.now() if time is None else time
        self._drop_late(self.manager.clock.now())
        self._frames.append(Frame(image, when, self._count))
        self._count += 1

    def _drop_late(self, now: float) -> None:
        """Forget what nobody read in time, so that it does not pile up."""
        while len(self._frames) > 1 and not self._frames[1].time > now:
            self._frames.popleft()

    def _read(self, now: float) -> Frame | None:
        self._drop_late(now)
        if not self._frames or self._frames[0].time > now:
            return None
        return self._frames.popleft()


class MemoryMicrophone(Microphone):
    """Hears the samples it was given, at the pace of the clock."""

    parameters = ("rate",)

    def _open(self) -> None:
        self.rate = self.description.count("rate", 16000, 1000, 400_000)
        self._sound = np.zeros(0, np.int16)
        self._start = self.manager.clock.now()
        self._given = 0

    def hear(self, samples: Samples) -> None:
        """Append a sound: it is heard after all that was given before, or from now on."""
        elapsed = round((self.manager.clock.now() - self._start) * self.rate)
        silence = np.zeros(max(0, elapsed - len(self._sound)), np.int16)
        self._sound = np.concatenate([self._sound, silence, samples])

    def read(self, now: float) -> Samples:
        until = max(self._given, round((now - self._start) * self.rate))
        heard = self._sound[self._given : until]
        missing = until - self._given - len(heard)
        self._given = until
        return np.concatenate([heard, np.zeros(missing, np.int16)])


class SilentSpeaker(Speaker):
    """Plays in real time without a sound."""

    def _open(self) -> None:
        self._begun: float | None = None
        self._duration = 0.0
        self._rate = 1

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self._begun, self._duration, self._rate = now, len(samples) / rate, rate

    def extend(self, samples: Samples, now: float) -> None:
        if self._begun is not None:
            self._begun = max(self._begun, now - self._duration)
            self._duration += len(samples) / self._rate

    def position(self, now: float) -> float | None:
        if self._begun is None or now - self._begun >= self._duration:
            return None
        return now - self._begun

    def stop(self, now: float) -> None:
        self._begun = None


class OffscreenScreen(Screen):
    """Keeps the last picture, `image`, shown to nobody."""

    parameters = ("width", "height")

    def _open(self) -> None:
        self._take_size()
        self.image: Image = np.zeros((self.height, self.width, 3), np.uint8)
        self.count = 0

    def show(self, image: Image, time: float) -> None:
        self.image = image
        self.count += 1


class MemoryJoystick(Joystick):
    """Held as code says; `axes` and `buttons` of the configuration tell how many it has."""

    parameters = ("axes", "buttons")

    def _open(self) -> None:
        self._axes = (0.0,) * self.description.count("axes", 2, 0, 32)
        self._buttons = (False,) * self.description.count("buttons", 4, 0, 64)
        self._fell_silent = math.inf

    def hold(self, axes: tuple[float, ...], buttons: tuple[bool, ...] = ()) -> None:
        """Move it and press; what is left out goes back to rest."""
        self._fell_silent = math.inf
        self._axes = _padded(axes, len(self._axes), 0.0)
        self._buttons = _padded(buttons, len(self._buttons), False)

    def fall_silent(self, now: float) -> None:
        """Go on reading as it is held, without a word from now on: a radio that lost its stick."""
        self._fell_silent = now

    def heard(self, now: float) -> float:
        return min(now, self._fell_silent)

    def axes(self, now: float) -> tuple[float, ...]:
        return self._axes

    def buttons(self, now: float) -> tuple[bool, ...]:
        return self._buttons


def _padded(values: tuple[T, ...], count: int, rest: T) -> tuple[T, ...]:
    return (*values, *[rest] * (count - len(values)))[:count]
