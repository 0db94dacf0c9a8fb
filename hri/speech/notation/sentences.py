"""Where the sentences of a text end."""

# ruff: noqa: RUF001, SIM905 - signs of texts are meant; tables of words stay readable.
from __future__ import annotations

import re
from collections.abc import Iterator

from hri.speech.notation.abbreviations import (
    BEFORE_NUMBERS,
    DAY_OF,
    MONTH_OF,
    PLAIN,
    STREETS,
    TITLES,
)

_END = re.compile(r"(?<![.!?…])[.!?…]+[\"”’')\]]*(?=\s)|\n")
_NEVER = frozenset("a.k.a al cf e.g eg i.e incl Mr Mrs Ms Messrs v viz vs".split())
"""Abbreviations that end no sentence."""
_SHORT = frozenset(
    name.rstrip(".") for names in (PLAIN, TITLES, STREETS, MONTH_OF) for name in names
)
"""Those that may end one."""
_ONLY_BEFORE_NAMES = frozenset(TITLES) - frozenset(STREETS)
_BEFORE_DIGITS = frozenset(BEFORE_NUMBERS) | {
    name.lower() for name in (*_SHORT - {"etc", "Jr", "Sr"}, *DAY_OF)
}
_STARTER = re.compile(
    r"[\"“'‘(]?(?:A|After|All|An|And|Are|As|At|But|Can|Did|Do|Does|Each|Every|For|From|Go|Have|He|Her"
    r"|Here|His|How|I|I'm|If|In|Is|It|It's|Its|Let|Let's|Many|Most|My|No|Not|Now|On|Once|One|Our"
    r"|Please|She|Since|So|Some|That|That's|The|Their|Then|There|These|They|This|Those|To|Today"
    r"|Turn|Was|We|We're|What|When|Where|Which|While|Why|With|Yes|You|Your)\b"
)
"""What begins a sentence, and hardly ever a name."""
_LAST_WORD = re.compile(r"(?:^|[\s(\"“'‘])([^\W\d_](?:[^\W_]|\.)*)$")
_INITIALS = re.compile(r"[A-Z]|(?:[A-Za-z]\.)+[A-Za-z]")
_AROUND = 40
"""Characters that are looked at on each side of a period."""


def sentences(text: str) -> Iterator[tuple[int, int]]:
    """The begin and the end of each sentence of a text, without the space around it."""
    begin = 0
    for found in _END.finditer(text):
        if found[0] == "\n" or _is_end(text, found):
            yield from _stripped(text, begin, found.end())
            begin = found.end()
    yield from _stripped(text, begin, len(text))


def _stripped(text: str, begin: int, end: int) -> Iterator[tuple[int, int]]:
    while begin < end and text[begin].isspace():
        begin += 1
    while end > begin and text[end - 1].isspace():
        end -= 1
    if begin < end:
        yield begin, end


def _is_end(text: str, found: re.Match[str]) -> bool:
    after = text[found.end() : found.end() + _AROUND].lstrip(" \t")
    if not after or after[0] == "\n":
        return True
    if found[0] != ".":
        return not after[0].islower()
    last = _LAST_WORD.search(text[max(0, found.start() - _AROUND) : found.start()])
    word = last[1] if last else ""
    if after[0].islower() or word in _NEVER or word in _ONLY_BEFORE_NAMES:
        return False
    if after[0].isdecimal() or after[0] == "#":
        return word.lower() not in _BEFORE_DIGITS
    if word != "I" and (word in _SHORT or _INITIALS.fullmatch(word)):
        return _STARTER.match(after) is not None
    return True
