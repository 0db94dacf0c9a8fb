"""Dates, and names of days and months."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re
from collections.abc import Mapping

from hri.speech.notation import number_words as say
from hri.speech.notation.abbreviations import DAY_OF, DAYS, MONTH_OF, MONTHS
from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.quantities import any_of
from hri.speech.notation.rule import Match, Rule, Scan, amount, rule

_MONTH = any_of(MONTH_OF)
_SHORT_MONTH = any_of(name for name in MONTH_OF if name.capitalize() not in MONTHS)
_SHORT_DAY = any_of(name for name in DAY_OF if name not in DAYS)
_DAYS = DAY_OF | {
    written: day for name, day in DAY_OF.items() for written in (name.upper(), name.lower())
}
"""The days in any case, as they stand in spans."""
_OF_DAY = (
    rf",? (?:\d|at\b|to\b|and\b|morning|noon|afternoon|evening|night|(?:{_MONTH})\b)|,|\)| ?[-–]"
)
"""What stands behind the short name of a day: "Sun." may be the star."""
_CENTURY = 40
"""Years of two digits up to this one are of the 21st century."""


def _year(written: str) -> str:
    number = int(written)
    if len(written) == 2:
        number += 1900 if number > _CENTURY else 2000
    return say.year(number)


def _date(year: str, month: str, day: str) -> str | None:
    if not (1 <= int(month) <= 12 and 1 <= int(day) <= 31):
        return None
    return f"{MONTHS[int(month) - 1]} {say.ordinal(int(day))}, {_year(year)}"


def _american(match: Match, scan: Scan) -> str | None:
    """Month, day and year; where that is not a date, the European order."""
    first, second, year = match[1], match[3], match[4]
    return _date(year, first, second) or _date(year, second, first)


def _month_day(match: Match, scan: Scan) -> str | None:
    """(Nov)(24)(26)(2026)."""
    month, first, last, year = match.groups()
    if not 1 <= int(first) <= 31 or re.match(r":\d|[%°]", text_after(match)):
        return None
    said = f"{MONTH_OF[month]} {say.ordinal(int(first))}"
    if last:
        said += f" to {say.ordinal(int(last))}"
    return said + (f", {_year(year)}" if year else "")


def _day_month(match: Match, scan: Scan) -> str | None:
    """(24)(Nov)(2026)."""
    day, month, year = match.groups()
    if not 1 <= int(day) <= 31:
        return None
    the = "" if re.search(r"(?i)\bthe $", text_before(match)) else "the "
    said = f"{the}{say.ordinal(int(day))} of {MONTH_OF[month]}"
    return said + (f", {_year(year)}" if year else "")


def _stamp(match: Match, scan: Scan) -> str | None:
    """(2026)-(01)-(02)T(07):(30):00(Z)."""
    day, hour, minute = _date(match[1], match[2], match[3]), int(match[4]), int(match[5])
    rest = f"{'oh ' if minute < 10 else ''}{say.cardinal(minute)}" if minute else "hundred"
    zone = " U T C" if match[6] else ""
    return f"{day}, {say.cardinal(hour)} {rest}{zone}" if day and minute < 60 else None


def _span(names: Mapping[str, str]) -> Rule:
    """From one name to another: "Mon-Fri"."""
    name = rf"({any_of(names)})\b"

    def words(match: Match, scan: Scan) -> str | None:
        if match[2].strip() and re.match(r" \d{1,2}\b", text_after(match)):
            return None  # "Nov - Dec 2"
        joint = "" if "/" in match[2] else "to "
        return f"{names[match[1]]} {joint}{names[match[3]]}"

    return rule(rf"{name}\.?( ?[-–—/] ?){name}(?:\.(?! ?$))?", words)


RULES: tuple[Rule, ...] = (
    amount(
        r"(\d{4})-(\d{2})-(\d{2})T(\d{2}):(\d{2})(?::\d{2}(?:\.\d{1,9})?)?(Z)?(?![\w:])", _stamp
    ),
    amount(r"(\d{4})[-/](\d{1,2})[-/](\d{1,2})(?![\w/-])", lambda m, s: _date(m[1], m[2], m[3])),
    amount(r"(\d{1,2})([/-])(\d{1,2})\2(\d{4}|\d{2})(?![\w/-])", _american),
    amount(r"(\d{1,2})\.(\d{1,2})\.(\d{4})(?![\w.]\d|\w)", lambda m, s: _date(m[3], m[2], m[1])),
    amount(
        rf"(\d{{1,2}})(?:st|nd|rd|th)?(?: of)?[ -]({_MONTH})\b\.?(?:,?[ -](\d{{4}})\b)?(?!\w)",
        _day_month,
    ),
)
NAMED: tuple[Rule, ...] = (
    _span(_DAYS),
    _span(MONTH_OF),
    amount(
        rf"({_MONTH})\b(?:\.? |-)(\d{{1,2}})(?:st|nd|rd|th)?"
        r"(?: ?[-–] ?(\d{1,2})(?:st|nd|rd|th)?)?"
        r"(?:(?:,? |-)(\d{4})\b(?! [a-z]+s\b))?(?![\d/]|,\d|\.\d)\b",
        _month_day,
    ),
    rule(rf"({_SHORT_MONTH})(?:\.(?! *$)|(?=,? \d{{4}}\b))", lambda m, s: MONTH_OF[m[1]]),
    rule(
        rf"({_SHORT_DAY})\b(?:(?=, (?:{_MONTH})\b|, \d| \d{{1,2}}(?::|[ap]m))"
        rf"|\.(?={_OF_DAY}))",
        lambda m, s: DAY_OF[m[1]],
    ),
)
"""What begins with a name."""
