"""Tells an author what is wrong with a grammar, and what will be heard badly."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from hri.core.errors import Place
from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import Alternative, Expression, Token, spell, walk
from hri.speech.grammar.rules import Grammar

Dictionary = Mapping[str, Sequence[str]]
"""Phones of the words an engine knows: {"go": ("G", "OW")}."""

FEWEST_PHONES = 4
"""Commands with fewer phones are heard in other people's talk (measured: "banana" as "no")."""
MOST_COMMANDS = 2000
"""Sentences that are looked at for shortness."""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something about a grammar that its author should know."""

    severity: Literal["error", "warning"]
    place: Place
    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.place}: {self.severity}: {self.what} - {self.remedy}"


def check(grammar: Grammar, dictionary: Dictionary | None = None) -> list[Finding]:
    """Errors if there are any, else warnings; without a dictionary words are not looked up."""
    errors = [Finding("error", e.place, e.what, e.remedy) for e in analysis.errors(grammar)]
    if errors:
        return errors
    warnings = [*_unused(grammar), *_duplicates(grammar), *_never(grammar), *_silent(grammar)]
    if dictionary is not None:
        warnings += [*_unknown_words(grammar, dictionary), *_short(grammar, dictionary)]
    return warnings


def _warning(place: Place, what: str, remedy: str) -> Finding:
    return Finding("warning", place, what, remedy)


def _unused(grammar: Grammar) -> Iterator[Finding]:
    used = set(analysis.reachable(grammar.rules, grammar.public_rules))
    for key, rule in grammar.rules.items():
        if key not in used and rule.path == grammar.path:
            what = f"<{key}> is not used by any public rule"
            yield _warning(rule.place(), what, "use it, make it public, or take it out")


def _duplicates(grammar: Grammar) -> Iterator[Finding]:
    for rule in grammar.rules.values():
        for node in walk(rule.expression):
            if isinstance(node, Alternative):
                seen: set[str] = set()
                for choice in node.choices:
                    said = spell(choice)
                    if said in seen:
                        what = f'"{said}" stands twice among these alternatives'
                        yield _warning(rule.place(choice.span), what, "take the second one out")
                    seen.add(said)


def _never(grammar: Grammar) -> Iterator[Finding]:
    for rule in grammar.rules.values():
        for node in walk(rule.expression):
            if isinstance(node, Alternative):
                for choice, weight in zip(node.choices, node.weights, strict=True):
                    if weight == 0.0:
                        what = f'"{spell(choice)}" has the weight 0 and will not be heard'
                        yield _warning(rule.place(choice.span), what, "raise its weight")


def _silent(grammar: Grammar) -> Iterator[Finding]:
    silent = analysis.silent_rules(grammar.rules)
    for key in grammar.public_rules:
        if silent[key]:
            what = f"<{key}> allows silence, which is never heard"
            yield _warning(
                grammar.rules[key].place(), what, "leave at least one word outside of [ ] and *"
            )


def _unknown_words(grammar: Grammar, dictionary: Dictionary) -> Iterator[Finding]:
    told: set[str] = set()
    for rule in grammar.rules.values():
        for node in walk(rule.expression):
            if isinstance(node, Token) and node.text not in dictionary and node.text not in told:
                told.add(node.text)
                what = f'"{node.text}" is not in the dictionary, its sound is guessed'
                yield _warning(rule.place(node.span), what, _respelling(node.text, dictionary))


def _respelling(word: str, dictionary: Dictionary) -> str:
    if word.isdigit():
        return 'write numbers as words, "ten"'
    for cut in range(2, len(word) - 1):
        if word[:cut] in dictionary and word[cut:] in dictionary:
            return f'write "{word[:cut]} {word[cut:]}"?'
    near = difflib.get_close_matches(
        word, (known for known in dictionary if known[:1] == word[:1]), n=1, cutoff=0.75
    )
    return f'did you mean "{near[0]}"?' if near else "check how it is heard, or use another word"


def _short(grammar: Grammar, dictionary: Dictionary) -> Iterator[Finding]:
    told: set[str] = set()
    for sentence in grammar.sentences(MOST_COMMANDS):
        words = sentence.split()
        phones = sum(len(dictionary.get(word, ())) or FEWEST_PHONES for word in words)
        if phones < FEWEST_PHONES and sentence not in told:
            told.add(sentence)
            place = _place_of(grammar, words[0])
            what = f'"{sentence}" is very short and will be heard in other talk'
            yield _warning(place, what, "add a longer way to say it, or guard it with a name")


def _place_of(grammar: Grammar, word: str) -> Place:
    """Where a word is first written."""
    for key in analysis.reachable(grammar.rules, grammar.public_rules):
        rule = grammar.rules[key]
        for node in walk(rule.expression):
            if _is_word(node, word):
                return rule.place(node.span)
    return Place(grammar.path)


def _is_word(node: Expression, word: str) -> bool:
    return isinstance(node, Token) and node.text == word
