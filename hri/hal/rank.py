"""The ranks of those who steer a base, the most important first."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from hri.core.errors import HriError


class Rank(StrEnum):
    """What a command is worth against others; the first two are the supervisor's own."""

    LATCH = "e-stop"
    REFLEX = "reflex"
    TELEOP = "teleop"
    """A person with keys or a stick."""
    BEHAVIORS = "behaviors"
    """A network, by what its behaviors want."""
    TASKS = "tasks"
    """A task or a script, whether by a motion of the drive or through the command gate."""
    NOBODY = "nobody"
    """Nobody asks for anything: the base rests, and gives way to all."""


WRITERS = (Rank.TELEOP, Rank.BEHAVIORS, Rank.TASKS)
"""The ranks that may command, the most important first."""


@dataclass(frozen=True, slots=True)
class Writer:
    """Someone who steers."""

    owner: object
    """Writers with the same owner are one."""
    name: str
    """For messages: 'the behavior "drive"'."""
    rank: Rank


PROGRAM = Writer(None, "the program", Rank.TASKS)
"""Whoever calls a drive without saying who it is: tasks and scripts. Their commands replace each
other."""


class Outranked(HriError):
    """Someone else steers the drive, and is not to be interrupted."""
