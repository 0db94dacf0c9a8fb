"""The weight of head and brows: a new expression takes a run-up, and the head settles into it.

They draw back before they go, and the head comes to rest from a little beyond: anticipation and
follow-through (Thomas & Johnston, "The Illusion of Life", 1981). Only goals are moved here: a
spring follows them, so nothing jumps.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hri.face.motion.spring import Values
from hri.face.regions import by_region

SECONDS = 0.08
"""How long a run-up is."""
SUDDEN = 0.2
"""Seconds of onset; an expression that sets in faster, such as surprise, has no time for one."""
USUAL = 0.35
"""Seconds of onset for which `BACK` is; the goal of a faster one lies less far behind."""
BACK = {"brows": 0.2, "head": 0.6}
"""How far the goal lies behind, as a share of the way: head and brows get 8 to 12 % back, and less
where the onset is slow."""
BEYOND = {"head": 0.1}
"""How far it lies beyond after that: the head gets 3 to 6 % beyond."""
SETTLED = 2.0
"""Onsets until the goal is the place itself."""


class RunUp:
    """That of one face."""

    def __init__(self, channels: Sequence[str]) -> None:
        """Behind the weights of the channels stands one more value, which takes no run-up."""
        self._held = np.append(by_region(channels, dict.fromkeys(BACK, 1.0)), 0.0)
        self._back = np.append(by_region(channels, BACK), 0.0)
        self._beyond = np.append(by_region(channels, BEYOND), 0.0)
        self._goal: Values = np.zeros(len(channels) + 1)
        self._way, self._began, self._onset = self._goal, 0.0, 0.0

    def begin(self, start: Values, goal: Values, onset: float, now: float) -> None:
        """A new expression is asked for, which sets in within `onset` seconds."""
        self._goal, self._way = goal, goal - start
        self._began, self._onset = now, onset

    def goal(self, goal: Values, now: float) -> Values:
        """Where to go now: straight to a goal that has changed since the beginning."""
        passed = now - self._began
        is_over = passed >= SETTLED * self._onset
        if goal is not self._goal or self._onset < SUDDEN or is_over:
            return goal
        shift = self._beyond
        if passed < SECONDS:
            shift = -(self._held + min(self._onset / USUAL, 1.0) * self._back)
        moved: Values = goal + self._way * shift
        return moved
