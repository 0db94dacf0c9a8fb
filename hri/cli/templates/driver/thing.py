"""Your own range sensor."""

from hri.core import RangeReading
from hri.hal import RangeSensor


class Thing(RangeSensor):
    """Returns its parameter as the distance; read your hardware here instead."""

    parameters = ("distance_cm",)

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self._distance = self.description.number("distance_cm", 100.0) / 100

    def read(self, now: float) -> RangeReading:
        return RangeReading(self.id, self._distance, now)

    def _close(self) -> None:
        """Release the hardware here."""
