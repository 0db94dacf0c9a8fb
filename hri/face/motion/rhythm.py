"""Things that happen again and again at irregular times, such as blinks, breaths and glances.

The intervals are random and independent of each other, and no grid lies below them. Still any time
can be asked for: time is cut into long chapters, and each draws its intervals from its beginning.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from typing import NamedTuple

from hri.face.motion.chance import chance, log_normal

CHAPTER = 128
"""Mean intervals in a chapter."""
_NUMBERS = 1000
"""More than ever begin in a chapter."""


class Beat(NamedTuple):
    """One of the things that happen."""

    number: int
    """Differs from beat to beat, for what is drawn for each."""
    since: float
    """Time from it to the time asked for, below 0 if it is yet to come."""


@dataclass(frozen=True, eq=False)
class Rhythm:
    """Log-normal intervals, in any unit of time."""

    kind: str
    """Rhythms of different kinds do not depend on each other."""
    mean: float
    spread: float
    """Deviation of an interval, as a share of the mean."""
    least: float = 0.0
    """No interval is shorter, apart from rounding."""

    def beat(self, seed: int, t: float, later: int = 0) -> Beat:
        """The last beat up to `t`, or the one `later` by this many beats (below 0: earlier)."""
        length = CHAPTER * self.mean
        whole, at = divmod(t, length)
        chapter = int(whole)
        times = _times(self, seed, chapter)
        index = bisect_right(times, at) - 1 + later
        while index < 0:
            chapter, at = chapter - 1, at + length
            times = _times(self, seed, chapter)
            index += len(times)
        while index >= len(times):
            index -= len(times)
            chapter, at = chapter + 1, at - length
            times = _times(self, seed, chapter)
        return Beat(chapter * _NUMBERS + index, at - times[index])

    def lasting(self, seed: int, t: float) -> tuple[Beat, float]:
        """The last beat up to `t`, and the time from it to the next one."""
        last = self.beat(seed, t)
        return last, last.since - self.beat(seed, t, 1).since

    def past(self, seed: int, t: float, span: float) -> Iterator[Beat]:
        """The beats less than `span` before `t`, the last one first."""
        for earlier in count():
            beat = self.beat(seed, t, -earlier)
            if beat.since >= span:
                return
            yield beat


@lru_cache(maxsize=256)
def _times(rhythm: Rhythm, seed: int, chapter: int) -> tuple[float, ...]:
    """When the beats of a chapter are, from its beginning; at least one."""
    number = chapter * _NUMBERS
    # The interval that lies over the border has begun already.
    begun = chance(seed, f"{rhythm.kind} begun", chapter)
    times = [max(begun * _interval(rhythm, seed, number), rhythm.least)]
    while len(times) < _NUMBERS:
        time = times[-1] + _interval(rhythm, seed, number + len(times))
        if time > CHAPTER * rhythm.mean:
            break
        times.append(time)
    return tuple(times)


def _interval(rhythm: Rhythm, seed: int, number: int) -> float:
    drawn = rhythm.mean * log_normal(seed, f"{rhythm.kind} interval", number, rhythm.spread)
    return max(drawn, rhythm.least)
