"""Makes standard input, output and error safe, however a program was started."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from typing import Any, TextIO, cast


def open_missing() -> None:
    """Open the null device for closed standard streams. Otherwise the next opened file would get
    their number, and receive the output of libraries.
    """
    for number, (name, mode) in enumerate((("stdin", "r"), ("stdout", "w"), ("stderr", "w"))):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest free number, which is this one
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, closefd=False))  # noqa: SIM115 - until the end


def let_go(out: TextIO) -> None:
    """Discard the pending and all further output of a stream."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, out.fileno())
    os.close(nowhere)


@contextmanager
def unfailing_output() -> Iterator[None]:
    """While the block runs, output that cannot be written is dropped; a line on stderr says so. For
    programs whose output is not their purpose. A reader that has gone (`... | head`) still raises
    BrokenPipeError.
    """
    open_missing()
    with redirect_stdout(cast(TextIO, _Unfailing(sys.stdout))):
        yield


class _Unfailing:
    """A stream that ignores write errors."""

    def __init__(self, out: TextIO) -> None:
        self._out = out

    def __getattr__(self, name: str) -> Any:
        return getattr(self._out, name)

    def write(self, text: str) -> int:
        try:
            return self._out.write(text)
        except OSError as error:
            self._give_up(error)
            return len(text)

    def flush(self) -> None:
        try:
            self._out.flush()
        except OSError as error:
            self._give_up(error)

    def _give_up(self, error: OSError) -> None:
        if isinstance(error, BrokenPipeError):
            raise error
        let_go(self._out)
        with suppress(OSError):
            print(f"output stops: {error.strerror} - make room", file=sys.stderr)
