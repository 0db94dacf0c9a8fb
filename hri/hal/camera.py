"""The camera interface."""

from abc import abstractmethod

from hri.core.signals import Frame
from hri.hal.resource import Resource

LOOK = 0.01
"""Seconds between looks for the next picture."""


class Camera(Resource):
    """Pictures with the time they were taken."""

    width: int = 320
    height: int = 240
    field_of_view: float = 1.05
    """Horizontal, radians."""

    @abstractmethod
    def read(self, now: float) -> Frame | None:
        """The newest picture taken since the last call; None when there is none yet."""

    def take(self, timeout: float = 5.0) -> Frame:
        """Wait for the next picture; for programs without a robot loop.

        Raises NotAvailable when none comes within `timeout` seconds.
        """
        clock = self.manager.clock
        end = clock.now() + timeout
        while (frame := self.read(clock.now())) is None:
            if clock.now() >= end:
                why = f"no picture within {timeout:g} s"
                raise self.not_available(why, "unplug it and plug it in again")
            clock.advance(LOOK)
        return frame

    def pan(self, now: float) -> float:
        """Where it points, from the robot's straight ahead to the left, radians."""
        return 0.0

    @property
    def has_ended(self) -> bool:
        """True when no further picture will come (a file is spent)."""
        return False
