"""Your own button."""

from hri.hal import Button


class Thing(Button):
    """Is held while its parameter says so; read your hardware here instead."""

    parameters = ("held",)

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self._is_held = self.description.choice("held", "false", ("false", "true")) == "true"

    def is_pressed(self, now: float) -> bool:
        return self._is_held

    def _close(self) -> None:
        """Release the hardware here."""
