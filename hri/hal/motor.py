"""The motor interface: one wheel of the base."""

from abc import abstractmethod

from hri.hal.resource import Resource


class Motor(Resource):
    """Rolls a wheel and counts how far; it must stop by itself when no command comes for 0.5 s."""

    max_velocity: float = 0.5
    """Meters a second, at the rim."""
    max_acceleration: float = 0.5
    """Meters a second squared."""

    @abstractmethod
    def set_velocity(self, velocity: float, now: float) -> None:
        """Roll on with this velocity of the rim, m/s, ahead when positive."""

    @abstractmethod
    def stop(self, now: float) -> None:
        """Stand still as fast as the hardware can."""

    @abstractmethod
    def set_power(self, percent: float, now: float) -> None:
        """How much of its force it may use, 0 to 100; at 0 the wheel can be turned by hand."""

    @abstractmethod
    def position(self, now: float) -> float:
        """Meters rolled ahead since it was switched on."""

    @abstractmethod
    def velocity(self, now: float) -> float:
        """Measured velocity of the rim, m/s."""
