"""Numbers without a unit: years, counts, ordinals, numbers of rooms, ZIP codes."""

# ruff: noqa: SIM905 - tables of words stay readable.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.abbreviations import STATES, STREET_NAMES, STREETS
from hri.speech.notation.context import (
    DIGITS_AFTER,
    PAIRED_AFTER,
    SERVICES,
    counts,
    is_called,
    is_year,
    text_after,
    text_before,
    word_before,
)
from hri.speech.notation.quantities import NUMBER, POINTED, any_of
from hri.speech.notation.rule import Match, Rule, Scan, amount
from hri.speech.notation.units import SCALES

_NAMED_K = frozenset("run race tv monitor video display resolution".split())
"""What is called "a 10K", "a 4K"."""
_SCREENS = frozenset(("2", "4", "5", "8", "16"))
_KNOWN_SERVICES = SERVICES - {"511", "611", "711", "811"}
"""Those that are meant without "call"."""
_COUNT = re.compile(r"(?i)\b(?:page|number|over|than|exactly|about|of|weighs|total|is|=) ?$")
_SERVICE = re.compile(r" (?:call|line|operator|dispatch|emergency)")
_ZIP = re.compile(
    rf"(?:\b(?:{any_of(STATES)})[.,]? |\b(?:{any_of(STATES.values())}),? "
    r"|(?i:\b(?:zip|postal)(?: ?code)?(?: is|:)? ))$"
)
_PAIRED = re.compile(r"(?i:\bflight) [A-Z][A-Z\d] $|\b(?:US|SR) $|\d[xX]$")
_CLOCK = re.compile(r"(?i)\b(?:at|by|until|since|from|to) $")
_VERSIONED = re.compile(
    r"(?i)\b(?:version|ver\.|release|build|firmware|python|ubuntu|debian|fedora|kernel|linux|java"
    r"|node|ruby|php|django|numpy|pytorch|tensorflow|cuda|android|ios|macos|windows|opencv|ros|go"
    r"|rust|perl|bluetooth|usb|hdmi|http|tls) ?v?$"
)
_STREET_BEHIND = (
    r"(?= (?:[NSEW]{1,2}\.? )?(?:[A-Z][a-z'.]+|\d{1,3}(?:st|nd|rd|th))(?: [A-Z][a-z']+){0,2}? "
    rf"(?:{any_of((*STREETS, *STREET_NAMES))})\b)"
)


def _decade(match: Match, scan: Scan) -> str:
    """1990s, 90s."""
    number = int(match[1])
    return say.plural(say.year(number) if number >= 100 else say.cardinal(number))


def _scaled(match: Match, scan: Scan) -> str | None:
    """(10)k, (1.5)M, (4)K."""
    written, sign = match[1], match[2]
    found = re.match(r"[ -]([a-z]+)", text_after(match))
    following = found[1] if found else ""
    if sign in "kK":
        is_screen = written in _SCREENS and not counts(match)
        is_name = following in _NAMED_K or (sign == "K" and (is_screen or not following))
        return f"{say.number(written)} {'K' if is_name else 'thousand'}"
    is_many = counts(match) or "." in written
    return f"{say.number(written)} {SCALES[sign]}" if is_many and sign != "m" else None


def _zip(match: Match, scan: Scan) -> str | None:
    """Five digits after a state, or after "ZIP"; nine anywhere."""
    if not (match[2] or _ZIP.search(text_before(match))):
        return None
    return say.by_digits(match[1]) + (f" dash {say.by_digits(match[2])}" if match[2] else "")


def _power_of_ten(match: Match, scan: Scan) -> str:
    """(1.5)e(-)(3)."""
    sign = "minus " if match[2] == "-" else ""
    return f"{say.number(match[1])} times ten to the power of {sign}{say.cardinal(int(match[3]))}"


def _plain(match: Match, scan: Scan) -> str:
    """A number by itself: an amount, a year, a code, or a number that is called."""
    written = match[1]
    if not written.isdecimal():
        return _version(match) or say.number(written)
    if len(written) > 2 and not counts(match) and (said := _code(match)):
        return said
    if len(written) == 4:
        if _is_clock(match):
            return _military(written)
        if is_year(match, int(written)):
            return say.year(int(written))
    return say.number(written)


def _version(match: Match) -> str:
    """The second number of a version is one, too: Python 3.11, Ubuntu 22.04."""
    whole, _, part = match[1].partition(".")
    if len(part) != 2 or "," in whole or not _VERSIONED.search(text_before(match)):
        return ""
    return f"{say.number(whole)} point {'oh ' if part[0] == '0' else ''}{say.cardinal(int(part))}"


def _code(match: Match) -> str:
    """A number that is none of things: of a telephone, a room, a flight."""
    written, before = match[1], word_before(match)
    is_known = written in _KNOWN_SERVICES and (
        not _COUNT.search(text_before(match)) or _SERVICE.match(text_after(match))
    )
    if is_called(match) or before in DIGITS_AFTER:
        return say.by_digits(written)
    if len(written) < 5 and (before in PAIRED_AFTER or _PAIRED.search(text_before(match))):
        return say.in_pairs(written)
    return say.by_digits(written) if is_known else ""


def _is_clock(match: Match) -> bool:
    """Whether four digits are a time of the day, as in "at 1930 hours"."""
    hour, minute = divmod(int(match[1]), 100)
    if hour > 24 or minute > 59 or not re.match(r" (?:hours|hrs)\b", text_after(match)):
        return False
    return match[1][0] == "0" or _CLOCK.search(text_before(match)) is not None


def _military(digits: str) -> str:
    """ "0800" is "zero eight hundred", "1930" "nineteen thirty"."""
    hour, minute = int(digits[:2]), int(digits[2:])
    if not minute:
        return f"{_two_digits(hour)} hundred"
    return f"{_two_digits(hour)} {_two_digits(minute)}"


def _two_digits(number: int) -> str:
    return ("zero " if 0 < number < 10 else "") + say.cardinal(number)


RULES: tuple[Rule, ...] = (
    amount(
        r"(\d{1,3}(?:,\d{3}){1,4}|\d{1,15})(?:st|nd|rd|th)\b",
        lambda m, s: say.ordinal(int(m[1].replace(",", ""))),
    ),
    amount(r"(\d{3}0|[1-9]0)'?s\b", _decade),
    amount(r"401\(?k\)?(?!\w)", "four oh one K"),
    amount(rf"({NUMBER})([kKmMB])(?![\w-])(?!\+)", _scaled),
    amount(r"(\d{1,5})(?=[xX]\d{1,5}(?:x\d|\b))", lambda m, s: say.in_pairs(m[1])),
    amount(rf"({NUMBER})e([-+]?)(\d{{1,3}})\b", _power_of_ten),
    amount(r"(\d{5})(?:-(\d{4}))?(?!\w|[.,]\d)", _zip),
    amount(rf"(\d{{3,4}})(?![\w,.-]\d){_STREET_BEHIND}", lambda m, s: say.in_pairs(m[1])),
)
PLAIN: tuple[Rule, ...] = (amount(rf"({POINTED})", _plain),)
"""Any number."""
