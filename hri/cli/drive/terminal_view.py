"""A terminal that gives keys one by one and shows a picture in place."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from contextlib import suppress
from types import TracebackType
from typing import Self

from hri.cli.drive.keys import HELP, KeyReader
from hri.cli.drive.text_map import TextMap
from hri.cli.drive.view import Snapshot, View
from hri.core.errors import HriError

CLEAR_DOWN, CLEAR_LINE, HOME = "\x1b[J", "\x1b[K", "\x1b[H"
OWN_SCREEN, FORMER_SCREEN = "\x1b[?1049h\x1b[?25l", "\x1b[?25h\x1b[?1049l"
CHUNK = 1024
ENOUGH = 200
"""Default rows and columns."""


def own_terminal() -> tuple[int, int]:
    """Descriptors of this program's keyboard and screen. Raises HriError where it has none."""
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise HriError("driving by hand needs a terminal - start it from one, without pipes")
    return sys.stdin.fileno(), sys.stdout.fileno()


class TerminalView(View):
    """A context manager; always restores the terminal."""

    def __init__(self, input: int, output: int, title: str) -> None:
        """Descriptors of the keyboard and of the screen."""
        self._input, self._output = input, output
        self._picture = TextMap(title)
        self._reader = KeyReader()

    def __enter__(self) -> Self:
        self._before = termios.tcgetattr(self._input)
        tty.setraw(self._input)
        self._write(OWN_SCREEN)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with suppress(OSError, termios.error):  # of a terminal that has gone
            termios.tcsetattr(self._input, termios.TCSADRAIN, self._before)
            self._write(FORMER_SCREEN)

    def read_keys(self) -> list[str]:
        """Bytes typed since the last call; a closed terminal counts as Escape."""
        if not select.select([self._input], [], [], 0)[0]:
            return []
        try:
            data = os.read(self._input, CHUNK)
        except OSError:
            data = b""
        return self._reader.feed(data) if data else ["escape"]

    def show(self, moment: Snapshot) -> None:
        columns, rows = os.get_terminal_size(self._output)
        below = ["", *HELP]
        lines = [*self._picture.lines(moment, (rows or ENOUGH) - len(below)), *below]
        shown = (line[: columns or ENOUGH] + CLEAR_LINE for line in lines[: rows or ENOUGH])
        self._write(HOME + "\r\n".join(shown) + CLEAR_DOWN)

    def _write(self, text: str) -> None:
        data = text.encode()
        while data:
            data = data[os.write(self._output, data) :]
