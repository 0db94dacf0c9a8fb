"""Versions of programs, and numeric addresses of machines."""

# ruff: noqa: SIM905 - tables of words stay readable.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import word_before
from hri.speech.notation.rule import Match, Rule, Scan, rule

_VERSION_WORDS = frozenset("version ver v release".split())


def _internet(match: Match, scan: Scan) -> str | None:
    """(192.168.1.1)(:)(8080): three digits one by one, fewer as a number."""
    groups = match[1].split(".")
    if any(int(group) > 255 for group in groups) or word_before(match) in _VERSION_WORDS:
        return None
    said = " dot ".join(say.by_digits(g) if len(g) > 2 else say.number(g) for g in groups)
    if match[2] == ":":
        return f"{said} colon {say.by_digits(match[3])}"
    return f"{said} slash {say.cardinal(int(match[3]))}" if match[2] else said


def _version(match: Match, scan: Scan) -> str:
    """(v)(1.2.3)-(beta)(2)."""
    is_named = not match[1] or word_before(match) in _VERSION_WORDS
    said = "" if is_named else "version "
    said += " point ".join(say.number(number) for number in match[2].split("."))
    if stage := match[3]:
        said += f" {stage if len(stage) > 2 else ' '.join(stage.upper())}"
        said += f" {say.number(match[4])}" if match[4] else ""
    return said


def _letters_and_digits(written: str) -> str:
    """0xFF, and addresses with colons, sign by sign."""
    return " ".join(
        "colon" if sign == ":" else say.by_digits(sign) if sign.isdecimal() else sign.upper()
        for sign in written
    )


def _colons(match: Match, scan: Scan) -> str | None:
    """Addresses of network cards, and of IPv6; not of three numbers, which are a time."""
    is_address = re.search(r"[A-Fa-f]", match[0]) or match[0].count(":") > 2
    return _letters_and_digits(match[0]) if is_address else None


_STAGE = r"(?:[-. ]?(alpha|beta|rc|dev|post|a|b)[-.]?(\d{1,4})?)?(?!\w)"
_COLONS = rule(
    r"(?:[0-9A-Fa-f]{1,4}::|(?:[0-9A-Fa-f]{1,4}:{1,2}){2,7})[0-9A-Fa-f]{1,4}(?![\w:])", _colons
)
RULES: tuple[Rule, ...] = (
    rule(r"((?:\d{1,3}\.){3}\d{1,3})(?:([:/])(\d{1,5}))?(?!\w|\.\d)", _internet),
    rule(r"0[xX]([0-9A-Fa-f]{1,16})\b", lambda m, s: f"zero X {_letters_and_digits(m[1])}"),
    _COLONS,
    rule(rf"()((?:\d{{1,6}}\.){{2,6}}\d{{1,6}}){_STAGE}", _version),
    rule(r"()(\d{1,4}\.\d{1,4})-(alpha|beta|rc|dev|post)[-.]?(\d{1,4})?(?!\w)", _version),
)
NAMED: tuple[Rule, ...] = (
    rule(rf"([vV])\.? ?(\d{{1,6}}(?:\.\d{{1,6}}){{1,5}}){_STAGE}", _version),
    rule(r"(v)(\d{1,3})()()(?!\w|\.\d)", _version),
    _COLONS,
)
"""What begins with a letter."""
