"""Roman numerals."""

# ruff: noqa: SIM905 - tables of words stay readable.
from __future__ import annotations

import re
from itertools import pairwise

from hri.speech.notation import number_words as say
from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.rule import LETTER, Match, Rule, Scan, rule

_NUMERAL = re.compile(r"M{0,3}(?:CM|CD|D?C{0,3})(?:XC|XL|L?X{0,3})(?:IX|IV|V?I{0,3})")
_WORTH = {"I": 1, "V": 5, "X": 10, "L": 50, "C": 100, "D": 500, "M": 1000}
COUNTED = frozenset(
    """chapter part act scene section volume book phase article war mark type level stage class
    grade bowl apollo gemini fantasy episode round rocky title appendix figure table exhibit
    schedule unit lesson vol corps category tier factor olympiad world""".split()
)
"""Words, in small letters, behind which a numeral is a number."""
RULERS = frozenset(
    """pope king queen emperor tsar czar henry louis edward george william charles james richard
    elizabeth napoleon pius benedict leo paul ramses frederick philip alexander nicholas peter
    catherine ivan umberto emmanuel gustav christian ferdinand mary john juan carlos felipe wilhelm
    harald olaf margaret harold baldwin otto constantine theodore innocent gregory clement urban
    ptolemy darius xerxes artaxerxes mehmed selim murad rama vajiralongkorn haakon albert leopold
    victor franz joseph""".split()
)
"""Names, in small letters, behind which it is "the eighth"."""
_VERB = re.compile(r" (?:of|was|is|ruled|reigned|and|died|became|had)\b")
_PERSON = re.compile(r"(?:^|[^.!?] )[A-Z][a-z]+ [A-Z][a-z]+,? $")
_WORD = re.compile(rf"({LETTER}+)(?:'s)?[ -]$")


def value(numeral: str) -> int:
    """What a Roman numeral means; 0 for other letters."""
    if not _NUMERAL.fullmatch(numeral):
        return 0
    worth = [_WORTH[sign] for sign in numeral] + [0]
    return sum(-one if after > one else one for one, after in pairwise(worth))


def _read(match: Match, scan: Scan) -> str | None:
    numeral, before = match[1], text_before(match)
    number = value(numeral)
    if not number:
        return None
    found = _WORD.search(before)
    word = found[1] if found else ""
    if word.lower() in COUNTED and (number > 1 or len(numeral) > 1 or word != "class"):
        return say.cardinal(number)
    if word.lower() in RULERS and (number > 1 or _is_first(match)):
        return f"the {say.ordinal(number)}"
    if number >= 1000 and len(numeral) > 3:
        return say.year(number)
    if len(numeral) < 2 or not set(numeral) <= set("IVX") or not word[:1].isupper():
        return None
    is_heir = number in (2, 3, 4) and _PERSON.search(before)
    return f"the {say.ordinal(number)}" if is_heir else say.cardinal(number)


def _is_first(match: Match) -> bool:
    """Whether "I" behind a ruler's name is a numeral: "Elizabeth I was", not "John, I am"."""
    after = text_after(match)
    return _VERB.match(after) is not None or not re.match(r" [a-z]|'", after)


RULES: tuple[Rule, ...] = (rule(r"([IVXLCDM]{1,15})(?!\w|['.]\w)", _read),)
