"""Conversations that writers made up: TOML files of situations and of what a person says there.

    writer = "busy"

    [[talk]]
    situation = "a man late for work, who hunts for his keys"
    turns = [
      { say = "have you seen my keys", expects = "says whether it knows", kind = "follow-up" },
    ]

A turn without a `kind` is plain. One whose `expects` begins with "stays silent" is not for the
robot. The file of a toy robot lists its intents instead, each with sentences that ask for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import HriError, did_you_mean
from hri.core.toml import Table, load_toml

HERE = Path(__file__).parent
SETS = ("open", "aside", "toy")
"""Open talks may be read by whoever improves the companion; those aside only measure it."""
TOY = HERE / "toy_robot.toml"
PLAIN = "plain"
"""The kind of a turn that names none."""
NOT_FOR_IT = "stays silent"
"""How the expectation of a turn begins that is not said to the robot."""


@dataclass(frozen=True, slots=True)
class Turn:
    """What a person says, and what a sensible companion does then."""

    say: str
    expects: str = ""
    kind: str = PLAIN


@dataclass(frozen=True, slots=True)
class Talk:
    """One conversation with a robot that was just started."""

    id: str
    """Set, writer and number from 1: "open/busy/2"."""
    writer: str
    situation: str
    turns: tuple[Turn, ...]


def load_talks(name: str, folder: Path = HERE / "talks", writer: str = "") -> list[Talk]:
    """The talks of a set, of one writer or of all.

    Raises HriError where there are none, AuthoringError for a wrong file.
    """
    if name == "toy":
        return load_intents(TOY)
    files = sorted((folder / name).glob("*.toml"))
    talks = [talk for file in files for talk in read_talks(file, name)]
    if not talks:
        raise HriError(f"no talks in {folder / name} - copy files of talks there")
    writers = sorted({talk.writer for talk in talks})
    if writer and writer not in writers:
        raise HriError(f'no writer is "{writer}" - {did_you_mean(writer, writers)}')
    return [talk for talk in talks if writer in ("", talk.writer)]


def read_talks(file: Path, name: str) -> list[Talk]:
    """The talks of one writer in a set of that name. Raises AuthoringError, or HriError."""
    root = load_toml(file, "file of talks")
    writer = root.string("writer")
    talks = [
        Talk(f"{name}/{writer}/{number}", writer, table.string("situation"), _turns(table))
        for number, table in enumerate(root.array("talk"), 1)
    ]
    root.finish()
    return talks


def _turns(talk: Table) -> tuple[Turn, ...]:
    turns = []
    for table in talk.array("turns"):
        kind = table.string("kind", PLAIN)
        turns.append(Turn(table.string("say"), table.string("expects"), kind))
        table.finish()
    talk.finish()
    return tuple(turns)


def load_intents(file: Path) -> list[Talk]:
    """A talk for each sentence that asks for an intent; its kind is the intent.

    Raises AuthoringError, or HriError.
    """
    intents = load_toml(file, "file of intents").table("intents")
    return [
        Talk(f"toy/{intent}/{number}", "toy", "", (Turn(say, kind=intent),))
        for intent in intents.data
        for number, say in enumerate(intents.strings(intent), 1)
    ]


def joined(talks: Sequence[Talk]) -> tuple[Turn, ...]:
    """The turns of several talks, one after the other."""
    return tuple(turn for talk in talks for turn in talk.turns)
