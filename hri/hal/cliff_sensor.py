"""The cliff sensor interface."""

from abc import abstractmethod

from hri.hal.resource import Resource


class CliffSensor(Resource):
    """Looks down from the base."""

    @abstractmethod
    def is_cliff(self, now: float) -> bool:
        """Whether there is no floor below it now."""
