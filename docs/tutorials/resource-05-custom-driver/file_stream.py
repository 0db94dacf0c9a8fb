"""A custom driver: the bytes are those of a file."""

from pathlib import Path

from stream import Seek, Stream

WHENCE = {Seek.ABSOLUTE: 0, Seek.RELATIVE: 1, Seek.END: 2}


class FileStream(Stream):
    """Reads and writes `file_path`; with `truncate` "true" the file begins empty."""

    parameters = ("file_path", "truncate")

    def _open(self) -> None:
        path = Path(self.description.text("file_path"))
        mode = "w+b" if self.description.text("truncate") == "true" else "a+b"
        try:
            self._file = path.open(mode)
        except OSError as error:
            raise self.not_available(str(error), "choose another file_path") from error
        self._file.seek(0)

    def _close(self) -> None:
        self._file.close()

    def read(self, count: int) -> bytes:
        return self._file.read(count)

    def write(self, data: bytes) -> None:
        self._file.write(data)

    def seek(self, origin: Seek, offset: int) -> None:
        self._file.seek(offset, WHENCE[origin])

    @property
    def position(self) -> int:
        return self._file.tell()
