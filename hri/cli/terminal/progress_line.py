"""Progress of long work, on terminals only."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from typing import Any, TextIO, TypeVar, cast

from hri.core.clock import RealClock

T = TypeVar("T")

WIDTH = 30
"""Characters of the bar."""
EVERY = 1.0
"""Seconds between two lines about work of unknown length."""
SILENCE = 2.0
"""Seconds of silence before the first such line."""


def progress(items: Iterable[T], total: int, what: str) -> Iterator[T]:
    """Yields the items, with a progress bar of `total` on stderr."""
    is_shown = sys.stderr.isatty() and total > 1
    try:
        for number, item in enumerate(items):
            if is_shown:
                bar = "#" * (WIDTH * number // total)
                sys.stderr.write(f"\r{what} [{bar:<{WIDTH}}] {number} of {total}")
                sys.stderr.flush()
            yield item
    finally:
        if is_shown:
            sys.stderr.write("\r\x1b[K")


@contextmanager
def waiting(what: str) -> Iterator[None]:
    """While the body runs silently for long, show what it does and for how many seconds. The line
    disappears as soon as the body prints something, and at the end.
    """
    if not sys.stderr.isatty():
        yield
        return
    line, done = _Line(sys.stderr, what), threading.Event()

    def show() -> None:
        line.show()
        while not done.wait(EVERY):
            line.show()

    clerk = threading.Thread(target=show, daemon=True)
    clerk.start()
    out, errors = (cast(TextIO, _Announced(stream, line)) for stream in (sys.stdout, sys.stderr))
    try:
        with redirect_stdout(out), redirect_stderr(errors):
            yield
    finally:
        done.set()
        clerk.join()
        line.wipe()


class _Line:
    """A line on a terminal that lasts until something else is printed."""

    def __init__(self, terminal: TextIO, what: str) -> None:
        self._terminal = terminal
        self._what = what
        self._clock = RealClock()
        self._begun = self._printed = self._clock.now()
        self._is_shown = False
        self._lock = threading.Lock()

    def show(self) -> None:
        with self._lock:
            now = self._clock.now()
            if now - self._printed >= SILENCE:
                self._write(f"\r{self._what}, {now - self._begun:.0f} s\x1b[K")
                self._is_shown = True

    def wipe(self) -> None:
        """Clear the line for other output."""
        with self._lock:
            if self._is_shown:
                self._write("\r\x1b[K")
                self._is_shown = False
            self._printed = self._clock.now()

    def _write(self, text: str) -> None:
        self._terminal.write(text)
        self._terminal.flush()


class _Announced:
    """A stream that wipes the line before it writes."""

    def __init__(self, stream: TextIO, line: _Line) -> None:
        self._stream = stream
        self._line = line

    def write(self, text: str) -> int:
        self._line.wipe()
        return self._stream.write(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)
