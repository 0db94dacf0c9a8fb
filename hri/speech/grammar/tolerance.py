"""Sentences that people really say: with "um" and "please", with "go go", with an article missing.

`nearest(grammar, text)` finds the sentence of the grammar that a text comes down to when little
words are taken out or put in and words said twice are taken once. Every such edit has a cost, and
the cheapest set of them wins; words that carry meaning are never put in, and only taken out when
they repeat the word before. The search is Dijkstra's, over the words of the text and the states
of the matcher.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.matching import MOST_WORDS, Matcher, Parse, State, as_written, parse
from hri.speech.grammar.words import typed

MOST_COST = 2.0
"""What all edits of a sentence may cost: about four little words."""
MOST_STEPS = 5_000
"""Places that are looked at before the search gives up, about 50 ms."""


class Cost(NamedTuple):
    """What an edit of a little word costs; None where it is not allowed."""

    extra: float | None
    """Said, but not in the grammar."""
    missing: float | None
    """In the grammar, but not said."""


_HESITATION = Cost(extra=0.1, missing=None)
_POLITENESS = Cost(extra=0.3, missing=0.5)
_ARTICLE = Cost(extra=0.4, missing=0.4)
_OPENING = Cost(extra=0.4, missing=None)
_LINK = Cost(extra=0.6, missing=0.6)

HESITATIONS = ("ah", "eh", "er", "erm", "hm", "hmm", "mm", "oh", "uh", "um")
LITTLE_WORDS: dict[str, Cost] = {
    **dict.fromkeys(HESITATIONS, _HESITATION),
    **dict.fromkeys(("please", "kindly"), _POLITENESS),
    **dict.fromkeys(("a", "an", "the"), _ARTICLE),
    **dict.fromkeys(
        ("actually", "alright", "hey", "just", "like", "now", "ok", "okay", "so", "then", "well"),
        _OPENING,
    ),
    **dict.fromkeys(("and", "of", "some", "that", "to"), _LINK),
}
"""Words that change nothing when they come or go. Answers ("yes", "no"), "not", numbers and
directions can never be among them."""
REPEATED = 0.5
"""Cost of a word that was said twice, also with a hesitation between."""


@dataclass(frozen=True, slots=True)
class Edit:
    """An extra word that was said, or a word of the grammar that was not."""

    kind: Literal["+", "-"]
    """"+" said beyond the grammar, "-" missing."""
    word: str
    cost: float
    position: int
    """The number of the word that was said, from 0; of the one behind for a missing word."""

    def __str__(self) -> str:
        return f"{self.kind}{self.word}"


@dataclass(frozen=True, slots=True)
class Tolerant:
    """A sentence of the grammar, and what had to be forgiven to reach it."""

    parse: Parse
    edits: tuple[Edit, ...] = ()
    """In the order of the sentence."""

    @property
    def cost(self) -> float:
        """The sum over all edits; 0 when the text is a sentence as it stands."""
        return round(sum(edit.cost for edit in self.edits), 3)


class _Place(NamedTuple):
    """Some words of the text are behind us, and some of the grammar."""

    position: int
    state: State
    has_meaning: bool
    """Whether one of the words was more than a little word."""
    trace: _Trace | None


class _Trace(NamedTuple):
    """What led to a place, the last step first: a word of the grammar, an edit, or both."""

    before: _Trace | None
    word: str
    edit: Edit | None


def nearest(
    grammar: Grammar,
    text: str,
    most: float = MOST_COST,
    rules: Collection[str] | None = None,
) -> Tolerant | None:
    """The sentence of the grammar that a text comes down to; None when edits must cost over `most`.

    Of equally cheap ones the first found wins. `rules` are the public rules that count; None is
    all. Raises AuthoringError where `Grammar.automaton` does.
    """
    exact = parse(grammar, text, rules)
    if exact is not None:
        return Tolerant(exact)
    said = typed(text)
    matcher = grammar.made(as_written)  # Among other words everything would fit.
    forms = matcher.forms(said)
    words = next((words for words in forms if _may_be_forgiven(matcher, words, said)), [])
    if not 0 < len(words) <= MOST_WORDS:
        return None
    for trace in _cheapest_first(words, matcher.begin(), most):
        steps = _unwound(trace)
        edits = tuple(step.edit for step in steps if step.edit is not None)
        made = [step for step in steps if step.word]
        found = parse(grammar, " ".join(step.word for step in made), rules)
        put_in = {number for number, step in enumerate(made) if step.edit is not None}
        # Only what was said fills a free slot.
        if found is not None and not _is_moved(edits) and put_in.isdisjoint(found.free):
            return Tolerant(found, edits)
    return None


def _is_moved(edits: Collection[Edit]) -> bool:
    """Whether a word stands elsewhere than in the grammar: "is that right" asks."""
    said = {edit.word for edit in edits if edit.kind == "+"}
    return any(edit.kind == "-" and edit.word in said for edit in edits)


def _may_be_forgiven(matcher: Matcher, words: list[str], said: list[str]) -> bool:
    """Whether every word is one of the grammar's or a little one; "oh" in 100 is a number."""
    known, heard = matcher.words, {*said}
    return all(
        (word in known or word in LITTLE_WORDS) and (word in heard or word not in HESITATIONS)
        for word in words
    )


