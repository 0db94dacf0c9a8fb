"""Your own battery."""

from hri.hal import Battery

EMPTY, FULL = 6.6, 8.4  # volts of two lithium cells


class Thing(Battery):
    """Returns its parameter as the voltage; read your hardware here instead."""

    parameters = ("volts",)

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self._volts = self.description.number("volts", FULL)

    def level(self, now: float) -> float | None:
        return min(1.0, max(0.0, (self._volts - EMPTY) / (FULL - EMPTY)))

    def voltage(self, now: float) -> float | None:
        return self._volts

    def _close(self) -> None:
        """Release the hardware here."""
