"""The bumper interface."""

from abc import abstractmethod

from hri.hal.resource import Resource


class Bumper(Resource):
    """A switch that closes when the base touches something."""

    @abstractmethod
    def is_pressed(self, now: float) -> bool:
        """Whether it touches something now."""
