"""The speaker interface."""

from abc import abstractmethod

from hri.core.signals import Samples
from hri.hal.resource import Resource


class Speaker(Resource):
    """Plays one sound at a time and knows how much of it has really been heard."""

    @abstractmethod
    def play(self, samples: Samples, rate: int, now: float) -> None:
        """Start a sound, instead of one that still plays; returns at once."""

    @abstractmethod
    def extend(self, samples: Samples, now: float) -> None:
        """More of the sound that was started last; where it ran out meanwhile, it goes on."""

    @abstractmethod
    def position(self, now: float) -> float | None:
        """Seconds of the sound that have been heard; None when nothing plays."""

    @abstractmethod
    def stop(self, now: float) -> None:
        """Silence within one block."""
