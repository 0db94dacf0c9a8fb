"""How a quantity may be written: the patterns that money, measures and fractions share."""

from __future__ import annotations

import re
from collections.abc import Iterable

from hri.speech.notation.units import AFTER_PER, LENGTHS, UNITS

NUMBER = r"(?:\d{1,3}(?:,\d{3}){1,12}+(?!\d)|\d{1,40}+)(?:\.\d{1,40}+)?+"
POINTED = rf"(?:{NUMBER}|\.\d{{1,40}})"
"""A number, also one that begins with its point."""
POWERS = dict.fromkeys(("2", "²", "^2"), "square ") | dict.fromkeys(("3", "³", "^3"), "cubic ")


def any_of(names: Iterable[str]) -> str:
    """A pattern of one of these, the longest first."""
    return "|".join(map(re.escape, sorted(names, key=len, reverse=True)))


NO_WORD = r"(?![\w²³⁻⁺])"
PER = rf"(?:/ ?([^\W\d_²³]{{1,12}})(²|\^2|³)?{NO_WORD})?"
"""What an amount is counted by, with its power: two groups."""


def per(unit: str | None, power: str | None) -> str:
    """What is said for the groups of PER."""
    if not unit:
        return ""
    name = UNITS[unit][0] if unit in UNITS else AFTER_PER.get(unit, unit)
    if power and unit not in LENGTHS:
        return f" per {name} {'cubed' if power == '³' else 'squared'}"
    return f" per {POWERS.get(power or '', '')}{name}"
