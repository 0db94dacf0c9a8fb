"""The joystick interface."""

from abc import abstractmethod

from hri.hal.resource import Resource


class Joystick(Resource):
    """Sticks and buttons under a person's hand; all is zero while it is unplugged."""

    @abstractmethod
    def axes(self, now: float) -> tuple[float, ...]:
        """Where the axes are, -1 to 1: first to the right, then toward the person, then the rest.

        The order and the signs are those of SDL, as on the devices themselves.
        """

    def heard(self, now: float) -> float:
        """When the device spoke last, in seconds; one that is asked at every look spoke now."""
        return now

    @abstractmethod
    def buttons(self, now: float) -> tuple[bool, ...]:
        """Which buttons are pressed."""
