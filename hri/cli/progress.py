"""What is shown of work that takes its time, on terminals only."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from hri.core.clock import RealClock

T = TypeVar("T")

WIDTH = 30
"""Characters of the bar."""
EVERY = 1.0
"""Seconds between two lines about work that has no end in sight."""


def progress(items: Iterable[T], total: int, what: str) -> Iterator[T]:
    """The items; while they are taken, how many of `total` are done is shown on stderr."""
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
    """While the body runs for long, what is done and for how many seconds is shown on stderr."""
    if not sys.stderr.isatty():
        yield
        return
    clock, done = RealClock(), threading.Event()
    begun = clock.now()

    def show() -> None:
        while not done.wait(EVERY):
            sys.stderr.write(f"\r{what}, {clock.now() - begun:.0f} s")
            sys.stderr.flush()

    clerk = threading.Thread(target=show, daemon=True)
    clerk.start()
    try:
        yield
    finally:
        done.set()
        clerk.join()
        sys.stderr.write("\r\x1b[K")
