"""Whether there is floor below: redundant votes of flags, raw light and neighbors.

An infrared cliff sensor counts the light that its own lamp throws back from the floor. The base
derives a flag from it with its own threshold; the count itself, compared with recent counts of the
floor, is a second vote, and the neighboring sensors are a third.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from hri.drive.bases.protocol import BaseReport

AROUND = ("left", "front_left", "front_right", "right")
"""Cliff sensors in the order in which they sit; neighbors vote for each other."""
DARK = 15
"""Counts of a sensor's 12 bits below which nothing throws its light back."""
DIM = 0.4
"""Share of what the floor counted lately below which it may end here, or be carpet."""
LEARNING = 0.02
"""Share of each report in what is known of the floor: after 0.7 s at 15 ms it is another floor."""
ENOUGH = 2
"""Votes that make an edge; the flag or darkness alone are enough, for a doubt counts against us."""


class Light(Enum):
    """What comes back from the floor."""

    LIT = "lit"
    DIM = "dim"
    DARK = "dark"
    UNKNOWN = "unknown"


class Floor:
    """Learns how the floor looks to each sensor."""

    def __init__(self) -> None:
        self._levels: dict[str, float] = {}

    def step(self, report: BaseReport) -> dict[str, Light]:
        """How each sensor sees the floor, by place."""
        return {place: self._seen(place, report) for place in report.cliffs}

    def _seen(self, place: str, report: BaseReport) -> Light:
        signal = report.cliff_signals.get(place)
        if signal is None:
            return Light.UNKNOWN
        if signal <= DARK:
            return Light.DARK
        level = self._levels.get(place, float(signal))
        if not report.cliffs[place]:
            self._levels[place] = level + (signal - level) * LEARNING
        return Light.DIM if signal < DIM * level else Light.LIT


def edges(flags: Mapping[str, bool], lights: Mapping[str, Light]) -> list[str]:
    """The places where the votes say that the floor ends."""
    return [place for place in flags if _votes(place, flags, lights) >= ENOUGH]


def _votes(place: str, flags: Mapping[str, bool], lights: Mapping[str, Light]) -> int:
    doubts = sum(
        flags.get(next_to, False) or lights.get(next_to) in (Light.DIM, Light.DARK)
        for next_to in _neighbors(place)
    )
    light = lights.get(place, Light.UNKNOWN)
    own = {Light.DARK: 2, Light.DIM: 1}.get(light, 0)
    if own == 0 and not flags[place]:
        return 0  # neighbors alone speak for themselves
    return 2 * flags[place] + own + min(1, doubts)


def _neighbors(place: str) -> tuple[str, ...]:
    if place not in AROUND:
        return ()
    at = AROUND.index(place)
    return AROUND[max(0, at - 1) : at] + AROUND[at + 1 : at + 2]
