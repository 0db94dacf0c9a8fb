"""Timelines for `hri emotion simulate`: lines of stimuli, or TOML with goals, deeds and things.

# seconds stimulus intensity person
1.5 praise 0.8 Anna

[[event]]
t = 20
goal = "charger"
utility = 1.0
likelihood_before = 0.8
likelihood_after = 0.0
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.reading import read_text
from hri.core.signals import Stimulus
from hri.core.toml import Table, load_toml
from hri.emotion.appraisal import (
    LONGEST_NAME,
    SELF,
    UNKNOWN,
    ActionEvent,
    GoalEvent,
    ObjectEvent,
    OccEvent,
)

LATEST = 1e9
"""Seconds; a timeline of thirty years is long enough."""
MOST_EVENTS = 100_000


@dataclass(frozen=True, slots=True)
class Happening:
    """An event at a time."""

    time: float
    """Seconds, 0 or more."""
    what: Stimulus | OccEvent
    person: str | None = None
    """The cause of a stimulus; other kinds of events name their people themselves."""


def read_timeline(path: Path, known: Collection[str]) -> list[Happening]:
    """The events of a file in order of time; `known` are the names of the stimuli.

    Raises HriError when it cannot be read, AuthoringError with the place for what is wrong in it.
    """
    text = read_text(path, "event file")
    read = _read_toml if _is_toml(path, text) else _read_lines
    timeline = read(path, text, known)
    if len(timeline) > MOST_EVENTS:
        raise AuthoringError(Place(path), f"{len(timeline)} events", f"keep {MOST_EVENTS} at most")
    return sorted(timeline, key=lambda happening: happening.time)


def seconds(text: str) -> float | None:
    """A time of a timeline; None when the text is not a time."""
    value = _number(text)
    return value if value is not None and 0 <= value <= LATEST else None


def _is_toml(path: Path, text: str) -> bool:
    lines = (line.strip() for line in text.splitlines())
    first = next((line for line in lines if line and line[0] != "#"), "")
    return path.suffix == ".toml" or first.startswith("[")


def _read_lines(path: Path, text: str, known: Collection[str]) -> list[Happening]:
    """Empty lines and what follows `#` are skipped."""
    timeline = []
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.partition("#")[0].split()
        if words:
            timeline.append(_read_line(words, Place(path, number), known))
    return timeline


def _read_line(words: list[str], place: Place, known: Collection[str]) -> Happening:
    if not 2 <= len(words) <= 4:
        remedy = "write: seconds stimulus intensity person, such as: 1.5 praise 0.8 Anna"
        raise AuthoringError(place, f"{len(words)} words", remedy)
    time, name, strength = seconds(words[0]), words[1], [*words, "1"][2]
    if time is None:
        remedy = "write seconds from 0 on, such as 1.5"
        raise AuthoringError(place, f'"{words[0]}" is not a time', remedy)
    if name not in known:
        raise AuthoringError(place, f'no stimulus "{name}"', did_you_mean(name, known))
    intensity = _number(strength)
    if intensity is None or not 0 <= intensity <= 1:
        raise AuthoringError(
            place, f'"{strength}" is not an intensity', "write a number from 0 to 1"
        )
    person = words[3] if len(words) == 4 else None
    if person is not None and len(person) > LONGEST_NAME:
        what = f"the person has {len(person)} letters"
        raise AuthoringError(place, what, f"give them 1 to {LONGEST_NAME}")
    return Happening(time, Stimulus(name, intensity), person)


def _number(text: str) -> float | None:
    """A finite number, None when it is anything else."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _read_toml(path: Path, text: str, known: Collection[str]) -> list[Happening]:
    root = load_toml(path, "event file")
    root.number("schema", 1, minimum=1, maximum=1)
    timeline = [_read_entry(entry, known) for entry in root.array("event")]
    root.finish()
    return timeline


def _read_entry(table: Table, known: Collection[str]) -> Happening:
    kinds = [kind for kind in _KINDS if kind in table]
    if len(kinds) != 1:
        what = "an event with two kinds" if kinds else "an event without a kind"
        raise table.error(None, what, f"name one of {', '.join(_KINDS)}") from None
    time = table.number("t", minimum=0, maximum=LATEST)
    happening = _KINDS[kinds[0]](table, time, known)
    table.finish()
    return happening


def _stimulus(table: Table, time: float, known: Collection[str]) -> Happening:
    name = table.string("stimulus", among=tuple(known))
    intensity = table.number("intensity", 1.0, minimum=0, maximum=1)
    return Happening(time, Stimulus(name, intensity), _optional_name(table, "person"))


def _goal(table: Table, time: float, known: Collection[str]) -> Happening:
    event = GoalEvent(
        goal=_name(table, "goal"),
        utility=table.number("utility", minimum=-1, maximum=1),
        likelihood_before=table.number("likelihood_before", UNKNOWN, minimum=0, maximum=1),
        likelihood_after=table.number("likelihood_after", minimum=0, maximum=1),
        owner=_optional_name(table, "owner"),
        liking=table.number("liking", None, minimum=-1, maximum=1),
        agent=_optional_name(table, "agent"),
        praiseworthiness=table.number("praiseworthiness", None, minimum=-1, maximum=1),
    )
    return Happening(time, event)


def _action(table: Table, time: float, known: Collection[str]) -> Happening:
    event = ActionEvent(
        action=_name(table, "action"),
        praiseworthiness=table.number("praiseworthiness", minimum=-1, maximum=1),
        agent=_optional_name(table, "agent") or SELF,
    )
    return Happening(time, event)


def _object(table: Table, time: float, known: Collection[str]) -> Happening:
    appeal = table.number("appeal", minimum=-1, maximum=1)
    return Happening(time, ObjectEvent(_name(table, "object"), appeal))


_KINDS = {"stimulus": _stimulus, "goal": _goal, "action": _action, "object": _object}


def _optional_name(table: Table, key: str) -> str | None:
    return _name(table, key) if key in table else table.string(key, None)


def _name(table: Table, key: str) -> str:
    name: str = table.string(key)
    if not 0 < len(name) <= LONGEST_NAME:
        raise table.error(key, f"{key} has {len(name)} letters", f"give it 1 to {LONGEST_NAME}")
    return name
