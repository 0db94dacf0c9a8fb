"""Amounts of money."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.context import is_attributive
from hri.speech.notation.quantities import NUMBER, PER, POINTED, any_of, per
from hri.speech.notation.rule import Match, Rule, Scan, amount
from hri.speech.notation.units import COINS, CURRENCIES, SCALES


def _before(match: Match, scan: Scan) -> str:
    """($)(5.20)(million)(M)(/hr)."""
    written, scale = match[2], match[3] or match[4]
    return _money(match, COINS[match[1]], written, scale) + per(match[5], match[6])


def _negative(match: Match, scan: Scan) -> str:
    """$-5."""
    return f"minus {_before(match, scan)}"


def _behind(match: Match, scan: Scan) -> str:
    """(5.20)(million)(M)(€)(/hr)."""
    written, scale = match[1], match[2] or match[3]
    return _money(match, COINS[match[4]], written, scale) + per(match[5], match[6])


def _money(match: Match, coin: tuple[str, str], written: str, scale: str | None) -> str:
    whose, sign = coin
    one, many, cent, cents = CURRENCIES[sign]
    written = re.sub(r",(\d\d)$", r".\1", written)  # as in Europe
    whole, _, part = written.replace(",", "").partition(".")
    part = f"{part}0" if len(part) == 1 else part
    name = whose + (one if is_attributive(match) or (whole == "1" and not scale) else many)
    if scale:
        return f"{say.number(written)} {SCALES[scale]} {name}"
    if len(part) != 2 or not cent:
        return f"{say.number(written)} {name}"
    small = f"{say.cardinal(int(part))} {cent if int(part) == 1 else cents}" if int(part) else ""
    large = f"{say.number(whole)} {name}" if int(whole or 0) or not small else ""
    return " and ".join(words for words in (large, small) if words)


def _range(match: Match, scan: Scan) -> str | None:
    """ "$5-$10" is "five to ten dollars"; with cents, or two currencies, each is said."""
    if match[3] not in (None, match[1]) or "." in match[2] + match[4]:
        return None
    whose, sign = COINS[match[1]]
    name = whose + CURRENCIES[sign][0 if is_attributive(match) else 1]
    scale = SCALES.get(match[5] or match[6], "")
    high = " ".join(words for words in (say.number(match[4]), scale, name) if words)
    return f"{say.number(match[2])} to {high}{per(match[7], match[8])}"


def _cents(match: Match, scan: Scan) -> str:
    single = match[1] == "1" or is_attributive(match)
    return f"{say.number(match[1])} {'cent' if single else 'cents'}"


_SIGN = any_of(name for name in COINS if not name.isalpha())
_ANY = any_of(COINS)
_WORD_SCALE = any_of(name for name in SCALES if len(name) > 3)
_SHORT_SCALE = any_of(name for name in SCALES if len(name) <= 3)
_SCALE = rf"(?:(?: ?({_WORD_SCALE})|({_SHORT_SCALE}))\b)?"
_EUROPEAN = r"(?:,\d\d(?!\d))?"
BY_SIGN: tuple[Rule, ...] = (
    amount(
        rf"({_SIGN}) ?({NUMBER}) ?[-–] ?(?:({_SIGN}) ?)?({NUMBER})(?![\d:]){_SCALE}{PER}"
        r"(?![.,]?\d)",
        _range,
    ),
    amount(rf"({_SIGN}) ?({POINTED}{_EUROPEAN}){_SCALE}{PER}", _before),
    amount(rf"({_SIGN})[-−]({POINTED}{_EUROPEAN}){_SCALE}{PER}", _negative),
)
"""$5, by the sign that begins it."""
BY_NAME: tuple[Rule, ...] = (amount(rf"({_ANY}) ?({NUMBER}){_SCALE}{PER}", _before),)
"""USD 5, C$5."""
BY_NUMBER: tuple[Rule, ...] = (
    amount(rf"({NUMBER}{_EUROPEAN}){_SCALE} ?({_ANY})(?!\w){PER}", _behind),
    amount(rf"({POINTED}) ?¢", _cents),
)
"""5 €, 50¢."""
