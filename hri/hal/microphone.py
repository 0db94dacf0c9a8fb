"""The microphone interface."""

from abc import abstractmethod

from hri.core.signals import Samples
from hri.hal.resource import Resource


class Microphone(Resource):
    """Mono sound at a fixed rate."""

    rate: int = 16000
    """Samples a second."""

    @abstractmethod
    def read(self, now: float) -> Samples:
        """All samples since the last call, possibly none; never waits."""

    @property
    def has_ended(self) -> bool:
        """True when no further sound will come (a file is spent)."""
        return False
