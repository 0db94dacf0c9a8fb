"""The battery interface."""

from abc import abstractmethod

from hri.hal.resource import Resource


class Battery(Resource):
    """How much is left."""

    @abstractmethod
    def level(self, now: float) -> float | None:
        """0 (empty) to 1 (full); None while that is not known."""

    @abstractmethod
    def voltage(self, now: float) -> float | None:
        """Volts between its poles; None while that is not known."""
