"""A camera that sees nothing."""

from hri.core.signals import Frame
from hri.hal.camera import Camera


class BlankCamera(Camera):
    """Stands in where there is no camera: no picture ever comes."""

    def _read(self, now: float) -> Frame | None:
        return None

    @property
    def has_ended(self) -> bool:
        return True
