"""The screen interface."""

from abc import abstractmethod

from hri.core.signals import Image
from hri.hal.resource import Resource


class Screen(Resource):
    """Shows pictures of a fixed size and reports keys."""

    width: int = 640
    height: int = 480

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
