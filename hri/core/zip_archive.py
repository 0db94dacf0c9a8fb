"""ZIP archives that anyone may have written: what they hold is bounded before it is unpacked."""

from __future__ import annotations

import errno
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, Any, cast

BROKEN = (
    zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError,
    ValueError, IndexError, struct.error,
)  # fmt: skip
"""What a damaged archive may raise, besides OSError."""
PACKED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""How entries may be packed."""


@contextmanager
def opened_archive(file: IO[bytes], longest: int) -> Iterator[zipfile.ZipFile]:
    """An archive whose directory has at most `longest` bytes, and whose entries are stored or
    deflated.

    Raises ValueError with the reason for any other, and for whatever turns out to be broken while
    it is read.
    """
    try:
        with zipfile.ZipFile(cast(IO[bytes], _InSmallReads(file, longest))) as archive:
            for entry in archive.infolist():
                if entry.compress_type not in PACKED:
                    raise ValueError(f'"{entry.filename}" is packed in an unusual way')
            yield archive
    except BROKEN as error:
        raise ValueError(str(error) or "it ends too early") from error
    except OSError as error:
        if error.errno not in (None, errno.EINVAL):  # of a place before the beginning
            raise
        raise ValueError(str(error)) from error


def unpacked_size(archive: zipfile.ZipFile) -> int:
    """Bytes of all entries, as the archive declares them; unpacking stops there."""
    return sum(entry.file_size for entry in archive.infolist())


class _InSmallReads:
    """A file that gives no more than some bytes at once.

    `zipfile` reads the whole directory, whose length the archive declares, and makes an object of
    each entry, before anyone can count them.
    """

    def __init__(self, file: IO[bytes], longest: int) -> None:
        self._file, self._longest = file, max(longest, 1 << 17)  # a comment has 65,535 bytes

    def read(self, size: int = -1) -> bytes:
        wanted = self._longest + 1 if size is None or size < 0 else size
        data = self._file.read(min(wanted, self._longest + 1))
        if len(data) > self._longest:
            raise ValueError(f"its directory has more than {self._longest} bytes")
        return data

    def __getattr__(self, name: str) -> Any:
        return getattr(self._file, name)
