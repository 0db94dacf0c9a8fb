"""Who steers a drive: one writer at a time, and the more important one before the others.

Pure: times are arguments, in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from hri.core.errors import HriError

HOLD = 0.5
"""Seconds for which a velocity holds the helm: as long as a base may follow it without a word."""


class Rank(StrEnum):
    """What a command is worth against others, the most important first."""

    TELEOP = "teleop"
    """A person with keys or a stick."""
    BEHAVIORS = "behaviors"
    """A network, by what its behaviors want."""
    TASKS = "tasks"
    """A task or a script, whether by a motion of the drive or through the command gate."""
    NOBODY = "nobody"
    """A gate that nobody asks for anything: it keeps the base at rest, and gives way to all."""


_ORDER = list(Rank)


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


class Helm:
    """Who steers one drive. Not safe to use from several threads."""

    def __init__(self, drive: str) -> None:
        """`drive` is its id, for messages."""
        self._drive = drive
        self._claims: list[Writer] = []
        self._holder: Writer | None = None
        self._until = -math.inf

    def claim(self, writer: Writer) -> None:
        """Be the only one of that rank until `leave`. Raises HriError when there is one already."""
        for other in self._claims:
            if other.rank is writer.rank and other.owner is not writer.owner:
                raise HriError(
                    f"{self._drive}: {other.name} steers it already, with the same rank "
                    f"({other.rank}) as {writer.name} - stop one of them, or give it another rank"
                )
        self._claims.append(writer)

    def leave(self, writer: Writer) -> None:
        """Give up what was claimed; who claimed nothing does nothing."""
        self._claims = [other for other in self._claims if other.owner is not writer.owner]
        if self._is_held_by(writer):
            self.let_go()

    def rank(self, now: float) -> Rank:
        """The rank of who steers."""
        return self._holder.rank if self._holder and now <= self._until else Rank.NOBODY

    def is_free_for(self, writer: Writer, now: float) -> bool:
        """Whether nobody else steers."""
        return self._holder is None or now > self._until or self._is_held_by(writer)

    def take(self, writer: Writer, now: float, until: float) -> None:
        """Steer until a time, and longer with each call.

        Raises Outranked while another writer steers who is not less important.
        """
        holder = self._holder
        is_free = self.is_free_for(writer, now)
        if holder is not None and not is_free and not _goes_before(writer, holder):
            raise Outranked(
                f"{self._drive}: {holder.name} steers it (rank {holder.rank}), which "
                f"{writer.name} ({writer.rank}) may not interrupt - wait until it has ended"
            )
        self._holder = None if writer.rank is Rank.NOBODY else writer
        self._until = until

    def let_go(self) -> None:
        """Let nobody steer."""
        self._holder = None

    def _is_held_by(self, writer: Writer) -> bool:
        return self._holder is not None and self._holder.owner is writer.owner


def _goes_before(one: Writer, other: Writer) -> bool:
    return _ORDER.index(one.rank) < _ORDER.index(other.rank)
