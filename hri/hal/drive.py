"""The drive base interfaces: commands down, pose up."""

from abc import abstractmethod

from hri.core.signals import Pose2D, Twist
from hri.hal.resource import Resource


class DriveSystem(Resource):
    """A base that follows velocities; it must stop by itself when no command comes for 0.5 s."""

    max_linear: float = 0.5
    """Metres a second."""
    max_angular: float = 1.5
    """Radians a second."""
    max_acceleration: float = 0.5
    """Metres a second squared; turning is limited to four times that in radians."""

    @abstractmethod
    def set_velocity(self, twist: Twist, now: float) -> None:
        """Go on with this velocity until the next command."""

    @abstractmethod
    def stop(self, now: float) -> None:
        """Stand still as fast as the hardware can."""


class Odometry(Resource):
    """Where the base is, by its own wheels."""

    @abstractmethod
    def pose(self, now: float) -> Pose2D:
        """Pose in the frame in which the base was switched on."""

    @abstractmethod
    def velocity(self, now: float) -> Twist:
        """Measured velocity."""
