"""A bar for work that takes its time, on terminals only."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TypeVar

T = TypeVar("T")

WIDTH = 30
"""Characters of the bar."""


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
