"""Blinks of a living face: those of idle life, and those that something causes.

People blink when something changes: 71 % of blinks fall within 0.4 s of a communicative event (Ford
et al. 2013). So the begin and end of speech, a new expression and a large look elsewhere cause
blinks. Which ones do is drawn from a hash of seed, cause and time: the same events give the same
blinks.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hri.face.motion import idle
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
_MOMENT = 1e-6
"""Seconds, that rounding may cost."""
MOST = 60.0
"""Blinks a minute."""


class Blinks:
    """The lids of one face."""

    def __init__(self, settings: BlinkSettings, seed: int) -> None:
        self._settings = settings
        self._seed = seed
        self._slot = -1
        self._now = 0.0
        self._starts: list[float] = []

    def cause(self, why: str, now: float) -> None:
        """Something happened that may bring a blink: one of `CAUSES`."""
        moment = round(now * 1000)
        last = max(self._starts, default=-math.inf)
        if now - last > GAP and idle.chance(self._seed, why, moment) < CAUSES[why]:
            self._starts.append(now + DELAY * idle.chance(self._seed, "blink delay", moment))

    def closure(self, now: float, rate: float, *, shutting: bool = False) -> float:
        """How far the lids are shut, 0 to 1; `rate` is how often they are by themselves a minute.

        A blink that has begun is ended, whatever the rate becomes. While something shuts the eyes
        (`shutting`) none begins, and what has shut already does not open in between.
        """
        if shutting:
            self._starts = [self._held(start, now) for start in self._starts if start <= self._now]
            rate = 0.0
        self._now = now
        slot = math.floor(now / idle.BLINK_SLOT)
        if slot != self._slot:
            self._slot = slot
            length = idle.blink_length(self._settings)
            self._starts = [start for start in self._starts if now - start < GAP + length]
            drawn = idle.blink_starts(self._settings, self._seed, slot, min(rate, MOST))
            last = max(self._starts, default=-math.inf)
            self._starts += [start for start in drawn if start >= max(last + length, now - length)]
        return max((idle.lid_closure(self._settings, now - s) for s in self._starts), default=0.0)

    def _held(self, start: float, now: float) -> float:
        """When a blink would have begun that is shut until now."""
        shut = self._settings.close_s + self._settings.hold_s
        opens = self._now - start > shut + _MOMENT
        return start if opens else max(start, now - shut)
