"""A file as a stream."""

from __future__ import annotations

import io
import os
from pathlib import Path

from hri.core.errors import HriError
from hri.hal.stream import Seek, Stream, as_bytes

_WHENCE = {Seek.ABSOLUTE: os.SEEK_SET, Seek.RELATIVE: os.SEEK_CUR, Seek.END: os.SEEK_END}


class FileStream(Stream):
    """Reads and writes `file_path`.

    With `truncate` "true" the file begins empty; else it is kept, reading begins at its start, and
    all that is written goes to its end.
    """

    parameters = ("file_path", "truncate")

    def _open(self) -> None:
        path = Path(self.description.text("file_path"))
        mode = "w+b" if self.description.text("truncate", "false") == "true" else "a+b"
        try:
            self._file: io.BufferedRandom = path.open(mode)  # type: ignore[assignment]
        except OSError as error:
            reason = error.strerror or str(error)
            raise HriError(f"{path}: cannot be opened: {reason} - check the path") from error
        self._file.seek(0)

    def read(self, count: int) -> bytes:
        if count < 0:
            raise ValueError(f"{count} bytes - read 0 or more")
        return self._file.read(count)

    def write(self, data: bytes | str) -> None:
        self._file.write(as_bytes(data))

    def seek(self, origin: Seek, offset: int) -> None:
        try:
            self._file.seek(offset, _WHENCE[origin])
        except OSError as error:
            raise ValueError(f"{offset} is before the beginning - seek further on") from error

    @property
    def position(self) -> int:
        return self._file.tell()

    def _close(self) -> None:
        self._file.close()
