"""The range sensor interface."""

from abc import abstractmethod

from hri.core.signals import RangeReading
from hri.hal.resource import Resource


class RangeSensor(Resource):
    """Distance along one beam."""

    @abstractmethod
    def read(self, now: float) -> RangeReading:
        """The newest reading; distance is infinite when nothing is in range."""
