"""The screen interface."""

from abc import abstractmethod
from typing import ClassVar

from hri.core.signals import Image
from hri.hal.resource import Resource

LARGEST_SIDE = 8192
"""Pixels; more is a slip of the pen."""


class Screen(Resource):
    """Shows pictures of a fixed size and reports keys."""

    width: int = 640
    height: int = 480
    is_seen: ClassVar[bool] = True
    """Whether anyone, or a recording, may look; otherwise nothing needs to be drawn."""
    is_one_bit: bool = False
    """Whether it shows what is lighter than half as lit, and the rest as dark."""

    def _take_size(self) -> None:
        """Width and height as the configuration has them. Raises AuthoringError."""
        self.width = self.description.count("width", 640, 16, LARGEST_SIDE)
        self.height = self.description.count("height", 480, 16, LARGEST_SIDE)

    @abstractmethod
    def show(self, image: Image, time: float) -> None:
        """Show a picture of shape [height, width, 3]."""

    def pressed_keys(self) -> list[str]:
        """Names of the keys pressed since the last call: "space", "m", "escape", ..."""
        return []

    @property
    def is_closed(self) -> bool:
        """True once the user has closed the window."""
        return False
