"""Idle acts: what the robot does by itself while nothing happens; `emotions/idle.toml`.

An act is a gesture, a sound, a look of the face, a small move of the base, or several of them. When
nothing has happened for long enough, one of those that fit is drawn by its weight; none is made
twice within its `again_s`. Acts with `on` are made when that event happens instead. Which ones are
drawn, and when, is a function of the seed: the same evening can be watched twice.

The times between acts are log-normal, as those between spontaneous movements of people at rest
tend to be; the median is `every_s`, and the spread is ours, set by eye.
"""

from __future__ import annotations

import math
import random
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.toml import Table, load_toml
from hri.emotion.display import EXPRESSIONS, LABELS
from hri.emotion.expressive_motion import ExpressiveMotion, read_motion
from hri.emotion.label import known_as
from hri.speech.vocalizations.in_text import check_sounds
from hri.speech.vocalizations.vocalization import load_sounds

FILE = "idle.toml"
MOST_ACTS = 300
AGAIN_S = 600.0
"""Seconds in which an act is not made twice, unless the file says otherwise."""
AFTER_S = 15.0
"""Seconds in which nothing has happened before an act, unless the file says otherwise."""
LONGEST_S = 86_400.0
SPREAD = 0.5
"""Of the logarithm of the times between acts."""
COMPANY = ("alone", "seen")
"""Whether no one is in sight, or someone is."""
_HOURS = 24


@dataclass(frozen=True, slots=True)
class IdleAct:
    """Something that the robot does by itself, and when."""

    name: str
    about: str
    gesture: str = ""
    """Of the face."""
    sound: str = ""
    """A text for the voice, such as "[hum soft]"."""
    show: str = ""
    """An expression, for `seconds`."""
    seconds: float = 3.0
    move: ExpressiveMotion | None = None
    """What the base does."""
    feelings: frozenset[str] = frozenset()
    """Labels of an emotion or a mood; empty for any."""
    company: str = ""
    """One of COMPANY; empty for both."""
    hours: tuple[int, int] | None = None
    """From the first hour of the day to before the second, which may be of the next day."""
    energy: tuple[float, float] = (0.0, 1.0)
    """Charge of the battery."""
    after_s: float = AFTER_S
    """Seconds in which nothing has happened."""
    again_s: float = AGAIN_S
    weight: float = 1.0
    """How often it is drawn, beside others."""
    on: str = ""
    """The event that it answers; empty for an act that comes by chance."""
    naps: bool = False
    """It dozes off, until something happens."""
    is_heard: bool = False
    """Whether it makes a sound, of the voice or of its gesture."""


@dataclass(frozen=True, slots=True)
class IdleActs:
    """A table of acts."""

    every_s: float
    """Median of the seconds from one act to the next."""
    acts: Mapping[str, IdleAct]


@dataclass(frozen=True, slots=True)
class Stillness:
    """How things stand while nothing happens."""

    still_s: float
    """Seconds in which nothing has happened."""
    feeling: str = "calm"
    """Label of an emotion or a mood."""
    energy: float = 1.0
    hour: int = 12
    is_seen: bool = False
    """Whether someone is in sight."""
    may_sound: bool = True
    may_move: bool = True


@dataclass
class Idler:
    """Draws acts for one robot."""

    table: IdleActs
    seed: int | str = 0
    done: dict[str, float] = field(default_factory=dict)
    """When each act was last made, seconds."""

    def __post_init__(self) -> None:
        self._random = random.Random(self.seed)
        self._next = -math.inf

    def choose(self, now: float, still: Stillness) -> IdleAct | None:
        """The act that is made now; None while it is not time, or none fits."""
        if now < self._next:
            return None
        fitting = [act for act in self.table.acts.values() if not act.on]
        return self._made(now, [act for act in fitting if self._fits(act, now, still)])

    def answer(self, event: str, now: float, still: Stillness) -> IdleAct | None:
        """The act that an event brings; None for most."""
        answers = [act for act in self.table.acts.values() if act.on and act.on == event]
        return self._made(now, [act for act in answers if self._fits(act, now, still)])

    def _made(self, now: float, fitting: Sequence[IdleAct]) -> IdleAct | None:
        if not fitting:
            return None
        (act,) = self._random.choices(fitting, [act.weight for act in fitting])
        self.done[act.name] = now
        wait = self._random.lognormvariate(math.log(self.table.every_s), SPREAD)
        self._next = now + act.seconds + wait
        return act

    def _fits(self, act: IdleAct, now: float, still: Stillness) -> bool:
        least, most = act.energy
        return (
            now - self.done.get(act.name, -math.inf) >= act.again_s
            and still.still_s >= act.after_s
            and (not act.feelings or still.feeling in act.feelings)
            and act.company in ("", COMPANY[still.is_seen])
            and least <= still.energy <= most
            and (act.hours is None or _is_between(still.hour, *act.hours))
            and (still.may_sound or not act.is_heard)
            and (still.may_move or act.move is None)
        )


