"""Timers, alarms and reminders: what the robot promised to say, and when. Pure arithmetic on time.

A timer runs for a length of time, whatever becomes of the clock on the wall: when that is set back
an hour, or forth, the timer goes with it. Alarms and reminders are for a time on that clock.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from datetime import datetime, time, timedelta
from enum import StrEnum
from typing import Any

from hri.conversation.day import clock_words
from hri.core.clock import Uptime
from hri.core.errors import HriError
from hri.speech.grammar.dates import WEEKDAYS, resolve

MOST_ALARMS = 100
LONGEST_ABOUT = 200
"""Characters."""
FURTHEST = 10 * 365 * 86400.0
"""Seconds from now within which an alarm must be."""
JUMP = 1.0
"""Seconds by which the clock on the wall must leave the other to have been set."""
MINUTE, HOUR, DAY = 60, 3600, 86400
MORNING = "09:00"
"""When a day is meant without a time."""
ABOUT = "~"
"""Behind a time that stands for a part of the day: "tomorrow morning" is +1 09:00~."""
HALVES = {"am": 0, "pm": 12}
"""The hour at which each half of a day begins."""
EARLIEST = 7
"""The hour of another day from which on the one before noon is meant: seven, but not six."""
_WHEN = re.compile(
    rf"(?P<day>[+-][-\d]+|\d{{4}}-\d\d-\d\d|(?:(?:next|last) )?(?:{'|'.join(WEEKDAYS)}))?"
    r"(?:(?:^| )(?P<clock>\d\d:\d\d)(?P<half>\?|~|am|pm|))?"
)
"""What `meant` takes, but a length of time."""


class AlarmKind(StrEnum):
    """What people call it."""

    TIMER = "timer"
    ALARM = "alarm"
    REMINDER = "reminder"


@dataclass(frozen=True, slots=True)
class Instant:
    """A point in time on both clocks."""

    wall: float
    """Seconds since 1970, on the clock on the wall."""
    uptime: Uptime

    def jump_to(self, later: Instant) -> float:
        """Seconds by which the wall clock was set between the two; 0 where that is not known."""
        if self.uptime.boot != later.uptime.boot:
            return 0.0
        jump = later.wall - self.wall - (later.uptime.seconds - self.uptime.seconds)
        return jump if abs(jump) > JUMP else 0.0


@dataclass(frozen=True, slots=True)
class Alarm:
    """One promise."""

    id: int
    kind: AlarmKind
    due: float
    """Seconds since 1970."""
    about: str = ""
    """The name of a timer, or what the person is to be reminded of; empty for none."""
    length: float = 0.0
    """Seconds that a timer runs in all; 0 for what is due at a time on the wall."""
    has_begun: bool = False
    """Whether the robot has begun to say it."""

    @property
    def goes_with_the_clock(self) -> bool:
        """Whether it is for a length of time, not for a time of the day."""
        return self.length > 0


class TooManyAlarms(HriError):
    """There is no room for another one."""


class Alarms:
    """All that the robot has promised, and not said yet."""

    def __init__(
        self, alarms: Iterable[Alarm] = (), at: Instant | None = None, last_id: int = 0
    ) -> None:
        """`at` is when they were kept."""
        self._alarms = {alarm.id: alarm for alarm in alarms}
        self._at = at
        self.last_id = max([last_id, *self._alarms])

    def __iter__(self) -> Iterator[Alarm]:
        """The next one first."""
        return iter(sorted(self._alarms.values(), key=lambda alarm: (alarm.due, alarm.id)))

    @property
    def by_id(self) -> Mapping[int, Alarm]:
        """All of them."""
        return dict(self._alarms)

    def look(self, at: Instant) -> None:
        """Move timers along when the wall clock was set since the last look."""
        jump = self._at.jump_to(at) if self._at is not None else 0.0
        if jump:
            for alarm in self._alarms.values():
                if alarm.goes_with_the_clock:
                    self._alarms[alarm.id] = replace(alarm, due=alarm.due + jump)
        self._at = at

    def of(self, *kinds: AlarmKind, about: str = "") -> list[Alarm]:
        """Those of some kinds, and of a name where one is given, the next one first."""
        found = (alarm for alarm in self if alarm.kind in kinds)
        return [one for one in found if not about or is_about(one, about)]

    def due(self, at: Instant, *kinds: AlarmKind) -> list[Alarm]:
        """What is to be said now, the oldest first."""
        self.look(at)
        return [alarm for alarm in self.of(*kinds) if alarm.due <= at.wall]

    def add(self, kind: AlarmKind, due: float, about: str = "", length: float = 0.0) -> Alarm:
        """Promise something. Raises TooManyAlarms."""
        if len(self._alarms) >= MOST_ALARMS:
            raise TooManyAlarms(f"there are {MOST_ALARMS} already - cancel one first")
        self.last_id += 1
        return self.put(Alarm(self.last_id, kind, due, about[:LONGEST_ABOUT], length))

    def put(self, alarm: Alarm) -> Alarm:
        """Have this one, instead of the one of its id."""
        self._alarms[alarm.id] = alarm
        return alarm

    def remove(self, alarm: Alarm) -> None:
        """It was said, or is not wanted any more."""
        self._alarms.pop(alarm.id, None)


def is_about(alarm: Alarm, about: str) -> bool:
    """Whether people may mean it by this name: "pizza" is also the frozen pizza."""
    words = alarm.about.lower().split()
    return all(word in words for word in about.lower().split())


# --- when ---


def meant(text: str, at: datetime, earliest: int = EARLIEST) -> tuple[datetime, float]:
    """The time that a tag of `grammars/when.jsgf` means, and how long that is, in seconds.

    The length is 0 for a time on the wall. A time of the day that has passed is tomorrow's. Where
    neither morning nor evening was said, `07:00?`, it is the next of the two, and on another day
    the one within twelve hours from the hour `earliest`. A day alone is its morning. Raises
    ValueError for what is past, too far off, or not a time.
    """
    if text.startswith("in "):
        length = float(text.removeprefix("in "))
        due = at + timedelta(seconds=length)
    else:
        length, due = 0.0, _on_the_wall(text, at, earliest)
    if not 0 < (due - at).total_seconds() <= FURTHEST:
        raise ValueError(f"{due} is not a time to come within ten years")
    return due, length


def _on_the_wall(text: str, at: datetime, earliest: int) -> datetime:
    *before, clock = text.rsplit(" ", 1) if ":" in text else (text, MORNING)
    day = resolve(before[0], at.date()) if before else None
    first, half = time.fromisoformat(clock[:5]), clock[5:]
    is_open = half == "?"
    if half in HALVES:
        first = first.replace(hour=first.hour % 12 + HALVES[half])
    second = first.replace(hour=(first.hour + 12) % 24)
    is_either = is_open and first.hour <= 12
    if day is not None and day != at.date():
        is_first = not is_either or earliest <= first.hour < earliest + 12
        return datetime.combine(day, first if is_first else second)
    days = [at.date()] if day else [at.date(), at.date() + timedelta(days=1)]
    clocks = sorted((first, second)) if is_either else [first]
    found = (datetime.combine(one, clock) for one in days for clock in clocks)
    return next((when for when in found if when > at), datetime.combine(days[0], first))


def completed(value: Any, before: Any) -> Any:
    """A tag of `grammars/when.jsgf` that corrects one before it, with what it leaves open as it was
    there; anything else as it is.

    "Nine" behind "seven in the morning" is 09:00, "eight" behind "tomorrow evening" +1 20:00, and
    "Friday" behind "tomorrow at seven" is at seven; so is "tomorrow morning" behind "at seven".
    """
    now, then = _WHEN.fullmatch(str(value)), _WHEN.fullmatch(str(before))
    if now is None or then is None or not (value and before):
        return value
    is_kept = then["clock"] and (not now["clock"] or now["half"] == ABOUT != then["half"])
    first, second = (then, now) if is_kept else (now, then)
    clock, half = first.group("clock", "half")
    if half == "?" and second["clock"]:
        half = _half(second["clock"], second["half"]) if int(clock[:2]) <= 12 else half
    day = now["day"] or then["day"]
    return " ".join(filter(None, (day, f"{clock}{half}" if clock else "")))


def lacks_time(when: str) -> bool:
    """Whether a tag of `grammars/when.jsgf` is a day, or a part of one, without a time."""
    found = _WHEN.fullmatch(when)
    return found is not None and bool(found["day"]) and found["half"] in (None, ABOUT)


def _half(clock: str, half: str) -> str:
    """The half of the day of a time, "?" for either."""
    return half if half and half != ABOUT else "am" if int(clock[:2]) < 12 else "pm"


# --- in words ---


def length_words(seconds: float) -> str:
    """How long that is, as people say it: "an hour and 10 minutes", "90 seconds"."""
    rounded = round(seconds) if seconds < 10 * MINUTE else round(seconds / MINUTE) * MINUTE
    days, rest = divmod(max(rounded, 1), DAY)
    hours, rest = divmod(rest, HOUR)
    minutes, seconds = divmod(rest, MINUTE)
    counts = ((days, "day"), (hours, "hour"), (minutes, "minute"), (seconds, "second"))
    parts = [f"{count} {unit}{'s' if count != 1 else ''}" for count, unit in counts if count]
    return " and ".join(parts[:2])


def when_words(due: datetime, at: datetime) -> str:
    """When that is, seen from a day: "at 7:00 AM", "tomorrow at noon", "on Friday at 5:30 PM"."""
    clock = f"at {clock_words(due.hour, due.minute)}"
    days = (due.date() - at.date()).days
    if days == 0:
        return clock
    if days == 1:
        return f"tomorrow {clock}"
    return f"on {due:%A} {clock}" if 1 < days < 7 else f"on {due:%B} {due.day} {clock}"
