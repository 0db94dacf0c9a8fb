"""Common words just beside the lists of a grammar: not listed, and in sound much like an entry.

A list is what one rule gives one tag as values. Its entries are compared word by word with common
words of English, those of a list of people with first names: that is what would be said in their
place. Only words of one class are compared ("chairs" is nobody's "chair"), by the distance of
`hri.speech.grammar.lint.confusion`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from hri.core.errors import Place
from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import Expression, Tagged
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.confusion import (
    FARTHEST,
    NEAREST,
    Change,
    counted,
    distances_of,
    numbered,
    phones_of,
)
from hri.speech.grammar.lint.finding import Finding, hint
from hri.speech.grammar.phrases import PhrasesOf, phrases_of_rules
from hri.speech.grammar.rules import Rule
from hri.speech.grammar.tags import Reference, Template, Value
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.names import first_names
from hri.speech.pronunciation.phones import distance
from hri.speech.pronunciation.spelling import vocabulary
from hri.speech.pronunciation.word_classes import class_of

LONGEST_ENTRY = 3
"""Words of an entry; a longer one differs from others in more than one of them."""
MOST_ENTRIES = 20_000
"""Of a list; what is beyond is left out."""
MOST_COMPARED = 2000
"""Words of a list that are compared, the first ones."""
MOST_CHECKED = 300
"""The same where the author did not ask for it."""
FEWEST_CHECKED = 5
"""Values of a list that is looked at then: of fewer, each is listened for with care."""
CONFUSABLE = 0.25
"""Distance up to which two phones are taken for each other: P and T, S and SH, EH and AE."""
MOST_TOLD = 3
NAMES = 3
"""A list with more first names than one word in this many is one of people."""
_BLOCK = 512


@dataclass(frozen=True, slots=True)
class Entry:
    """One way to say a value of a list."""

    text: str
    value: Value
    place: Place


@dataclass(frozen=True, slots=True)
class ValueList:
    """What one rule gives one tag as values."""

    rule: Rule
    tag: str
    entries: list[Entry] = field(default_factory=list)

    @property
    def size(self) -> int:
        """How many values it has."""
        return len({entry.value for entry in self.entries})

    @property
    def words(self) -> dict[str, Entry]:
        """The words of its entries in the order of writing, each with the first entry it is in."""
        words: dict[str, Entry] = {}
        for entry in self.entries:
            for word in entry.text.split():
                words.setdefault(word, entry)
        return words


@dataclass(frozen=True, slots=True)
class Beside:
    """A word of an entry, and the common words that sound like it."""

    rule: Rule
    tag: str
    entry: Entry
    word: str
    outside: tuple[tuple[str, float], ...]
    """Each with its distance, the nearest first."""


def value_lists(grammar: Grammar) -> list[ValueList]:
    """The lists of the rules that are heard, in the order in which they are met.

    A tag that always has one value there is left out.
    """
    phrases = PhrasesOf(phrases_of_rules(grammar, LONGEST_ENTRY), LONGEST_ENTRY)
    found: dict[tuple[str, str], ValueList] = {}
    for key in analysis.reachable(grammar.rules, grammar.spoken_rules):
        rule = grammar.rules[key]
        for node in rule.nodes:
            for name, value in _values(node):
                of_tag = found.setdefault((key, name), ValueList(rule, name))
                place = rule.place(node.span)
                said = sorted(map(" ".join, phrases(node).said))
                room = MOST_ENTRIES - len(of_tag.entries)
                of_tag.entries.extend(Entry(text, value, place) for text in said[:room])
    return [each for each in found.values() if each.size > 1]


def _values(node: Expression) -> Iterator[tuple[str, Value]]:
    """The tags that a node sets, each with its value, where that is written there."""
    if isinstance(node, Tagged):
        for entry in node.entries:
            if entry.operation != "*=" and not isinstance(entry.value, Reference | Template):
                yield entry.name, entry.value


def beside(
    lists: Sequence[ValueList],
    lexicon: Lexicon,
    farthest: float = FARTHEST,
    most: int = MOST_COMPARED,
) -> Iterator[Beside]:
    """The words of entries that have common words no farther away, list by list.

    `most` words of each list are looked at. What another list has for the same tag is not outside,
    and words that would have to be guessed are left out.
    """
    listed: dict[str, set[str]] = {}
    for each in lists:
        listed.setdefault(each.tag, set()).update(each.words)
    for each in lists:
        words = each.words
        known = [word for word in words if lexicon.known(word)][:most]
        is_of_names = NAMES * len(first_names().intersection(known)) > len(known)
        near = _common(lexicon, is_of_names).near(known, listed[each.tag], farthest)
        for word, outside in near.items():
            if is_of_names:  # "Sara" is another spelling of "Sarah".
                outside = tuple(other for other in outside if other[1] > 0.0)
            if outside:
                yield Beside(each.rule, each.tag, words[word], word, outside)


class _Common:
    """Common words by their sounds."""

    def __init__(self, words: frozenset[str], lexicon: Lexicon) -> None:
        self._lexicon = lexicon
        spoken = {word: said[0] for word in sorted(words) if (said := lexicon.known(word))}
        self._words = list(spoken)
        self._counts = counted([numbered(phones) for phones in spoken.values()])
        self._squares = (self._counts**2).sum(axis=1)

    def near(
        self, words: Sequence[str], listed: set[str], farthest: float
    ) -> dict[str, tuple[tuple[str, float], ...]]:
        """By each of the words that has any: others of its class that are not farther away."""
        pairs: list[tuple[Change, ...]] = []
        for start in range(0, len(words), _BLOCK):
            block = words[start : start + _BLOCK]
            counts = counted([phones_of((word,), self._lexicon) for word in block])
            apart = self._squares - 2 * counts @ self._counts.T
            nearest = np.argpartition(apart, NEAREST)[:, :NEAREST]
            for word, places in zip(block, nearest.tolist(), strict=True):
                for other in map(self._words.__getitem__, places):
                    if other not in listed and class_of(other) == class_of(word):
                        pairs.append((((other,), (word,)),))
        found: dict[str, list[tuple[str, float]]] = {}
        distances = distances_of(pairs, self._lexicon)
        for pair in sorted(pairs, key=distances.__getitem__):
            (((other,), (word,)),) = pair
            if distances[pair] <= farthest:
                found.setdefault(word, []).append((other, distances[pair]))
        return {word: tuple(others) for word, others in found.items()}


@lru_cache(maxsize=4)
def _common(lexicon: Lexicon, is_of_names: bool) -> _Common:
    return _Common(first_names() if is_of_names else vocabulary(), lexicon)


def heard_as_listed(grammar: Grammar, lexicon: Lexicon) -> Iterator[Finding]:
    """For each list of the main file: words that are one phone away from an entry of one word."""
    lists = [
        each
        for each in value_lists(grammar)
        if _is_own(grammar, each.rule) and each.size >= FEWEST_CHECKED
    ]
    told: dict[tuple[str, str], list[tuple[str, Beside]]] = {}
    for near in beside(lists, lexicon, CONFUSABLE / 2, MOST_CHECKED):
        for other, _ in near.outside:
            if near.word == near.entry.text and _are_confusable(other, near.word, lexicon):
                told.setdefault((near.rule.key, near.tag), []).append((other, near))
    for (rule, _), pairs in told.items():
        pairs.sort(key=lambda pair: dict(pair[1].outside)[pair[0]])
        some = [f'"{other}" as "{near.word}"' for other, near in pairs[:MOST_TOLD]]
        more = f", and {len(pairs) - MOST_TOLD} more" if len(pairs) > MOST_TOLD else ""
        what = f"words beside <{rule}> may be heard as listed: {', '.join(some)}{more}"
        remedy = "list what people may say there, or see `hri grammar confuse`"
        yield hint(pairs[0][1].entry.place, what, remedy)


def _is_own(grammar: Grammar, rule: Rule) -> bool:
    """Whether a rule stands in the main file, or in a list of names that this one imports."""
    is_list = rule.path.suffix != grammar.path.suffix
    return rule.path == grammar.path or (is_list and "." not in rule.key)


def _are_confusable(one: str, other: str, lexicon: Lexicon) -> bool:
    """Whether two words differ in one phone, which is taken for the other one."""
    first, second = lexicon.known(one)[0], lexicon.known(other)[0]
    if len(first) != len(second):
        return False
    changed = [pair for pair in zip(first, second, strict=True) if pair[0] != pair[1]]
    return len(changed) == 1 and distance(*changed[0]) <= CONFUSABLE