def _cheapest_first(words: list[str], begin: State, most: float) -> Iterator[_Trace | None]:
    """Ways from the beginning of both to the end of both, at most MOST_STEPS places apart."""
    order = itertools.count()
    pending = [(0.0, 0, next(order), _Place(0, begin, False, None))]
    done: set[tuple[int, State, bool]] = set()
    for _ in range(MOST_STEPS):
        if not pending:
            return
        cost, _, _, place = heapq.heappop(pending)
        key = (place.position, place.state, place.has_meaning)
        if key in done:
            continue
        done.add(key)
        if place.position == len(words) and place.state.is_final and place.has_meaning:
            yield place.trace
        for price, further in _further(words, place):
            total = round(cost + price, 3)
            if total <= most:
                # Equally cheap: who is further comes first, then who was found first.
                heapq.heappush(pending, (total, -further.position, next(order), further))


def _further(words: list[str], place: _Place) -> Iterator[tuple[float, _Place]]:
    """The places one step on, and what the steps cost."""
    position, state, has_meaning, trace = place
    word = words[position] if position < len(words) else ""
    if word:
        behind = position + 1
        step = state.step(word)
        if step is not None:
            is_little = word in LITTLE_WORDS
            yield (
                0.0,
                _Place(behind, step.state, has_meaning or not is_little, _Trace(trace, word, None)),
            )
        price = _price_of_extra(words, position)
        if price is not None:
            edit = Edit("+", word, price, position)
            yield price, _Place(behind, state, has_meaning, _Trace(trace, "", edit))
    for little, cost in LITTLE_WORDS.items():
        if cost.missing is not None and (step := state.step(little)) is not None:
            edit = Edit("-", little, cost.missing, position)
            yield (
                cost.missing,
                _Place(position, step.state, has_meaning, _Trace(trace, little, edit)),
            )


def _price_of_extra(words: list[str], position: int) -> float | None:
    """What it costs to take a word out; None when it must stay."""
    said = (word for word in reversed(words[:position]) if word not in HESITATIONS)
    is_repeated = next(said, "") == words[position]
    little = LITTLE_WORDS.get(words[position])
    prices = [
        price
        for price in (REPEATED if is_repeated else None, little and little.extra)
        if price is not None
    ]
    return min(prices, default=None)


def _unwound(trace: _Trace | None) -> list[_Trace]:
    steps = []
    while trace is not None:
        steps.append(trace)
        trace = trace.before
    return steps[::-1]
