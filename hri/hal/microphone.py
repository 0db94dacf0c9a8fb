"""The microphone interface, and the ears that share one: each hears everything, at its own rate."""

from __future__ import annotations

import threading
from abc import abstractmethod
from collections import deque
from typing import ClassVar

import numpy as np

from hri.core.signals import Samples
from hri.hal.resource import Description, Resource, Resources

LONGEST_BACKLOG = 10.0
"""Seconds of sound kept for an ear that does not read; older sound is dropped."""
_HANDING_OUT = threading.Lock()
"""Held while sound is handed out: ears may be read from several threads."""


class Microphone(Resource):
    """Mono sound at a fixed rate, for as many ears as listen."""

    rate: int = 16000
    """Samples a second."""
    is_recording: ClassVar[bool] = False
    """Whether it hears a recording, which someone chose for the robot to hear."""

    def __init__(self, description: Description, manager: Resources) -> None:
        super().__init__(description, manager)
        self._ears: list[Ear] = []

    @abstractmethod
    def read(self, now: float) -> Samples:
        """All samples since the last call, possibly none; never waits.

        What one caller takes no other gets: programs use `listen`.
        """

    def listen(self, rate: int | None = None) -> Ear:
        """An ear of your own, at the rate you want; close it when you have heard enough."""
        return Ear(self, self._ears, rate or self.rate)

    @property
    def has_ended(self) -> bool:
        """True when no further sound will come (a file is spent)."""
        return False


class Ear:
    """Hears from the moment it is made."""

    def __init__(self, microphone: Microphone, ears: list[Ear], rate: int) -> None:
        """`ears` are all that share the microphone; this one joins them."""
        self.microphone = microphone
        self.rate = rate
        self._ears = ears
        self._blocks: deque[Samples] = deque()
        self._waiting = 0
        self._resampler = None
        if rate != microphone.rate:
            from hri.hal.drivers.resampling import Resampler

            self._resampler = Resampler(microphone.rate, rate)
        with _HANDING_OUT:
            ears.append(self)

    def read(self, now: float) -> Samples:
        """All sound since the last call, possibly none; never waits."""
        with _HANDING_OUT:
            samples = self.microphone.read(now)
            for ear in self._ears:
                ear._take(samples)
            heard = np.concatenate([np.zeros(0, np.int16), *self._blocks])
            self._blocks.clear()
            self._waiting = 0
        return heard if self._resampler is None else self._resampler.convert(heard)

    @property
    def has_ended(self) -> bool:
        """True when no further sound will come."""
        return not self._waiting and self.microphone.has_ended

    def close(self) -> None:
        """Stop hearing; a second call does nothing."""
        with _HANDING_OUT:
            if self in self._ears:
                self._ears.remove(self)

    def _take(self, samples: Samples) -> None:
        self._blocks.append(samples)
        self._waiting += len(samples)
        while self._waiting > LONGEST_BACKLOG * self.microphone.rate and len(self._blocks) > 1:
            self._waiting -= len(self._blocks.popleft())
