"""The battery interface."""

from abc import abstractmethod

from hri.hal.resource import Resource


class Battery(Resource):
    """How much is left."""

    @abstractmethod
    def level(self, now: float) -> float:
        """0 (empty) to 1 (full)."""

    @abstractmethod
    def voltage(self, now: float) -> float:
        """Volts between its poles."""
