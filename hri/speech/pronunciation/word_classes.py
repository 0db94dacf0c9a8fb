"""How much the words around a word tell of its part of speech: a small tagger by closed classes.

Articles, pronouns, auxiliaries and prepositions are few and known; they show of an English word
beside them whether it is a noun, a verb, an adjective, or a verb in the past. Other words count by
their endings as adverbs, adjectives, plurals, or singular nouns. Contexts of this kind are those of
E. Brill, "A Simple Rule-Based Part of Speech Tagger", ANLP 1992.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Literal, get_args

PartOfSpeech = Literal["noun", "verb", "adjective", "past"]
PARTS_OF_SPEECH: tuple[PartOfSpeech, ...] = get_args(PartOfSpeech)
Votes = Mapping[str, float]
"""Points for each part of speech; the weights are set by hand."""

END = "end"
"""The class of what is before the first word, behind the last one, and of marks between parts."""

_MARKS = frozenset('.,;:!?()"“”-–—…[]')  # noqa: RUF001
_ASKERS = frozenset((END, "question", "that", "what", "which"))
_PRONOUNS = frozenset(("subject", "singular subject", "object", "her"))
_NOUNS = frozenset(("singular", "plural"))
_DESCRIBING = frozenset(("article", "that", "possessive", "what", "which", "adjective", "number"))
ASKED: Mapping[str, Votes] = {
    "modal": {"verb": 6},
    "have": {"past": 6},
    "be": {"adjective": 4, "past": 2},
}
"""By the class of the auxiliary of a question."""
_BEFORE_VERBS = frozenset(("to", "modal", "subject", "singular subject"))
_BEFORE_SUBJECTS = frozenset((END, "question", "that", "and"))
"""Classes after which "it" is a subject."""
WINDOW = 6
"""Words that are looked at before a word."""

ENDINGS: Mapping[str, tuple[str, ...]] = {
    "possessive": ("'s",),
    "adverb": ("ly",),
    "adjective": ("ous", "ful", "ive", "ible", "able", "less", "ic"),
    "known verb": ("ize", "izes", "ify", "ifies"),
    "-ing": ("ing",),
    "-ed": ("ed",),
}
"""How words of a class that are not listed end."""

BEFORE: Mapping[str, Votes] = {
    "article": {"noun": 4, "adjective": 3},
    "number": {"noun": 2, "adjective": 1},
    "what": {"noun": 1.5},
    "which": {"verb": 2, "past": 2, "noun": 1},
    "that": {"noun": 2, "past": 2, "verb": 1},
    "possessive": {"noun": 3, "adjective": 3, "past": 1},
    "preposition": {"noun": 3, "adjective": 1},
    "to": {"verb": 5},
    "modal": {"verb": 5},
    "be": {"adjective": 4, "past": 2, "noun": 1},
    "have": {"past": 4, "noun": 1.5, "adjective": 1},
    "subject": {"verb": 4, "past": 2.5},
    "singular subject": {"past": 4, "verb": 2},
    "object": {"adjective": 1, "noun": 0.5},
    "her": {"noun": 3, "adjective": 2.5, "verb": 1},
    "adverb": {"verb": 2, "past": 1, "adjective": 1},
    "not": {"adjective": 2, "verb": 1, "noun": 1},
    "degree": {"adjective": 4},
    "and": {"verb": 0.5, "noun": 0.5},
    "question": {"noun": 0.5},
    "particle": {"noun": 0.5},
    END: {"verb": 1, "noun": 0.5},
    "adjective": {"noun": 3},
    "plural": {"verb": 3, "noun": 0.5},
    "singular": {"noun": 1.5, "past": 2.5},
    "known verb": {"noun": 2.5, "adjective": 2},
    "-ing": {"noun": 2},
    "-ed": {"noun": 1.5, "adjective": 1},
}
"""By the class of the word before."""
AFTER: Mapping[str, Votes] = {
    "article": {"verb": 2.5, "past": 2.5, "noun": -2, "adjective": -2},
    "number": {"verb": 1, "past": 1, "noun": -0.5},
    "object": {"verb": 3, "past": 3, "noun": -2, "adjective": -2},
    "her": {"verb": 3, "past": 3, "noun": -2, "adjective": -2},
    "preposition": {"noun": 0.5, "verb": 0.5, "past": 0.5},
    "be": {"noun": 2.5},
    "modal": {"noun": 2},
    "have": {"noun": 2},
    "particle": {"verb": 1.5, "past": 1.5},
    "singular": {"adjective": 1, "verb": 0.5},
    "plural": {"adjective": 1, "verb": 0.5},
    "to": {"verb": 0.5, "past": 0.5},
    END: {"noun": 0.5},
}
"""By the class of the word after."""


def class_of(word: str) -> str:
    """The class of a word in small letters; END for a mark or nothing."""
    if not word or word in _MARKS:
        return END
    if found := _classes().get(word):
        return found
    for name, endings in ENDINGS.items():
        if word.endswith(endings):
            return name
    return "plural" if word.endswith("s") and not word.endswith(("ss", "us")) else "singular"


@cache
def _classes() -> Mapping[str, str]:
    """The classes of known words."""
    return {word: name for name in BEFORE if name != END for word in _listed().get(name, ())}


def _group(name: str) -> frozenset[str]:
    """Words of several classes that a rule looks at."""
    return _listed()[f"({name})"]


@cache
def _listed() -> Mapping[str, frozenset[str]]:
    """The words of `word_classes.txt` by their names; a line that begins with spaces goes on."""
    text = files(__package__).joinpath("word_classes.txt").read_text(encoding="utf-8")
    lines = text.replace("\n    ", " ").splitlines()
    named = (line.partition(":") for line in lines if not line.startswith("#"))
    return {name: frozenset(words.split()) for name, _, words in named}


def votes(words: Sequence[str], place: int) -> dict[str, float]:
    """Points for each part of speech of the word at a place; words are in small letters."""
    before = [*map(class_of, reversed(words[max(place - WINDOW, 0) : place])), END]
    after = class_of(words[place + 1] if place + 1 < len(words) else "")
    if before[0] in _NOUNS and before[1] in _BEFORE_VERBS:
        before[0] = "known verb"
    if words[place - 1 : place] == ["it"] and before[1] in _BEFORE_SUBJECTS:
        before[0] = "singular subject"
    two_before = words[place - 2] if place > 1 else ""
    told = [BEFORE[before[0]], AFTER.get(after, {})]
    if before[0] in ("adverb", "not", "degree"):
        told.append(BEFORE[before[1]])
    if before[0] == "to" and two_before in _group("to something"):
        told.append({"verb": -3, "noun": 3})
    if before[0] in ("object", "her") and two_before in _group("causing"):
        told.append({"verb": 4})
    if _is_third_person(words, place):
        told.append({"verb": 3, "noun": -4})
    elif _is_in_phrase(before):
        told.append({"noun": 2, "adjective": 1})
    told.append(ASKED.get(_asking(words[:place]), {}))
    return {part: sum(one.get(part, 0.0) for one in told) for part in PARTS_OF_SPEECH}


def _is_third_person(words: Sequence[str], place: int) -> bool:
    """Whether the word has an -s that its determiner excludes: "a program that refuses"."""
    is_form = words[place].endswith("s") and not words[place].endswith("ss")
    return is_form and place > 0 and words[place - 1] in _group("one")


def _is_in_phrase(before: Sequence[str]) -> bool:
    """Whether an article stands before, with only what describes a noun between."""
    for name in before:
        if name in ("article", "possessive"):
            return True
        if name not in ("adjective", "singular", "-ed", "-ing", "number", "degree"):
            break
    return False


def _asking(before: Sequence[str]) -> str:
    """The class of the auxiliary of a question that waits for its verb: "what can your robot"."""
    for place in range(len(before) - 2, -1, -1):
        word, last = before[place], before[place - 1] if place else ""
        begins = word in _group("doing") or class_of(last) in _ASKERS
        if class_of(word) in ASKED and (begins or last in _group("asking")):
            subject = [class_of(one) for one in before[place + 1 :]]
            return class_of(word) if _is_subject(subject) else ""
    return ""


def _is_subject(names: Sequence[str]) -> bool:
    """Whether words of these classes are a pronoun, or a noun and what describes it."""
    if len(names) == 1 and names[0] in _PRONOUNS:
        return True
    is_one = not {"article", "possessive"} & {*names[1:]}
    return is_one and names[-1] in _NOUNS and {*names} <= _NOUNS | _DESCRIBING
