"""Fractions, and other numbers with a slash: dates, ratings, 24/7."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.abbreviations import MONTHS
from hri.speech.notation.context import SERVICES, text_after, text_before
from hri.speech.notation.quantities import NUMBER, POINTED
from hri.speech.notation.rule import Match, Rule, Scan, amount

SIGNS = {
    "½": (1, 2), "⅓": (1, 3), "⅔": (2, 3), "¼": (1, 4), "¾": (3, 4), "⅕": (1, 5), "⅖": (2, 5),
    "⅗": (3, 5), "⅘": (4, 5), "⅙": (1, 6), "⅚": (5, 6), "⅛": (1, 8), "⅜": (3, 8), "⅝": (5, 8),
    "⅞": (7, 8), "⅐": (1, 7), "⅑": (1, 9), "⅒": (1, 10),
}  # fmt: skip
ANY_SIGN = f"[{''.join(SIGNS)}]"
_NAMES = {2: "half", 4: "quarter"}
_AS_NUMBERS = frozenset(((24, 7), (9, 11), (50, 50), (20, 20), (60, 40), (70, 30), (80, 20)))
"""Pairs that are names, not fractions."""
_FINE = frozenset((2, 3, 4, 5, 8, 32, 64, 100, 1000))
"""Divisors that hardly stand in a date."""
_PART_OF = re.compile(
    r"(?i)[ -]?(?:\"|inch|of\b|cup|mile|hour|pound|teaspoon|tablespoon|tsp|tbsp|gallon|full"
    r"|majority|scale|century|way|turn|year|day|time)"
)
_RATED = re.compile(
    r"(?i)\b(?:rat\w+|scor\w+|gave|give|got|gets|stars?|answered|questions) [\w ]{0,15}$"
)
_ON_DAY = re.compile(
    r"(?i)\b(?:on|by|until|since|due|before|after|from|dated?|mon|tue|wed|thu|fri|sat|sun|\w{3,6}day)"
    r",? $"
)
_WRITTEN = re.compile(rf"({POINTED})?[ -]?(?:(\d+)[/⁄](\d+)|({ANY_SIGN}))")


def mixed(written: str) -> str:
    """A number, or one with a fraction: "2 1/2" is "two and a half", "½" "one half"."""
    found = _WRITTEN.fullmatch(written)
    if found is None:
        return say.number(written)
    whole, above, below, sign = found.groups()
    part = _fraction(*(SIGNS[sign] if sign else (int(above), int(below))))
    if not whole:
        return part
    article = "an " if part.startswith("one eighth") else "a "
    return f"{say.number(whole)} and {re.sub('^one ', article, part)}"


def is_below_one(written: str) -> bool:
    """Whether it is a fraction without a whole number."""
    return re.fullmatch(rf"\d+[/⁄]\d+|{ANY_SIGN}", written) is not None


def _fraction(above: int, below: int) -> str:
    if below == 2:
        return "one half" if above == 1 else f"{say.cardinal(above)} halves"
    name = _NAMES.get(below) or say.ordinal(below)
    return f"{say.cardinal(above)} {name}" + ("" if above == 1 else "s")


def _slashed(match: Match, scan: Scan) -> str:
    """(3)/(4): a fraction, a date, a rating, a division, or two numbers."""
    above, below = int(match[1]), int(match[2])
    before, after = text_before(match), text_after(match)
    first, second = say.cardinal(above), say.cardinal(below)
    is_early, is_day = 0 < above < 20, 1 <= above <= 12 and 1 <= below <= 31
    if re.match(r"\s*=", after) or re.search(r"=\s*$", before):
        return f"{first} divided by {second}"
    if match[1] in SERVICES and match[2] in SERVICES:
        return f"{say.by_digits(match[1])}, {say.by_digits(match[2])}"
    if (above, below) in _AS_NUMBERS:
        return f"{first} {second}"
    if (above == below >= 5) or (_RATED.search(before) and above <= below):
        return f"{first} out of {second}"
    if above and below > 1 and _PART_OF.match(after):
        return _fraction(above, below)
    if is_day and (_ON_DAY.search(before) or (below > 10 and below not in (12, 16))):
        return f"{MONTHS[above - 1]} {say.ordinal(below)}"
    if is_early and below > 1 and (above < below <= 20 or below in _FINE):
        return _fraction(above, below)
    return f"{first} over {second}"


RULES: tuple[Rule, ...] = (
    amount(rf"(?:{NUMBER}[ -]?)?{ANY_SIGN}(?!\d)", lambda m, s: mixed(m[0])),
    amount(r"\d{1,4}[ -]\d{1,2}[/⁄]0*[1-9]\d?(?![\w/])", lambda m, s: mixed(m[0])),
    amount(r"(\d{1,4})[/⁄](\d{1,4})(?![\d/]|\.\d)(?:ths?|rds?|nds?)?", _slashed),
)
