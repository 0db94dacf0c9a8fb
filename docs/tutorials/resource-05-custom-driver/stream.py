"""A custom interface: bytes in order, wherever they come from or go to."""

from abc import abstractmethod
from enum import Enum

from hri.hal import Resource


class Seek(Enum):
    """What an offset is counted from."""

    ABSOLUTE = 0
    RELATIVE = 1
    END = 2


class Stream(Resource):
    """Bytes that are read and written at a position."""

    @abstractmethod
    def read(self, count: int) -> bytes:
        """The next bytes, fewer than `count` at the end."""

    @abstractmethod
    def write(self, data: bytes) -> None:
        """Write all of it."""

    @abstractmethod
    def seek(self, origin: Seek, offset: int) -> None:
        """Go to another position."""

    @property
    @abstractmethod
    def position(self) -> int:
        """Bytes from the beginning."""
