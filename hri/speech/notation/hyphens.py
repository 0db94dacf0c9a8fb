"""Hyphens and dashes: minus, "to", a dash, or nothing."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re

from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.rule import Match, Rule, Scan, rule

_AMOUNT = r" ?(?:[$€£¥]?[\d½¼¾⅓⅔⅛]|\.\d)"
_SUM_BEHIND = re.compile(r" ?[\d.,]+\s*[=+×*÷]")
_SUM_BEFORE = re.compile(r"[=+×*÷]\s*[\d.,]+ ?$")
_RANGED = re.compile(
    r"(?i)\b(?:pages?|pp\.?|ages?|aged|grades?|chapters?|rooms?|lines?|days?|weeks?|years?|hours|open"
    r"|from|levels?|between|floors?|items?|verses?|sections?|steps?|sizes?)\s+\S{1,12}\s$"
)
_CLOCK = r"(?:[ap]\.?m\.?|:\d\d)"
_RANGES = tuple(
    (re.compile(before), re.compile(behind))
    for before, behind in (
        (rf"{_CLOCK} $", ""),
        ("", rf" \d{{1,2}} ?{_CLOCK}"),
        (r"\b\d{4} $", r" \d{4}\b"),
        (r"[$€£][\d,.]+ $", " [$€£]"),
        (r"/\d+ $", ""),
    )
)
"""What stands on both sides of a hyphen that is not a minus."""
_OPENING = "(=<>*/×÷+,:[~≈^±"
"""Signs before a minus."""


def _hyphen(match: Match, scan: Scan) -> str | None:
    before, after = text_before(match), text_after(match)
    is_apart = not before or before[-1].isspace()
    is_before_amount = re.match(_AMOUNT, after) is not None
    if scan.is_after_amount and is_before_amount and is_apart == after[:1].isspace():
        return "to" if _is_range(before, after, match[0]) else "minus"
    if is_apart or before[-1] in _OPENING:
        is_sign = is_before_amount and not after[:1].isspace()
        return "minus" if is_sign else _before_word(before, after)
    is_inner = after[:1].isalnum() and (before[-1].isdecimal() or after[:1].isdecimal())
    return "" if is_inner else None


def _is_range(before: str, after: str, sign: str) -> bool:
    """Whether a hyphen between two amounts is "to"."""
    if _SUM_BEHIND.match(after) or _SUM_BEFORE.search(before):
        return False
    if sign == "–" or not before[-1].isspace() or _RANGED.search(before):
        return True
    return any(low.search(before) and high.match(after) for low, high in _RANGES)


def _before_word(before: str, after: str) -> str | None:
    """A bullet is silent, an option of a command has a dash, and x a minus."""
    if not before.strip() and after[:1].isspace():
        return ""
    is_sum = re.search(r"[=<>(*/+×÷] ?$", before) or re.match(r"[xyz∞π√(]", after)
    if is_sum and re.match(r"[A-Za-zπ∞√(]", after):
        return "minus"
    if re.match(r"[A-Za-z]\b(?!-)", after):
        return "dash"
    return (
        "minus" if re.match(r" [A-Za-z]\b", after) and re.search(r"\b[A-Za-z] $", before) else None
    )


def _double(match: Match, scan: Scan) -> str:
    """--help, or a dash."""
    before = text_before(match)
    return "dash dash" if not before or before[-1].isspace() else "—"


DOUBLE: tuple[Rule, ...] = (rule(r"--(?=[A-Za-z])", _double), rule(r"-{1,2}>", "to"))
SINGLE: tuple[Rule, ...] = (rule(r"[-–](?![->])", _hyphen),)
