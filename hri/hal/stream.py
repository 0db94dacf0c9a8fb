"""The stream interface: bytes in order, with a position."""

from abc import abstractmethod
from enum import Enum

from hri.core.errors import HriError
from hri.hal.resource import Resource


class Seek(Enum):
    """What an offset is counted from."""

    ABSOLUTE = 0
    RELATIVE = 1
    END = 2


class Stream(Resource):
    """Bytes that are read and written at a position, where it is backed by something that can."""

    @abstractmethod
    def read(self, count: int) -> bytes:
        """The next bytes, at most `count`; fewer at the end."""

    @abstractmethod
    def write(self, data: bytes | str) -> None:
        """Write all of it, a text as UTF-8. Raises HriError for anything else."""

    @abstractmethod
    def seek(self, origin: Seek, offset: int) -> None:
        """Go to another position. Raises ValueError for one before the beginning."""

    @property
    @abstractmethod
    def position(self) -> int:
        """Bytes from the beginning."""


def as_bytes(data: bytes | str) -> bytes:
    """What a driver writes for it; a text becomes UTF-8. Raises HriError for anything else."""
    if isinstance(data, str):
        return data.encode("utf-8", "surrogateescape")
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise HriError(f"a stream cannot write {data!r:.60} - give bytes or a text")
    return bytes(data)
