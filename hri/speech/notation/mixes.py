"""Mixes of letters and digits: gates, models, plates, R2D2, COVID-19."""

from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import text_before
from hri.speech.notation.rule import Match, Rule, Scan, rule

_PLATE = re.compile(
    r"(?i)\b(?:plate|license|registration|serial|confirmation|code|password|tag|locator)\b"
    r"[\w :']{0,20}$"
)
_PART = re.compile(r"\d+(?:\.\d+)?|[^\W\d_]+")
SPELT = 3
"""Capitals that are spelt; more are read as the voice reads capitals."""


def _mix(match: Match, scan: Scan) -> str:
    parts = _PART.findall(match[0])
    is_plate = _PLATE.search(text_before(match)) is not None
    words: list[str] = []
    for place, part in enumerate(parts):
        if part[0].isdecimal():
            words.append(_number(part, is_plate, is_first=not place))
        elif part == "s" and place == len(parts) - 1:
            words[-1] = say.plural(words[-1])
        else:
            words.append(_letters(part, is_plate))
    return " ".join(words)


def _letters(part: str, is_plate: bool) -> str:
    is_spelt = part.isupper() and (len(part) <= SPELT or is_plate)
    is_word = len(part) >= SPELT or (len(part) == 2 and re.search(r"[aeiou]", part))
    return part if is_word and not is_spelt else " ".join(part.upper())


def _number(digits: str, is_plate: bool, is_first: bool) -> str:
    if "." in digits:
        return say.number(digits)
    if is_plate:
        return say.by_digits(digits)
    if is_first and len(digits) == 4:
        return say.year(int(digits))
    return say.in_pairs(digits) if len(digits) > 2 or digits[0] != "0" else say.number(digits)


def _plate(match: Match, scan: Scan) -> str | None:
    """ABC 1234 of a plate."""
    return _mix(match, scan) if _PLATE.search(text_before(match)) else None


RULES: tuple[Rule, ...] = (
    rule(r"\d{1,6}(?:-?[A-Z]{1,5}(?:-?\d{1,6})?){1,4}(?!\w)", _mix),
    rule(r"\d{1,4}[a-wyz]\b(?!')", _mix),
    rule(
        r"(?!\d{1,6}x(?:\b|\d{1,6}x\d))\d{1,6}[A-Za-z]{1,12}(?:\d{1,6}[A-Za-z]{0,12}){0,6}(?!\w)",
        _mix,
    ),
)
NAMED: tuple[Rule, ...] = (
    rule(r"[A-Z]{3} \d{3,4}(?![\w-])", _plate),
    rule(r"[A-Za-z]{1,12}(?:-?\d{1,6}(?:\.\d{1,3}(?!\.?\d))?[A-Za-z]{0,12}){1,6}(?!\w)", _mix),
)
"""What begins with a letter."""
