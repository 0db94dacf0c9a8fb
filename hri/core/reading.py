"""Reading files that anyone may have written, within limits.

Every reader begins here: what is not a regular file, is too large or is not text is refused in one
line, before it takes memory or keeps the program waiting.
"""

from __future__ import annotations

import io
import json
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, NoReturn, TextIO

from hri.core.errors import AuthoringError, HriError, Place
from hri.core.open_files import AT_ONCE, BINARY
from hri.core.paths import exists

LARGEST_FILE = 4_000_000
"""Bytes of an authored file."""
LARGEST_INTEGER = 1e300
"""Integers of JSON beyond it are refused: no float holds them."""


def require_file(path: Path, what: str, largest: int | None = None) -> None:
    """Raise HriError for a path that is not a regular file, is not there, or is too large."""
    if not exists(path):
        raise HriError(f"{path}: no such file - check the path")
    with opened(path, what, largest):
        pass


@contextmanager
def opened(path: Path, what: str, largest: int | None = LARGEST_FILE) -> Iterator[BinaryIO]:
    """A file to read bytes from; an error of the disk while it is read is one line, too.

    Raises HriError when it cannot be read, is not a regular file, or has more bytes than
    `largest`.
    """
    with _told(path, what), _open_regular(path, what) as file:
        if largest is not None and os.fstat(file.fileno()).st_size > largest:
            _refuse_size(path, what, largest)
        yield file


def _open_regular(path: Path, what: str) -> BinaryIO:
    try:
        # Without waiting: a pipe that nobody writes to would keep us forever.
        descriptor = os.open(path, os.O_RDONLY | AT_ONCE | BINARY)
    except ValueError as error:  # no name that a file can have
        raise HriError(f"{path}: cannot read this {what}: {error} - check the path") from error
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise HriError(f"{path}: this {what} is not a regular file - name a file")
    return open(descriptor, "rb")


@contextmanager
def _told(path: Path, what: str) -> Iterator[None]:
    """Make one line of an error of the disk."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot read this {what}: {reason} - check the path") from error


def read_bytes(path: Path, what: str, largest: int = LARGEST_FILE) -> bytes:
    """What an authored file holds.

    Raises HriError when it cannot be read, is not a regular file, or is larger than `largest`.
    """
    with opened(path, what, largest) as file:
        raw = file.read(largest + 1)  # a file of /proc has no size beforehand
    if len(raw) > largest:
        _refuse_size(path, what, largest)
    return raw


def _refuse_size(path: Path, what: str, largest: int) -> NoReturn:
    raise HriError(f"{path}: this {what} is too large - keep it below {largest} bytes")


def read_text(path: Path, what: str, largest: int = LARGEST_FILE) -> str:
    """The text of an authored file in UTF-8.

    Raises HriError when it cannot be read, AuthoringError when it is not UTF-8 text.
    """
    raw = read_bytes(path, what, largest)
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - raw.rfind(b"\n", 0, error.start)
        place = Place(path, line, column)
        raise AuthoringError(place, "not UTF-8 text", "save the file as UTF-8") from error


@contextmanager
def read_lines(
    path: Path, what: str, largest: int, longest: int, errors: str = "strict"
) -> Iterator[Iterator[str]]:
    """The lines of a text in UTF-8 one by one, with their ends, for files that need not fit memory.

    `errors` is what becomes of bytes that are not UTF-8, as in `open`. Raises HriError when it
    cannot be read, is not text, or has more bytes than `largest` or a line of more than `longest`
    characters.
    """
    with opened(path, what, largest) as file:
        lines = io.TextIOWrapper(file, encoding="utf-8-sig", errors=errors, newline="")
        try:
            yield _bounded(path, what, lines, longest)
        except UnicodeDecodeError as error:
            raise HriError(f"{path}: not a text file - save it in UTF-8") from error
        finally:
            lines.detach()


def _bounded(path: Path, what: str, lines: TextIO, longest: int) -> Iterator[str]:
    while line := lines.readline(longest):
        if len(line) == longest:
            raise HriError(f"{path}: this {what} has a line that is too long - write shorter lines")
        yield line


LONG_JSON = 1_000_000
"""Bytes from which a text of JSON is counted before it is read: in memory it takes up to 30 times
as much, since a list of nothing is three bytes."""
MOST_LISTS, MOST_TEXTS, MOST_VALUES = 500_000, 500_000, 3_000_000
"""Lists and objects, texts, and values in a long text of JSON."""


def parse_json(text: str | bytes, parse_constant: Callable[[str], Any] | None = None) -> Any:
    """What a text of JSON says; `parse_constant` is for NaN and Infinity, as in `json.loads`.

    Raises ValueError with a sentence for what is not JSON, is nested too deeply, has an integer
    beyond LARGEST_INTEGER, or has more in it than fits into memory.
    """
    if len(text) > LONG_JSON:
        _require_few(text.encode(errors="replace") if isinstance(text, str) else text)
    try:
        if parse_constant is None and isinstance(text, str):
            return _decode(text)
        return json.loads(text, parse_int=_integer, parse_constant=parse_constant)
    except RecursionError as error:
        raise ValueError("its brackets are nested too deeply") from error


def _require_few(text: bytes) -> None:
    lists, texts = text.count(b"[") + text.count(b"{"), text.count(b'"') // 2
    if lists > MOST_LISTS or texts > MOST_TEXTS or text.count(b",") > MOST_VALUES:
        raise ValueError("too many lists, texts, or values")


def _integer(digits: str) -> int:
    if len(digits) > 300:
        raise ValueError(f"an integer of {len(digits)} digits")
    return int(digits)


_decode = json.JSONDecoder(parse_int=_integer).decode
"""One for all lines of a log: to make one takes longer than to read a line."""
