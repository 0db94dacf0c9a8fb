"""What became of a talk, turn by turn: JSON lines for programs, TOML for people who judge it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from itertools import groupby
from pathlib import Path
from typing import Any

from benchmarks.conversation.talks import NOT_FOR_IT
from hri.core.errors import HriError
from hri.core.reading import parse_json, read_text

ANSWERS_WITHIN = 5.0
"""Seconds from a turn within which words are an answer to it; later ones are the robot's idea."""
LARGEST = 50_000_000
"""Bytes of a transcript."""
STILL = "still "
"""How a motion begins that had begun before the turn."""
NOTHING = "(nothing)"


@dataclass(frozen=True, slots=True)
class Words:
    """Something that the robot said."""

    at: float
    """Seconds from the turn."""
    text: str
    heard: str
    """As much of it as was said before something cut it."""

    def told(self) -> str:
        later = f"({self.at:.0f} s later) " if self.at > ANSWERS_WITHIN else ""
        return later + self.heard + "..." * (self.heard != self.text)


@dataclass(frozen=True, slots=True)
class Line:
    """A turn and all that the robot did until the next one."""

    id: str
    """Of its talk, and its number from 1: "open/busy/2/1"."""
    writer: str
    situation: str
    time: float
    """Seconds from the start of the robot."""
    say: str
    expects: str
    kind: str
    rule: str = ""
    """What it was understood as; empty when it was rejected."""
    tags: dict[str, Any] = field(default_factory=dict)
    why_not: str = ""
    """The reason of a rejection, and what was nearest."""
    said: tuple[Words, ...] = ()
    moved: tuple[str, ...] = ()
    """Legs of its way, see `legs`."""
    showed: tuple[str, ...] = ()
    """Expressions that it was made to show, and gestures."""

    @property
    def talk(self) -> str:
        return self.id.rpartition("/")[0]

    @property
    def is_answered(self) -> bool:
        """Whether it said something soon, or began to move."""
        has_moved = any(not leg.startswith(STILL) for leg in self.moved)
        return has_moved or any(words.at <= ANSWERS_WITHIN for words in self.said)

    @property
    def is_for_it(self) -> bool:
        """Whether it is spoken to."""
        return not self.expects.startswith(NOT_FOR_IT)

    def answered(self) -> str:
        """What a person sees and hears of it, in words."""
        words = [words.told() for words in self.said if words.heard]
        shown = [f"showed {what}" for what in self.showed]
        deeds = "; ".join((*self.moved, *shown))
        return " ".join([*words, f"({deeds})" if deeds else ""]).strip() or NOTHING


def write(lines: Iterable[Line], file: Path) -> None:
    """Write a transcript, one line of JSON a turn; the folder is made."""
    file.parent.mkdir(parents=True, exist_ok=True)
    text = "".join(json.dumps(asdict(line), ensure_ascii=False) + "\n" for line in lines)
    file.write_text(text, encoding="utf-8")


def read(file: Path) -> list[Line]:
    """Read a transcript. Raises HriError for any other file."""
    text = read_text(file, "transcript", LARGEST)
    try:
        return [_line(parse_json(line)) for line in text.splitlines() if line.strip()]
    except (AttributeError, TypeError, KeyError, ValueError) as error:
        raise HriError(f"{file} is not a transcript: {error} - play the talks again") from error


def read_all(files: Sequence[Path]) -> list[Line]:
    """Read transcripts of different talks. Raises HriError, also for a turn that two have."""
    lines: dict[str, Line] = {}
    for file in files:
        for line in read(file):
            if line.id in lines:
                remedy = "judge transcripts of the same talks one by one"
                raise HriError(f"{file} has the turn {line.id} a second time - {remedy}")
            lines[line.id] = line
    return list(lines.values())


def _line(data: dict[str, Any]) -> Line:
    said = tuple(Words(**words) for words in data.pop("said"))
    moved, showed = (tuple(data.pop(name)) for name in ("moved", "showed"))
    return Line(**data, said=said, moved=moved, showed=showed)


def for_readers(lines: Sequence[Line]) -> Iterator[str]:
    """The form that a reader fills in: situation, said, answered, and an empty verdict."""
    for _, talk in groupby(lines, lambda line: line.talk):
        for number, line in enumerate(talk):
            if not number:
                yield f"# {line.situation}\n"
            yield f"[{_quoted(line.id)}]"
            yield f"said = {_quoted(line.say)}"
            yield f"answered = {_quoted(line.answered())}"
            yield 'verdict = ""\n'


def _quoted(text: str) -> str:
    """A text as a basic string of TOML, whose escapes are those of JSON."""
    return json.dumps(text, ensure_ascii=False)
