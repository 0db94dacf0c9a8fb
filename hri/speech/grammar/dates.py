"""Which day a spoken date means: the texts of `grammars/date.jsgf` and the day it is today.

+3, -14             days from today
friday              the first such day after today
next friday         that day of the next week; weeks begin on Monday
last friday         that day of the last week
---21               the first such day of a month from today on (RFC 6350, 4.3.1)
--05-03             the first such day of a year from today on
2026-05-03          that day (ISO 8601)
"""

from __future__ import annotations

import re
from datetime import date, timedelta

WEEKDAYS = ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday")

FURTHEST_MONTHS = 12 * 8
"""February 29 comes back after eight years at the latest (1896 to 1904)."""

_DAYS = re.compile(r"[+-]\d{1,6}")
_WEEKDAY = re.compile(rf"(?:(next|last) )?({'|'.join(WEEKDAYS)})")
_DAY_OF_MONTH = re.compile(r"--(-|\d\d-)(\d\d)")


def resolve(text: str, today: date) -> date:
    """The day that a text means. Raises ValueError when it means none."""
    if _DAYS.fullmatch(text):
        try:
            return today + timedelta(days=int(text))
        except OverflowError as error:
            raise ValueError(f"{text} days from {today} is not a date") from error
    if match := _WEEKDAY.fullmatch(text):
        return _weekday(match[1], WEEKDAYS.index(match[2]), today)
    if match := _DAY_OF_MONTH.fullmatch(text):
        return _next_day(match[1].strip("-"), int(match[2]), today)
    return date.fromisoformat(text)


def _weekday(which: str | None, weekday: int, today: date) -> date:
    if which is None:
        return today + timedelta(days=(weekday - today.weekday() - 1) % 7 + 1)
    monday = today - timedelta(days=today.weekday())
    return monday + timedelta(days=weekday + (7 if which == "next" else -7))


def _next_day(month: str, day: int, today: date) -> date:
    """The first day of that number, in that month if one is given, from today on."""
    for later in range(FURTHEST_MONTHS + 1):
        years, index = divmod(today.month - 1 + later, 12)
        if month and index + 1 != int(month):
            continue
        try:
            found = date(today.year + years, index + 1, day)
        except ValueError:
            continue
        if found >= today:
            return found
    raise ValueError(
        f"no month has a day {day}" if not month else f"--{month}-{day:02} is not a day"
    )
