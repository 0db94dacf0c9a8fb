"""Times of the day, and what is written like one: ratios, verses, laps."""

from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.rule import Match, Rule, Scan, amount

_RATIO_BEFORE = re.compile(
    r"(?i)\b(?:ratio|scale|odds|aspect|mix(?:ed)?|proportion|dilut\w+|won|lost|score[ds]?|beat"
    r"|lead|led)\b[^.!?]{0,40}$"
)
_RATIO_BEHIND = re.compile(r" (?:ratio|scale|odds|mix|aspect|dilution|lead|win|victory|favorite)\b")
_BOOK = re.compile(
    r"\b(?:Genesis|Exodus|Psalms?|Proverbs|Isaiah|Matthew|Mark|Luke|John|Acts|Romans|Corinthians"
    r"|Hebrews|James|Revelation) $"
)


def _half_day(letter: str | None, match: Match) -> str:
    """A.M. or P.M., with its period where that ends the sentence, too."""
    if not letter:
        return ""
    ends = match[0].endswith(".") and not text_after(match).strip(" \"')")
    return f" {letter.upper()} M{'.' if ends else ''}"


def _time(match: Match, scan: Scan) -> str | None:
    """(7):(30) (p)m."""
    hour, minute, half = int(match[1]), int(match[2]), match[3] or match[4]
    if hour > 24 or minute > 59:
        return None
    said = say.cardinal(hour)
    if not half:
        if _RATIO_BEFORE.search(text_before(match)) or _RATIO_BEHIND.match(text_after(match)):
            return f"{said} to {say.cardinal(minute)}"
        if _BOOK.search(text_before(match)):
            return f"{said} {say.cardinal(minute)}"
        if not minute:
            return f"{said} o'clock" if 0 < hour < 13 else f"{said} hundred"
    return said + (_minutes(minute) if minute else "") + _half_day(half, match)


def _minutes(number: int) -> str:
    return f" {'oh ' if number < 10 else ''}{say.cardinal(number)}"


def _with_seconds(match: Match, scan: Scan) -> str | None:
    """(1):(05):(30).(5) (p)m."""
    hour, minute, second = int(match[1]), int(match[2]), int(match[3])
    if minute > 59 or second > 59:
        return None
    said = say.cardinal(hour) + (_minutes(minute) if minute else "")
    said += f" and {say.cardinal(second)}"
    said += f" point {say.by_digits(match[4])}" if match[4] else ""
    said += " second" if second == 1 and not match[4] else " seconds"
    return said + _half_day(match[5] or match[6], match)


def _lap(match: Match, scan: Scan) -> str:
    """(1):(23).(45)."""
    return f"{say.cardinal(int(match[1]))}{_minutes(int(match[2]))} point {say.by_digits(match[3])}"


def _hour(match: Match, scan: Scan) -> str | None:
    """(7) (p)m."""
    if int(match[1]) > 24:
        return None
    return say.cardinal(int(match[1])) + _half_day(match[2] or match[3], match)


_HALF = (
    r"(?:\s?([AaPp])\.?[Mm]\b(?:\.(?=\s*(?:[^\sA-Z\"')\]]|$))|\.(?=\s+[A-Z])|(?!\.))"
    r"|\s?([AaPp])\.[Mm]\b\.?)"
)
RULES: tuple[Rule, ...] = (
    amount(rf"(\d{{1,2}}):(\d\d):(\d\d)(?:\.(\d{{1,3}}))?{_HALF}?(?![\w:])", _with_seconds),
    amount(r"(\d{1,2}):([0-5]\d)\.(\d{1,3})(?![\w:])", _lap),
    amount(rf"(\d{{1,2}}):(\d\d){_HALF}?(?![\w:])", _time),
    amount(rf"(\d{{1,2}})\.([0-5]\d){_HALF}(?!\w)", _time),
    amount(rf"(\d{{1,2}}){_HALF}(?!\w)", _hour),
)
