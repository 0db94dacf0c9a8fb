"""Telephone numbers, and other numbers in groups of digits."""

from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.rule import Match, Rule, Scan, amount, rule

_CODE = re.compile(r"(?i)\b(?:code|pin|passcode|password)(?: is|:)? $")
SHORTEST = 7
"""Digits of a number behind a plus sign."""


def _groups(match: Match, scan: Scan) -> str:
    """Digit by digit, with a pause between groups; words stay."""
    plus = "plus " if match[0].startswith("+") else ""
    groups = re.findall(r"\d+|[A-Z]+|x", match[0])
    said = ", ".join(say.by_digits(g) if g[0].isdecimal() else g for g in groups)
    return plus + said.replace(", x, ", ", extension ")


def _international(match: Match, scan: Scan) -> str | None:
    is_long = len(re.findall(r"\d", match[0])) >= SHORTEST
    return _groups(match, scan) if is_long else None


def _hyphened(match: Match, scan: Scan) -> str | None:
    """Three groups or more: 123-45-6789, 4-4-2, but not a difference."""
    return None if re.match(r"\s*=", text_after(match)) else _groups(match, scan)


def _spaced(match: Match, scan: Scan) -> str | None:
    return _groups(match, scan) if _CODE.search(text_before(match)) else None


RULES: tuple[Rule, ...] = (
    amount(
        r"(?:\+?\d{1,3}[ .-]?)?(?:\(\d{3}\)[ -]?|\d{3}[ .-])\d{3}[ .-]\d{4}"
        r"(?: ?x ?\d{1,6})?(?![\w-])",
        _groups,
    ),
    rule(r"\d{3}-\d{4}(?![\w-])", _groups),
    rule(r"\+\d{1,3}(?:[ -]?\(?\d{1,5}\)?){1,6}(?![\w-])", _international),
    rule(r"0\d{2,4}(?: \d{3,6}){1,3}(?![\w-])", _groups),
    rule(r"1[- .]8\d\d[- .][A-Z]{2,12}(?:-[A-Z]{1,12}){0,3}\b", _groups),
    rule(r"\d{4}(?:[ -]\d{4}){3}(?![\w-])", _groups),
    rule(r"\d{3} \d{3}(?!\w| \d)", _spaced),
)
HYPHENED: tuple[Rule, ...] = (rule(r"\d{1,7}(?:-\d{1,7}){2,6}(?![\w-])", _hyphened),)
