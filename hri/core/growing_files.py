"""Files that grow while a robot runs, such as logs, sounds and films.

After each record the file is good up to there, whatever happens to the program. When the disk is
full the file ends with its last whole record, and one line says so; the robot goes on.
"""

from __future__ import annotations

import logging
import os
from contextlib import suppress
from pathlib import Path

from hri.core.errors import HriError
from hri.core.open_files import AT_ONCE, BINARY, lock
from hri.core.writing import not_written, reason_of, write_all

log = logging.getLogger("hri.recording")


class GrowingFile:
    """A new file to which whole records are appended; only one program may write it at a time."""

    def __init__(self, path: Path) -> None:
        """Raises HriError when the file cannot be written, or another program writes it now."""
        self.path = path
        self.size = 0
        """Bytes of the whole records."""
        try:
            self._handle: int | None = os.open(path, os.O_WRONLY | os.O_CREAT | BINARY, 0o666)
        except OSError as error:
            raise not_written(path, error) from error
        try:
            self._begin(self._handle)
        except BaseException:
            os.close(self._handle)
            raise

    def _begin(self, handle: int) -> None:
        try:
            lock(handle)
        except BlockingIOError:
            remedy = "choose another place"
            raise HriError(f"{self.path}: another program is writing it - {remedy}") from None
        except OSError:  # a file system without locks
            pass
        with suppress(OSError):  # a pipe or a device
            os.ftruncate(handle, 0)

    @property
    def has_ended(self) -> bool:
        """Whether it is closed, or has ended because it could not be written."""
        return self._handle is None

    def append(self, record: bytes) -> bool:
        """Write a record at the end; whether it is there, whole."""
        if self._handle is None:
            return False
        try:
            write_all(self._handle, record)
        except OSError as error:
            self._end(self._handle, error)
            return False
        self.size += len(record)
        return True

    def patch(self, place: int, record: bytes) -> None:
        """Overwrite what stands at a place; a few bytes, so that they are changed in one step."""
        if self._handle is not None:
            try:
                os.pwrite(self._handle, record, place)
            except OSError as error:
                self._end(self._handle, error)

    def _end(self, handle: int, error: OSError) -> None:
        with suppress(OSError):
            os.ftruncate(handle, self.size)
        log.error("%s ends here: %s", self.path, reason_of(error))
        self.close()

    def close(self) -> None:
        """Write no more; a second call does nothing."""
        if self._handle is not None:
            handle, self._handle = self._handle, None
            with suppress(OSError):
                os.close(handle)


def is_growing(path: Path) -> bool:
    """Whether a program is writing the file now."""
    try:
        handle = os.open(path, os.O_RDONLY | AT_ONCE | BINARY)
    except OSError:
        return False
    try:
        lock(handle, is_shared=True)
    except BlockingIOError:
        return True
    except OSError:  # a file system without locks
        return False
    finally:
        os.close(handle)
    return False
