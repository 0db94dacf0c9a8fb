"""Where words go in a plot over time: none over another, none beyond the frame."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple


class Label(NamedTuple):
    """Words in a plot."""

    at: float
    """Where they begin, as a part of the width of the frame."""
    level: int
    """0 is the lowest of the rows above each other."""
    text: str
    time: float
    """Seconds, of what they are about."""


def placed(
    words: Iterable[tuple[float, str]], start: float, end: float, letter: float, levels: int
) -> Iterator[Label]:
    """Words by their times, in order, in a frame from a start to an end in seconds.

    `letter` is the width of one, as a part of the frame's. Words that would leave the frame begin
    further left; those for which there is no room on any level are left out.
    """
    taken = [-math.inf] * levels
    for time, text in words:
        length = letter * (len(text) + 1)
        at = max(0.0, min((time - start) / (end - start), 1.0 - length))
        level = next((level for level, right in enumerate(taken) if right <= at), None)
        if level is not None:
            taken[level] = at + length
            yield Label(at, level, text, time)
