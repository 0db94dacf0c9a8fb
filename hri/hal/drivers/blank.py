"""A camera that sees nothing, and a screen that nobody sees."""

from hri.core.signals import Frame, Image
from hri.hal.camera import Camera
from hri.hal.screen import Screen


class BlankCamera(Camera):
    """Stands in where there is no camera: no picture ever comes."""

    def _read(self, now: float) -> Frame | None:
        return None

    @property
    def has_ended(self) -> bool:
        return True


class BlankScreen(Screen):
    """Stands in where there is no screen: the face is not drawn, which saves its time."""

    parameters = ("width", "height")
    is_seen = False

    def _open(self) -> None:
        self._take_size()

    def show(self, image: Image, time: float) -> None:
        pass
