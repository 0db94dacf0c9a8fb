"""What an assistant may do: three kinds of tools, and a permission for each more of them."""

from __future__ import annotations

from enum import Enum, IntEnum


class Kind(Enum):
    """What a tool does to the world."""

    READS = "reads"
    STOPS = "stops"
    """It ends motion, which is always allowed."""
    EXPRESSES = "expresses"
    """It speaks, shows something on the face, or keeps a draft; nothing moves."""
    MOVES = "moves"
    """It may drive the base, or run what may."""


class Permission(IntEnum):
    """How far it goes; each one includes those before it."""

    READING = 0
    SPEAKING = 1
    MOVING = 2

    def allows(self, kind: Kind) -> bool:
        """Whether a tool of that kind may be used."""
        return self >= _NEEDED[kind]


_NEEDED = {
    Kind.READS: Permission.READING,
    Kind.STOPS: Permission.READING,
    Kind.EXPRESSES: Permission.SPEAKING,
    Kind.MOVES: Permission.MOVING,
}
FLAGS = {Permission.SPEAKING: "--allow-speaking", Permission.MOVING: "--allow-moving"}
"""The options of `hri mcp` that give a permission."""


def flag_for(kind: Kind) -> str:
    """The option with which tools of that kind may be used; empty where none is needed."""
    return FLAGS.get(_NEEDED[kind], "")
