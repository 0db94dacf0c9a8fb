"""The button interface."""

from abc import abstractmethod

from hri.hal.resource import Resource

TAP_S = 0.1
"""Seconds for which a tap that is over counts as pressed, so that a slow network notices it."""


class Button(Resource):
    """A push button."""

    @abstractmethod
    def is_pressed(self, now: float) -> bool:
        """Whether it is held down, or was for a moment within the last TAP_S seconds."""
