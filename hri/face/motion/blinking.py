"""Blinks of a living face: those of idle life, and those that something causes.

No two blinks are alike. Blinks of idle life come at irregular intervals; some are double, some
shut the eyes only halfway, each takes its own time, and one eye is a little later than the other
and shuts a little less.

People blink when something changes: 71 % of blinks fall within 0.4 s of a communicative event (Ford
et al. 2013). So the begin and end of speech, a new expression and a large look elsewhere cause
blinks. Which ones do is drawn from a hash of seed, cause and time: the same events give the same
blinks.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from hri.face.motion.chance import chance, normal
from hri.face.motion.lids import OPEN, Closures
from hri.face.motion.rhythm import Rhythm
from hri.face.settings import BlinkSettings

CAUSES: Mapping[str, float] = {
    "speech began": 0.5,
    "speech ended": 0.8,
    "gaze shifted": 0.9,
    "expression changed": 0.6,
}
"""How many of such events bring a blink, 0 to 1."""
GAP = 1.0
"""Seconds between the last blink and one that something causes."""
DELAY = 0.15
"""Seconds from a cause to its blink, at most."""
MOST = 60.0
"""Blinks a minute."""

RHYTHM = Rhythm("blink", mean=1.0, spread=0.8)
"""Of blinks by themselves, in units of the mean interval. Intervals of people are log-normal
(Borges, Garcia & Cruz 2010); their deviation is 78 to 80 % of the mean in Doughty (2016), above
73 % in Johnston et al. (2013)."""
_HALF = (0.4, 0.8)
"""How far the lids shut in a half blink."""
_PACE = 0.15
"""Spread of the length of blinks: deviation of its logarithm."""
_FASTEST, _SLOWEST = -1.9, 2.5
"""Deviations that are taken at most: lids that are faster look like a flicker."""
_SLOW = (1.6, 4.0, 1.9)
"""How many times as long it takes to close, hold and open the eyes when wholly tired. Long
closures and a late opening are what shows drowsiness best (Caffier, Erdmann & Ullsperger 2003)."""
_EVEN = ((0.002, 0.008), (0.0, 0.04))
"""By how much one eye is later than the other, seconds, and by how much it shuts less: a few
milliseconds and hundredths, hardly seen."""
_UNEVEN = ((0.01, 0.02), (0.1, 0.25))
"""The same in a blink that is seen to be uneven: within one picture of a film, and a wink is far
more."""
LATEST = _UNEVEN[0][1]
"""Seconds."""
LEAST = 1 - _UNEVEN[1][1]
"""What one eye shuts in any blink, as a share of the other."""

_MOMENT = 1e-6
"""Seconds, that rounding may cost."""
_LONGEST_STEP = 10.0
"""Seconds; of a longer pause between two calls only the end is lived."""
_LONGEST_BLINK = 10.0
"""Seconds; more than any pair of blinks takes with the longest times that a face may set."""


@dataclass(frozen=True, slots=True)
class Blink:
    """One blink; times in seconds."""

    start: float
    close_s: float
    hold_s: float
    open_s: float
    depths: Closures
    """How far each eye shuts."""
    delays: Closures
    """How late each eye is."""

    @property
    def end(self) -> float:
        """When both eyes are open again."""
        return self.start + max(self.delays) + self.close_s + self.hold_s + self.open_s

    def closures(self, now: float) -> Closures:
        """How far the eyes are shut."""
        left, right = (
            depth * self._share(now - self.start - delay)
            for depth, delay in zip(self.depths, self.delays, strict=True)
        )
        return left, right

    def _share(self, elapsed: float) -> float:
        if elapsed <= 0:
            return 0.0
        if elapsed < self.close_s:
            return _smooth(elapsed / self.close_s)
        elapsed -= self.close_s + self.hold_s
        return 1.0 if elapsed < 0 else 1 - _smooth(min(elapsed / self.open_s, 1.0))


class Blinks:
    """The lids of one face."""

    def __init__(self, settings: BlinkSettings, seed: int) -> None:
        self._settings = settings
        self._seed = seed
        self._now = 0.0
        self._lived = 0.0
        """Mean intervals between blinks, as many as were at all times."""
        self._blinks: list[Blink] = []
        self._caused_until = -math.inf

    def cause(self, why: str, now: float) -> None:
        """Something happened that may bring a blink: one of `CAUSES`."""
        moment = round(now * 1000)
        last = max((blink.start for blink in self._blinks), default=-math.inf)
        if now - last > GAP and chance(self._seed, why, moment) < CAUSES[why]:
            start = now + DELAY * chance(self._seed, "blink delay", moment)
            # Numbers below zero: those from zero on are of blinks by themselves.
            blink = drawn(self._settings, self._seed, -1 - moment, start)
            self._blinks.append(blink)
            self._caused_until = blink.end

    def closure(
        self, now: float, rate: float, *, shutting: bool = False, tired: float = 0.0
    ) -> Closures:
        """How far the eyes are shut; `rate` is how often they are by themselves a minute.

        A blink that has begun is ended, whatever the rate becomes. While something shuts the eyes
        (`shutting`) none begins, and what has shut already does not open in between. The blinks
        of who is `tired`, 0 to 1, are slow.
        """
        if shutting:
            self._blinks = [self._held(b, now) for b in self._blinks if b.start <= self._now]
        else:
            self._live(now, min(rate, MOST) / 60, tired)
        self._now = now
        self._blinks = [blink for blink in self._blinks if now < max(blink.end, blink.start + GAP)]
        return _together(self._blinks, now)

    def _live(self, now: float, pace: float, tired: float) -> None:
        """Begin the blinks since the last call; `pace` is how many come in a second."""
        lived = min(now - self._now, _LONGEST_STEP) * pace
        if lived <= 0:
            return
        self._lived += lived
        for beat in RHYTHM.past(self._seed, self._lived, lived):
            start = now - beat.since / pace
            # One that something has just caused has done its work.
            if start >= self._caused_until:
                self._blinks += begun(self._settings, self._seed, beat.number, start, tired)

    def _held(self, blink: Blink, now: float) -> Blink:
        """The blink as if it had begun just so late that it is still shut."""
        shut = blink.close_s + blink.hold_s
        opens = self._now - blink.start > shut + _MOMENT
        return blink if opens else replace(blink, start=max(blink.start, now - shut))


def blink_closure(settings: BlinkSettings, seed: int, t: float, rate: float) -> Closures:
    """How far the eyes are shut at any time if nothing happens: `Blinks` at one `rate` from 0."""
    pace = min(rate, MOST) / 60
    if pace <= 0:
        return OPEN
    beats = RHYTHM.past(seed, t * pace, _LONGEST_BLINK * pace)
    return _together(
        (
            blink
            for beat in beats
            for blink in begun(settings, seed, beat.number, t - beat.since / pace)
        ),
        t,
    )


def drawn(
    settings: BlinkSettings, seed: int, number: int, start: float, tired: float = 0.0
) -> Blink:
    """The blink of a number, at that time."""
    pace = math.exp(_PACE * min(max(normal(seed, "blink pace", number), _FASTEST), _SLOWEST))
    usual = (settings.close_s, settings.hold_s, settings.open_s)
    close_s, hold_s, open_s = (
        seconds * pace * (1 + tired * (slow - 1))
        for seconds, slow in zip(usual, _SLOW, strict=True)
    )
    is_half = chance(seed, "half blink", number) < settings.half
    depth = _between(_HALF, seed, "blink depth", number) if is_half else 1.0
    is_uneven = chance(seed, "uneven blink", number) < settings.uneven
    late, less = _UNEVEN if is_uneven else _EVEN
    # Never so late that one eye opens while the other still shuts.
    delay = min(_between(late, seed, "blink late", number), hold_s)
    other = depth * (1 - _between(less, seed, "blink less", number))
    depths, delays = (depth, other), (0.0, delay)
    if chance(seed, "blink side", number) < 0.5:
        depths, delays = (other, depth), (delay, 0.0)
    return Blink(start, close_s, hold_s, open_s, depths, delays)


def begun(
    settings: BlinkSettings, seed: int, number: int, start: float, tired: float = 0.0
) -> Iterator[Blink]:
    """One blink, or two in a row."""
    first = drawn(settings, seed, 2 * number, start, tired)
    yield first
    if chance(seed, "double", number) < settings.double:
        yield drawn(settings, seed, 2 * number + 1, first.end, tired)


def _together(blinks: Iterable[Blink], now: float) -> Closures:
    left, right = OPEN
    for blink in blinks:
        closures = blink.closures(now)
        left, right = max(left, closures[0]), max(right, closures[1])
    return left, right


def _between(limits: tuple[float, float], seed: int, kind: str, number: int) -> float:
    least, most = limits
    return least + (most - least) * chance(seed, kind, number)


def _smooth(x: float) -> float:
    """A smooth step from 0 to 1."""
    return x * x * (3 - 2 * x)
