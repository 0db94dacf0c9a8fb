"""How the base moves as a feeling begins to show: `[motion]` of `emotions/display.toml`.

People read feelings from where and how a robot moves that has no face (M. Saerbeck and
C. Bartneck, "Perception of affect elicited by robot motion", HRI 2010). The moves are short, on the
spot or back over ground that the base has just come over.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.core.toml import Table

LARGEST_TURN = 45.0
"""Degrees of one turn, at most."""
MOST_TURNS = 8
FARTHEST = 0.2
"""Meters that it backs off at most: it does not see where it goes."""
LONGEST_PAUSE = 10.0


@dataclass(frozen=True, slots=True)
class ExpressiveMotion:
    """What the base does for one feeling."""

    above: float
    """The intensity of the feeling from which it is done, 0 to 1."""
    turns: tuple[float, ...] = ()
    """Radians, one after another; positive is to the left."""
    backs_off: float = 0.0
    """Meters, before it turns."""
    pace: float = 1.0
    """Share of the usual speed."""
    pause_s: float = 0.0
    """Seconds between one turn and the next."""


def read_motion(table: Table) -> ExpressiveMotion:
    """The motion of an entry such as `{ above = 0.5, turns = [8, -16, 8] }`, in degrees.

    Raises AuthoringError with the place.
    """
    turns = table.numbers("turns", ())
    if len(turns) > MOST_TURNS or any(abs(turn) > LARGEST_TURN for turn in turns):
        what = f"turns is {list(turns)}"
        remedy = (
            f"write up to {MOST_TURNS} turns from -{LARGEST_TURN:g} to {LARGEST_TURN:g} degrees"
        )
        raise table.error("turns", what, remedy)
    motion = ExpressiveMotion(
        above=table.number("above", minimum=0.05, maximum=1.0),
        turns=tuple(map(math.radians, turns)),
        backs_off=table.number("backs_off", 0.0, minimum=0.0, maximum=FARTHEST),
        pace=table.number("pace", 1.0, minimum=0.1, maximum=1.0),
        pause_s=table.number("pause_s", 0.0, minimum=0.0, maximum=LONGEST_PAUSE),
    )
    table.finish()
    return motion
