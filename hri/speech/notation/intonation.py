"""The melody of a sentence, as its words and signs ask for it: a tone at the end of each phrase.

The tones are the phrase endings of ToBI (M. Beckman and J. Hirschberg, "The ToBI annotation
conventions", 1994). Which of them a question has follows from its form (J. Pierrehumbert and
J. Hirschberg, "The meaning of intonational contours", 1990): who asks for a yes or a no rises, who
asks with "what" or "where" falls, and of a choice all but the last rise.
"""

# ruff: noqa: RUF001, SIM905 - signs of texts are meant; tables of words stay readable.
from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum


class Tone(Enum):
    """How the pitch ends a phrase."""

    FALL = "L-L%"
    """All is said."""
    STRONG_FALL = "H*L-L%"
    """The same, exclaimed: from higher up."""
    RISE = "H-H%"
    """It asks."""
    CONTINUE = "L-H%"
    """A little rise: more follows."""
    LEVEL = "H-L%"
    """It trails off."""


@dataclass(frozen=True, slots=True)
class Boundary:
    """The end of a phrase."""

    end: int
    """Characters of the sentence before it, its sign included."""
    tone: Tone
    pause_s: float
    """Seconds of silence after it, at the usual pace."""


PAUSES = {
    ",": 0.18, ";": 0.3, ":": 0.3, "—": 0.25, ".": 0.45, "!": 0.45, "?": 0.6, "…": 0.7,
}  # fmt: skip
"""Seconds of silence after each sign. A question is handed over, an ellipsis trails off."""
PARAGRAPH_S = 0.8
"""After the last sentence of a paragraph, and before someone else is quoted."""
LAST_S = 0.2
"""After the last sentence of all."""

_QUOTE_ENDS = re.compile(r"[\"”][^\w\s]*$")
_QUOTE_BEGINS = re.compile(r"\s*[\"“]")
_SIGN = re.compile(r"([,;:.!?…]+|[—–]|(?<=\s)-(?=\s))[\"”’')\]]*(?=\s|$)|—(?=\w)")
_ENDING = re.compile(r"[.!?…]")
_WORD = re.compile(r"[\w'’]+")
_OPENERS = frozenset(
    """
    ah alright also and but hey hi hello hmm just no now oh okay ok or please right so sorry
    then thanks uh um wait well wow yeah yes
    """.split()
)
"""Words before the form of a question shows."""
_ASKING = frozenset(
    """
    am are aren't can can't could couldn't did didn't do does doesn't don't had hadn't has
    hasn't have haven't is isn't may might must shall should shouldn't was wasn't were
    weren't will won't would wouldn't any
    """.split()
)
"""A clause that begins so asks for a yes or a no."""
_WH = re.compile(r"(what|who|whom|whose|which|where|when|why|how)('s|'re|'d|'ll|'ve)?$")
_SUBJECTS = frozenset(
    """
    i you he she it we they the a an my your his her its our their this
    """.split()
)
_TELLING = ("when", "where", "how", "why")
"""Before one of the subjects they begin a clause that does not ask: "when it rains"."""
_NOT_A_CHOICE = re.compile(r"\bor (what|so|whatever|some\w+|any\w+)\b")
_CHOICE = re.compile(r"\bor\b", re.IGNORECASE)
_SHORT_ANSWERS = frozenset(
    """
    ah hello hey hi no oh okay ok thanks well yes yeah
    """.split()
)


def boundaries(sentence: str) -> tuple[Boundary, ...]:
    """The phrases of a sentence.

    Words without a sign after them have no tone: they may be part of a sentence, as in SSML.
    """
    signs = list(_SIGN.finditer(sentence))
    found: list[Boundary] = []
    begin, clauses = 0, list[str]()
    for sign in signs:
        phrase = sentence[begin : sign.start()]
        is_within = sign[0] == "." and sentence[sign.end() :].strip()  # an abbreviation
        if is_within or not _WORD.search(phrase):
            continue
        clauses.append(phrase)
        found += _phrase(begin, phrase, sign, clauses, sentence)
        begin = sign.end()
        if _ENDING.search(sign[0]):
            clauses.clear()
    return tuple(found)


def pause_between(sentence: str, rest: str) -> float:
    """Seconds of silence after a sentence, before the rest of the text."""
    if not rest.strip():
        return LAST_S
    is_new_speaker = _QUOTE_ENDS.search(sentence) and _QUOTE_BEGINS.match(rest)
    if is_new_speaker or "\n" in rest[: len(rest) - len(rest.lstrip())]:
        return PARAGRAPH_S
    ends = boundaries(sentence)
    return ends[-1].pause_s if ends else PAUSES["."]


def _phrase(
    begin: int, phrase: str, sign: re.Match[str], clauses: list[str], sentence: str
) -> Iterator[Boundary]:
    mark = sign[0].rstrip("\"”’')]")
    if "?" in mark:
        tone, choice = _question(clauses)
        if choice:
            yield Boundary(begin + choice, Tone.RISE, 0.0)
        yield Boundary(sign.end(), tone, PAUSES["?"])
    elif "…" in mark or mark.count(".") > 1:
        yield Boundary(sign.end(), Tone.LEVEL, PAUSES["…"])
    elif "!" in mark:
        yield Boundary(sign.end(), Tone.STRONG_FALL, PAUSES["!"])
    elif mark[0] in ".;:":
        yield Boundary(sign.end(), Tone.FALL, PAUSES[mark[0]])
    elif mark[0] == ",":
        words = _WORD.findall(phrase)
        is_opener = len(words) == 1 and words[0].lower() in _SHORT_ANSWERS
        tone = _before_comma(clauses, sentence[sign.end() :])
        yield Boundary(sign.end(), Tone.FALL if is_opener else tone, PAUSES[","])
    else:
        yield Boundary(sign.end(), Tone.CONTINUE, PAUSES["—"])


def _before_comma(clauses: list[str], rest: str) -> Tone:
    """In a question for a choice each item rises."""
    ends = re.search(r"[.!?…]", rest)
    is_choice = ends is not None and ends[0] == "?" and _CHOICE.search(rest[: ends.start()])
    return Tone.RISE if is_choice and _form(clauses) != "wh" else Tone.CONTINUE


def _question(clauses: list[str]) -> tuple[Tone, int]:
    """The tone of a question, and how many characters of its last clause are before the "or" of a
    choice; 0 without one."""
    if _form(clauses) == "wh":
        return Tone.FALL, 0
    last = clauses[-1]
    choice = _CHOICE.search(last)
    if choice is None or _NOT_A_CHOICE.search(last):
        return Tone.RISE, 0
    return Tone.FALL, len(last[: choice.start()].rstrip())


def _form(clauses: list[str]) -> str:
    """How a question asks: "wh", "yes or no", or "" for a statement with a question mark."""
    for clause in reversed(clauses):
        words = [word.lower().replace("’", "'") for word in _WORD.findall(clause)]
        while words and words[0] in _OPENERS:
            words.pop(0)
        if not words:
            continue
        if words[0] in _ASKING or words[0].startswith("any"):
            return "yes or no"
        tells = words[0] in _TELLING and not _SUBJECTS.isdisjoint(words[1:2])
        if _WH.match(words[0]) and not tells:
            return "wh"
    return ""
