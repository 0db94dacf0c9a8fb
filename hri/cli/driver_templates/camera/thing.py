"""Your own camera."""

import numpy as np

from hri.core import Frame
from hri.hal import Camera

PERIOD = 0.1  # seconds from picture to picture


class Thing(Camera):
    """Sees gray of the brightness that its parameter says; ask your hardware instead."""

    parameters = (*Camera.parameters, "brightness")

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        gray = self.description.count("brightness", 128, 0, 255)
        self._picture = np.full((self.height, self.width, 3), gray, np.uint8)  # RGB
        self._due = self._count = 0.0

    def _read(self, now: float) -> Frame | None:
        if now < self._due:
            return None  # there is no new picture yet; never wait for one in here
        self._due = now + PERIOD
        self._count += 1
        return Frame(self._picture, now, int(self._count))

    def _close(self) -> None:
        """Release the hardware here."""
