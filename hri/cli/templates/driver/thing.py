"""A range sensor of your own."""

from hri.core import RangeReading
from hri.hal import RangeSensor


class Thing(RangeSensor):
    """Measures what its parameter says; ask your hardware in its place."""

    parameters = ("distance_cm",)

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self._distance = self.description.number("distance_cm", 100.0) / 100

    def read(self, now: float) -> RangeReading:
        return RangeReading(self.id, self._distance, now)

    def _close(self) -> None:
        """Let the hardware go here."""
