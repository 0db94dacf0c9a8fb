"""What the robot needs: company, play, rest, energy.

A need is a number from 0 (stilled) to 1 (pressing). It drifts to its resting level exponentially,

    q(t) = resting + (q0 - resting) exp(-t / tau)

and a stimulus stills a share of it, q (1 - share). What is above or below the resting level pulls
the mood, so that at rest the mood is the personality's baseline: after company the robot is
content for a while, and less so as it gets used to being alone. Energy has no drift: the battery
says what it is. Levels, times and pulls are ours, set by eye; that a need is stilled, open or
pressing, and moves the mood accordingly, is Kismet's (Breazeal 2003, Int. J. Human-Computer Studies
59:119-155).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.core.errors import did_you_mean
from hri.core.toml import Table


@dataclass(frozen=True, slots=True)
class Drive:
    """A row of the table."""

    name: str
    resting: float
    """Level that it drifts to, 0 to 1."""
    tau_s: float
    """Seconds in which the way there falls to 1/e; infinite: it stays as it is reported."""
    pleasure: float
    """Where a full need above the resting level would take the mood in the end, -1 to 1."""
    arousal: float
    dominance: float


DRIVES = (
    Drive("company", 0.6, 1800.0, -0.20, -0.05, -0.05),
    Drive("play", 0.5, 1200.0, -0.10, 0.05, 0.0),
    Drive("rest", 0.4, 7200.0, -0.05, -0.20, -0.05),
    Drive("energy", 0.0, math.inf, -0.15, -0.25, -0.20),
)
"""Energy is 1 minus the battery's level."""

STILLED = tuple(drive.name for drive in DRIVES if math.isfinite(drive.tau_s))
"""Those that a stimulus can still."""


def cause_of(drive: str) -> str:
    """Under which the ledger has what a drive does to the mood: "drive.company"."""
    return f"drive.{drive}"


def drives_in(table: Table) -> list[str]:
    """The keys of a table of an authored file that is keyed by drive.

    Raises AuthoringError for a name that is not among STILLED.
    """
    for name in table.data:
        if name not in STILLED:
            raise table.error(name, f'no drive "{name}" here', did_you_mean(name, STILLED))
    return list(table.data)
