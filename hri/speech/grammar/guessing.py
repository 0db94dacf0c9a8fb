"""What a typed text most likely means that no sentence of a grammar allows.

It is compared with the paraphrases that the author, or others, wrote down: see
`hri.speech.grammar.paraphrases`.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from hri.speech.grammar import analysis
from hri.speech.grammar.doc_comments import LAST
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.naive_bayes import NaiveBayes
from hri.speech.grammar.paraphrases import Paraphrases
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.words import normalize

LEAST_SURE = 0.5
"""Probability from which a guess counts. In talks that it had not seen, seven of ten such guesses
are what a reader held for meant, and most of the rest is near it; where another command stands in
the text, the guess is right six times as often as that command."""
MOST_STRANGE = 1 / 3
"""Share of the words of a text that may be in no paraphrase."""
MOST_WORDS = 30
"""A longer text is a story."""
MOST_TRIED = 20
"""Sentences of a rule that are looked at for one that stands for its paraphrases."""


class Guess(NamedTuple):
    """The rule whose paraphrases a text is most like."""

    rule: str
    probability: float
    """0 to 1."""
    is_vague: bool
    """Whether the text may only be about it."""


def guess_rule(grammar: Grammar, text: str) -> Guess | None:
    """The rule that a typed text is most like; None if it is like none, or means none."""
    words = normalize(text)
    if not grammar.paraphrases or not 0 < len(words) <= MOST_WORDS:
        return None
    classifier = _classifier(grammar.paraphrases)
    strange = [word for word in words if not classifier.knows(word)]
    if len(strange) > MOST_STRANGE * len(words) or not _other_words(grammar).isdisjoint(strange):
        return None
    found = classifier.predict(words)
    if found is None or found.label not in grammar.public_rules:
        return None
    return Guess(found.label, found.probability, found.label in _vague(grammar))


def paraphrased(
    grammar: Grammar,
    text: str,
    rules: Collection[str] | None = None,
    part: Parse | None = None,
) -> Parse | None:
    """What a typed text says in other words, as a sentence of the grammar; None without a sure one.

    `rules` are the public rules that count; None is all. `part` is the command that stands in the
    text: "hi" in "hi I broke my arm". What may move the robot, or stops it, counts before a guess.
    Raises AuthoringError where `Grammar.automaton` does.
    """
    found = guess_rule(grammar, text)
    if found is None or found.is_vague or found.probability < LEAST_SURE:
        return None
    if part is not None and not _may_give_way(grammar, part):
        return None
    is_out = rules is not None and found.rule not in rules
    return None if is_out else _sentence_of(grammar, found.rule)


def _may_give_way(grammar: Grammar, part: Parse) -> bool:
    """Whether a command that stands in a text neither moves the robot nor stops it."""
    command = grammar.rules[part.rule].stands_for or part.rule
    return command != LAST and command not in _vague(grammar) | grammar.marked("interrupts")


def _vague(grammar: Grammar) -> frozenset[str]:
    """The rules that a text may only be about."""
    return frozenset().union(*(each.vague for each in grammar.paraphrases))


def _sentence_of(grammar: Grammar, rule: str) -> Parse | None:
    """A sentence that means a rule; None if each means something else before it."""
    texts = chain(grammar.rules[rule].examples, grammar.sentences_of(rule, MOST_TRIED))
    parses = (parse(grammar, text) for text in texts)
    return next((one for one in parses if one is not None and one.rule == rule), None)


def _other_words(grammar: Grammar) -> frozenset[str]:
    """The words of rules that have no paraphrases: they speak for these rules."""
    return grammar.made(_words_without_paraphrases)


def _words_without_paraphrases(grammar: Rules) -> frozenset[str]:
    known = {rule for each in grammar.paraphrases for rule, _ in each.heads}
    others = [
        key
        for key in grammar.public_rules
        if known.isdisjoint((key, grammar.rules[key].stands_for or key))
    ]
    return analysis.words_of(grammar.rules, others)


@lru_cache(maxsize=1)
def _classifier(files: tuple[Paraphrases, ...]) -> NaiveBayes:
    """Made when it is first needed, in half a second for 15,000 lines."""
    return NaiveBayes(line for each in files for line in each.lines)
