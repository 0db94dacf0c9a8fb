"""How far a long measurement is, on standard error."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TypeVar

T = TypeVar("T")
WIDTH = 30
"""Letters of the bar."""


def progress(things: Iterable[T], count: int, what: str) -> Iterator[T]:
    """The things, with a bar that grows by one each; a line each tenth where nobody watches."""
    is_terminal = sys.stderr.isatty()
    for number, thing in enumerate(things, 1):
        yield thing
        if is_terminal:
            done = WIDTH * number // count
            bar = "#" * done + "." * (WIDTH - done)
            end = "\n" if number == count else ""
            print(f"\r{what} [{bar}] {number}/{count}", end=end, file=sys.stderr, flush=True)
        elif number * 10 // count > (number - 1) * 10 // count:
            print(f"{what} {number}/{count}", file=sys.stderr, flush=True)