def _is_between(hour: int, begin: int, end: int) -> bool:
    """Whether an hour lies in a part of the day that may go over midnight."""
    return (hour - begin) % _HOURS < (end - begin) % _HOURS


# --- the file ---


def idle_path() -> Path:
    """The file that is in use."""
    return paths.find("emotions", "idle")


def load_idle_acts(files: Iterable[Path] = (), gestures: Collection[str] | None = None) -> IdleActs:
    """The acts that come with `hri`, with those of the user's `emotions/idle.toml` and of other
    files, which add to them or replace them.

    `gestures` are those that the face can make; None does not check that. An act with `weight = 0`
    is never made. Raises HriError, or AuthoringError with the place.
    """
    every_s, acts = 30.0, dict[str, IdleAct]()
    ours = paths.house() / "emotions" / FILE
    for file in dict.fromkeys((ours, idle_path(), *files)):
        table = load_toml(file, "file of idle acts")
        table.number("schema", 1, minimum=1, maximum=1)
        every_s = table.number("every_s", every_s, minimum=1, maximum=LONGEST_S)
        for name, below in table.tables("act"):
            acts[name] = _read(name, below, gestures)
        table.finish()
        if len(acts) > MOST_ACTS:
            raise table.error("act", f"{len(acts)} acts", f"keep to {MOST_ACTS}")
    return IdleActs(every_s, {name: act for name, act in acts.items() if act.weight})


def _read(name: str, table: Table, gestures: Collection[str] | None) -> IdleAct:
    gesture, sound = _gesture(table, gestures), _sound(table)
    act = IdleAct(
        name,
        about=table.string("about"),
        gesture=gesture,
        sound=sound,
        show=table.string("show", "", among=("", *EXPRESSIONS)),
        seconds=table.number("seconds", 3.0, minimum=0.1, maximum=600),
        move=read_motion(table.table("move")) if "move" in table else None,
        feelings=_feelings(table),
        company=table.string("company", "", among=("", *COMPANY)),
        hours=_hours(table) if "hours" in table else None,
        energy=_energy(table) if "energy" in table else (0.0, 1.0),
        after_s=table.number("after_s", AFTER_S, minimum=0, maximum=LONGEST_S),
        again_s=table.number("again_s", AGAIN_S, minimum=0, maximum=LONGEST_S),
        weight=table.number("weight", 1.0, minimum=0, maximum=1000),
        on=table.string("on", ""),
        naps=table.flag("naps"),
        is_heard=bool(sound) or gesture in _gestures_with_sounds(),
    )
    table.finish()
    if not (act.gesture or act.sound or act.show or act.move):
        raise table.error(None, f'the act "{name}" does nothing', 'add such as gesture = "yawn"')
    return act


def _gesture(table: Table, gestures: Collection[str] | None) -> str:
    gesture = table.string("gesture", "")
    if gesture and gestures is not None and gesture not in gestures:
        remedy = did_you_mean(gesture, sorted(gestures))
        raise table.error("gesture", f'the face has no gesture "{gesture}"', remedy)
    return gesture


def _sound(table: Table) -> str:
    sound = table.string("sound", "")
    try:
        check_sounds(sound)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error("sound", what, remedy) from error
    return sound


def _gestures_with_sounds() -> frozenset[str]:
    return frozenset(sound.gesture for sound in load_sounds().values() if sound.gesture)


def _feelings(table: Table) -> frozenset[str]:
    names = table.strings("feelings", ())
    for name in names:
        if known_as(name) not in LABELS:
            raise table.error("feelings", f'no feeling "{name}"', did_you_mean(name, LABELS))
    return frozenset(map(known_as, names))


def _hours(table: Table) -> tuple[int, int]:
    begin, end = table.numbers("hours", count=2)
    if not all(0 <= hour <= _HOURS and hour == int(hour) for hour in (begin, end)) or begin == end:
        what = f"hours are {begin:g} and {end:g}"
        raise table.error("hours", what, "write two different whole hours, such as [22, 6]")
    return int(begin), int(end)


def _energy(table: Table) -> tuple[float, float]:
    least, most = table.numbers("energy", count=2)
    if not 0 <= least <= most <= 1:
        what = f"energy is {least:g} to {most:g}"
        raise table.error("energy", what, "write two rising numbers from 0 to 1")
    return least, most
