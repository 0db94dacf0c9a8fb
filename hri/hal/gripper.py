"""The gripper interface."""

from abc import abstractmethod

from hri.hal.pending import Pending
from hri.hal.resource import Resource


class Gripper(Resource):
    """Two fingers that open and close; a new command takes the place of one that still runs."""

    @abstractmethod
    def open(self) -> Pending[None]:
        """Open the fingers; done when they are."""

    @abstractmethod
    def close(self) -> Pending[None]:
        """Close the fingers; done when they meet, or hold something."""

    @abstractmethod
    def opening(self, now: float) -> float:
        """How far the fingers are apart, 0 (closed) to 1 (open)."""

    @abstractmethod
    def has_object(self, now: float) -> bool:
        """Whether there is something between the fingers."""
