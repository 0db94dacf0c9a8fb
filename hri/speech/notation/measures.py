"""Amounts with a unit: lengths, weights, degrees, shares, places on the earth."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import (
    FUNCTION_WORDS,
    PAIRED_AFTER,
    is_attributive,
    text_after,
    text_before,
    word_before,
    words_after,
)
from hri.speech.notation.fraction import ANY_SIGN, is_below_one, mixed
from hri.speech.notation.quantities import NO_WORD, NUMBER, PER, POINTED, POWERS, any_of, per
from hri.speech.notation.rule import Match, Rule, Scan, amount, rule
from hri.speech.notation.units import UNITS

TEMPERATURES = {
    "C": " Celsius", "℃": " Celsius", "F": " Fahrenheit", "℉": " Fahrenheit", "K": " Kelvin",
}  # fmt: skip
SIDES = {"N": " north", "S": " south", "E": " east", "W": " west"}
_BEHIND_POWER = re.compile(r"\b10(?:[⁰¹²³⁴-⁹⁻]{1,4}|\^-?\d{1,3}) $")
_INCHES_BEHIND = re.compile(
    r"\.?$|[.,;)]|\s*[x×]|\s(?:wide|long|tall|deep|thick|high|by|of snow|of rain)\b"
)


def _measure(match: Match, scan: Scan) -> str | None:
    """(10)( )(km)(²)(/h)(²)."""
    written, space, unit, power, of, of_power = match.groups()
    if not _is_unit(match, written, space, unit):
        return None
    one, many = UNITS[unit]
    name = one if _is_single(match, written) or space == "-" else many
    stop = "." if unit.endswith(".") and not text_after(match).strip() else ""
    return f"{mixed(written)} {POWERS.get(power, '')}{name}{per(of, of_power)}{stop}"


def _behind_power(match: Match, scan: Scan) -> str | None:
    """(m)(²)(/s)(²)."""
    if not _BEHIND_POWER.search(text_before(match)):
        return None
    return f"{POWERS.get(match[2], '')}{UNITS[match[1]][1]}{per(match[3], match[4])}"


def _is_single(match: Match, written: str) -> bool:
    return written == "1" or is_below_one(written) or is_attributive(match)


def _is_unit(match: Match, written: str, space: str, unit: str) -> bool:
    """Whether letters that may be something else are a unit here."""
    after = text_after(match)
    if unit in ("N", "W") and re.match(r"\.? (?:[A-Z]|\d{1,3}(?:st|nd|rd|th)\b)", after):
        return False  # a point of the compass in an address
    if unit == "in":
        return not space or _INCHES_BEHIND.match(after) is not None
    if unit == "F" or (unit in ("B", "K") and not space):
        return False
    if unit == "A":
        is_place = word_before(match) in PAIRED_AFTER | {"section", "seat", "size"}
        return "." in written if not space else not is_place
    return not (unit == "s" and not space and written.endswith("0"))  # 1990s, 20s


def _degrees(match: Match, scan: Scan) -> str:
    """(21)(°)(C)."""
    single = match[1] == "1" or is_attributive(match)
    scale = TEMPERATURES.get(match[2] or match[3] or "", "")
    return f"{say.number(match[1])} {'degree' if single else 'degrees'}{scale}"


def _coordinate(match: Match, scan: Scan) -> str:
    """(40)°(42)'(46)"(N)."""
    units = ("degree", "minute", "second")
    words = [
        f"{say.number(count)} {unit if count == '1' else unit + 's'}"
        for count, unit in zip(match.groups()[:3], units, strict=True)
        if count
    ]
    return " ".join(words) + SIDES.get(match[4] or "", "")


def _feet_and_inches(match: Match, scan: Scan) -> str:
    feet = "foot" if match[1] == "1" else "feet"
    inches = "inch" if match[2] == "1" else "inches"
    return f"{say.number(match[1])} {feet} {say.number(match[2])} {inches}"


def _signed_length(match: Match, scan: Scan, one: str, many: str) -> str | None:
    if scan.is_quoted:
        return None
    first, _ = words_after(match)
    has_noun = first != "" and first.lower() not in FUNCTION_WORDS | {"x"}
    return f"{mixed(match[1])} {one if match[1] == '1' or has_noun else many}"


_ANY = rf"{POINTED}|\d{{1,4}} \d/\d{{1,2}}|\d/\d{{1,2}}|\d{{0,4}}{ANY_SIGN}"
_POWER = r"((?:\^[23]|[²³]|(?<=[mnt])[23](?!\d))?)"
_SMALL = r"\d{1,2}(?:\.\d{1,9})?"
BY_NAME: tuple[Rule, ...] = (
    rule(rf"({any_of(UNITS)}){_POWER}{PER}{NO_WORD}(?!'\w)", _behind_power),
)
"""A unit behind a power: 10⁸ m/s."""
RULES: tuple[Rule, ...] = (
    amount(rf"({NUMBER})\s?° ?({_SMALL})' ?(?:({_SMALL})\" ?)?([NSEW]\b)?", _coordinate),
    amount(rf"({NUMBER})\s?°()() ?([NSEW])\b", _coordinate),
    amount(rf"({POINTED})\s?(?:° ?([CFK])?|([℃℉]))(?!\w)", _degrees),
    amount(r"(\d{1,2}) ?(?:'|ft\.?) ?(\d{1,2}(?:\.\d)?)(?:\"|''| ?in\b\.?)", _feet_and_inches),
    amount(r"(\d{1,2})'(\d{1,2})(?!\w)", _feet_and_inches),
    amount(
        rf"({NUMBER}(?:[ -]\d/\d{{1,2}}|{ANY_SIGN})?|\d/\d{{1,2}})\"(?!\w)",
        lambda m, s: _signed_length(m, s, "inch", "inches"),
    ),
    amount(rf"({NUMBER})'(?=[ ,.]|$)", lambda m, s: _signed_length(m, s, "foot", "feet")),
    amount(rf"({_ANY})([ -]?)({any_of(UNITS)}){_POWER}{PER}{NO_WORD}(?!'\w|\.[A-Z])", _measure),
    amount(rf"({POINTED}) ?%", lambda m, s: f"{say.number(m[1])} percent"),
)
