"""Chemical formulas."""

# ruff: noqa: SIM905 - tables of words stay readable.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.rule import Match, Rule, Scan, rule

ELEMENTS = frozenset(
    """H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se
    Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Sm Eu Gd Tb Dy Ho
    Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am""".split()
)
_ELEMENT = re.compile(r"([A-Z][a-z]?)(\d*)")
_CHARGES = {"+": " plus", "⁺": " plus", "-": " minus", "⁻": " minus"}
_MANY = {"²": " two", "³": " three"}


def _formula(match: Match, scan: Scan) -> str | None:
    """CO2, H2SO4, NaCl, Ca2+: symbols of elements, letter by letter."""
    written = match[1]
    parts = _ELEMENT.findall(written)
    counts = [count for _, count in parts if count]
    is_whole = "".join(map("".join, parts)) == written
    if not is_whole or not all(symbol in ELEMENTS for symbol, _ in parts):
        return None
    is_word = len(parts) < 2 or written.isupper() or len(written) < 3
    if (not counts and is_word) or any(c[0] == "0" or len(c) > 2 for c in counts):
        return None
    words: list[str] = []
    for symbol, count in parts:
        words += [*symbol.upper(), *([say.cardinal(int(count))] if count else ())]
    return " ".join(words) + _charge(match[2] or "")


def _charge(signs: str) -> str:
    return "".join(_CHARGES.get(sign) or _MANY[sign] for sign in signs)


RULES: tuple[Rule, ...] = (
    rule(
        r"((?:[A-Z][a-z]?\d{0,3}){2,12}|[A-Z][a-z]?[234])([+⁺⁻]|[²³][⁺⁻]|-(?!\w))?(?!\w)", _formula
    ),
    rule(r"((?:[A-Z][a-z]?\d?){1,2})([+⁺⁻])(?![\w+])", _formula),
)
