"""A camera with faults that a test chooses."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hri.core.clock import FakeClock
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Frame, Image
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

Spoil = Callable[[Frame], Frame | None]
"""What becomes of a frame; None when it does not come."""


def _resized(width: int, height: int) -> Spoil:
    def spoil(frame: Frame) -> Frame:
        rows = np.arange(height) * frame.height // height
        columns = np.arange(width) * frame.width // width
        return replace(frame, image=frame.image[rows][:, columns])

    return spoil


def _made(change: Callable[[Image], object]) -> Spoil:
    return lambda frame: replace(frame, image=change(frame.image))  # type: ignore[arg-type]


FAULTS: dict[str, Spoil] = {
    "stall": lambda frame: None,
    "drop": lambda frame: None if frame.sequence % 2 else frame,
    "jump": lambda frame: replace(frame, time=frame.time + 100.0),
    "return": lambda frame: replace(frame, time=frame.time - 100.0),
    "timeless": lambda frame: replace(frame, time=math.nan),
    "resize": _resized(200, 120),
    "pixel": _resized(1, 1),
    "8k": _made(lambda image: np.full((4320, 7680, 3), image[0, 0], np.uint8)),
    "too large": _resized(8200, 8),
    "gray": _made(lambda image: image[:, :, 1]),
    "16 bit": _made(lambda image: image.astype(np.uint16) * 256),
    "float": _made(lambda image: image / 255),
    "empty": _made(lambda image: image[:0]),
    "nothing": _made(lambda image: None),
}
"""By name: what a camera does that stalls, loses every second picture, jumps ahead or back in
time or has lost it, changes its size, or gives pictures of a kind that few expect."""


@dataclass(frozen=True, slots=True)
class Fault:
    """A kind of FAULTS, and from when until when, in seconds. Raises HriError for another kind."""

    kind: str
    start: float = 0.0
    end: float = math.inf

    def __post_init__(self) -> None:
        if self.kind not in FAULTS:
            raise HriError(f'no fault "{self.kind}" - {did_you_mean(self.kind, FAULTS)}')


class FaultyCamera(Camera):
    """Draws a picture whenever one is due, and spoils those of the times of its faults."""

    def __init__(
        self,
        draw: Callable[[float], Image],
        faults: Sequence[Fault] = (),
        manager: ResourceManager | None = None,
        rate: float = 30.0,
        id: str = "camera",
    ) -> None:
        """`draw(seconds)` gives the picture of a time; for `ResourceManager.substitute`."""
        manager = manager or ResourceManager((), FakeClock())
        super().__init__(Description(id, "Test.FaultyCamera"), manager)
        self._draw, self._faults, self._rate = draw, tuple(faults), rate

    def _open(self) -> None:
        self._given = math.floor(self.manager.clock.now() * self._rate) - 1
        self.is_held = True
        """Whether it has the device, for tests of its switch."""

    def _close(self) -> None:
        self.is_held = False

    def _read(self, now: float) -> Frame | None:
        sequence = math.floor(now * self._rate + 1e-6)
        if sequence <= self._given:
            return None
        self._given = sequence
        frame: Frame | None = Frame(
            self._draw(sequence / self._rate), sequence / self._rate, sequence
        )
        for fault in self._faults:
            if frame is not None and fault.start <= now < fault.end:
                frame = FAULTS[fault.kind](frame)
        return frame
