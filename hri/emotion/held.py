"""Causes that last: a low battery, being alone, a goal that is still open.

A deed is a pulse: what it charges fades by itself. A state holds its charges for as long as it
goes on. Each of them goes from where it was to where it is held,

    u(t) = target + (start - target) exp(-rate (t - since))

and falls to 0 once the state is over. All times are seconds of one clock.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import exp, inf, log
from typing import NamedTuple

from hri.emotion.label import FALL, Line
from hri.emotion.ledger import Axes

MOST = 50
"""States that are held at a time; of more the faintest one is let go."""
_STEPS = (0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 0.97)
"""Shares of a level at which its rise counts for the label."""
SOON_S = 2.0
"""Seconds in which a level is mostly there, where nothing else is said."""


class Level(NamedTuple):
    """A charge on its way."""

    start: float
    """When it set out, >= 0."""
    target: float
    """Where it goes, >= 0."""


class Held(NamedTuple):
    """A state that goes on, or that has ended and is still felt."""

    since: float
    """When its levels last changed their way."""
    levels: Mapping[str, Level]
    """By emotion."""
    rate: float
    """1/s."""
    mood: Axes
    """Its pull on the mood at `since`."""
    until: float = inf
    """When it is over by itself."""
    fall_rate: float = 1.0 / SOON_S
    """How fast it falls then, 1/s."""
    likelihood: Level | None = None
    """Of an open goal, 0 to 1: it falls the longer what was expected does not come."""
    peak: float = 0.0
    """The largest likelihood that an open goal ever had."""

    def at(self, level: Level, now: float) -> float:
        """Where a level is at a time from `since` to `until`."""
        start, target = level
        return max(target + (start - target) * exp(-self.rate * (now - self.since)), 0.0)

    @property
    def is_over(self) -> bool:
        """Whether nothing is held any more: all that is left falls."""
        return not any(level.target for level in self.levels.values())


def lines_of(held: Held, now: float) -> Iterator[Line]:
    """The levels from `now` on, for the label.

    A rise is not a straight line on a logarithmic scale: it counts in steps, from below.
    """
    end, passed = held.until - now, now - held.since
    for name, level in held.levels.items():
        start, target = level
        if max(level) < FALL:
            continue  # It never has the label.
        if start > target:
            yield Line(name, log(start - target) - held.rate * passed, held.rate, 0.0, end)
        if target > start:
            for share in _STEPS:
                if share * target >= start:
                    there = log((target - start) / (target * (1.0 - share))) / held.rate - passed
                    begin = min(max(there, 0.0), end)
                    yield Line(name, log(share * target), 0.0, begin, end)
            if start:
                yield Line(name, log(start), 0.0, 0.0, end)
        elif target:
            yield Line(name, log(target), 0.0, 0.0, end)
        if held.until < inf and (left := held.at(level, held.until)):
            yield Line(name, log(left) + held.fall_rate * end, held.fall_rate, end, inf)
