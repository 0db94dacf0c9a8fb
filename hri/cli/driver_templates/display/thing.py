"""Your own display, of black and white pixels."""

import numpy as np

from hri.core.signals import Image
from hri.hal import Screen


class Thing(Screen):
    """Makes a bit of each pixel, and keeps the bytes; send them to your hardware instead."""

    parameters = ("width", "height")

    def _open(self) -> None:
        # Open the hardware here; raise self.not_available(why, remedy) where it is missing.
        self._take_size()
        self.sent = b""

    def show(self, image: Image, time: float) -> None:
        # The picture has the size of the display: [height, width, 3], RGB.
        self.sent = np.packbits(image.mean(axis=2) >= 128).tobytes()

    def _close(self) -> None:
        """Release the hardware here."""
