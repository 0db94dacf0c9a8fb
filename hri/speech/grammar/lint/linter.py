"""Reports the mistakes in a grammar, and sentences that will be misheard."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import islice

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar import analysis
from hri.speech.grammar.doc_comments import KNOWN_TAGS, MARKS, OF_PARTS
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Tagged,
    children,
    heard_choices,
    spell,
    walk,
)
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.jsgf import Import, NameListImport
from hri.speech.grammar.lint.ambiguity import ambiguities
from hri.speech.grammar.lint.audibility import heard_badly
from hri.speech.grammar.lint.confusion import sound_alikes
from hri.speech.grammar.lint.finding import SEVERITIES, Finding, hint, warning
from hri.speech.grammar.lint.free_slots import odd_slots
from hri.speech.grammar.lint.operators import idle_operators
from hri.speech.grammar.lint.outside_words import heard_as_listed
from hri.speech.grammar.lint.overwriting import overwritten
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.phrases import Phrases, PhrasesOf, Words, phrases_of_rules
from hri.speech.grammar.rules import Rule
from hri.speech.grammar.tags import spell_tags
from hri.speech.language import complaint, foreign, says_english
from hri.speech.pronunciation.lexicon import Lexicon

__all__ = ["Finding", "check"]

MOST_SENTENCES = 200
"""Sentences whose sounds are compared."""
MOST_AMBIGUITIES = 10
MOST_ALIKE = 10
MOST_LIKE = 0.2
"""Distance up to which a careful rule sounds like another one."""
LONGEST_PHRASE = 3
"""Words of the alternatives that are compared with each other."""


def check(grammar: Grammar, lexicon: Lexicon | None = None) -> list[Finding]:
    """Errors if there are any, else warnings and hints, the worst first.

    Without a lexicon nothing is said about how words sound, nor of a grammar that is not English.
    """
    errors = [Finding("error", e.place, e.what, e.remedy) for e in analysis.errors(grammar)]
    if errors:
        return errors
    try:
        return sorted(
            _opinions(grammar, lexicon), key=lambda found: SEVERITIES.index(found.severity)
        )
    except AuthoringError as error:  # It has more sentences than can be written out.
        return [Finding("error", error.place, error.what, error.remedy)]


def _opinions(grammar: Grammar, lexicon: Lexicon | None) -> list[Finding]:
    """What there is to say about a grammar that can be used."""
    said = phrases_of_rules(grammar, LONGEST_PHRASE)
    findings = [
        *(warning(odd.place, odd.what, odd.remedy) for odd in grammar.warnings),
        *_broken_examples(grammar),
        *_unknown_marks(grammar),
        *_idle_marks(grammar),
        *_unused(grammar),
        *_idle_imports(grammar),
        *odd_slots(grammar),
        *overwritten(grammar, _own_rules(grammar)),
        *idle_operators(grammar, _own_rules(grammar)),
        *_never_said(grammar),
        *_silent(grammar, said),
        *_said_twice(grammar, said),
        *_ambiguous(grammar),
    ]
    if language := foreign(grammar):
        findings.append(warning(Place(grammar.path), *complaint(grammar, language)))
    if lexicon is not None and (not language or says_english(grammar)):
        sounding = heard_badly(grammar, said, lexicon)
        findings += sounding
        if not any(finding.severity == "error" for finding in sounding):
            findings += [*_careful(grammar, lexicon), *heard_as_listed(grammar, lexicon)]
    return findings


def _own_rules(grammar: Grammar) -> Iterator[Rule]:
    """Without those of imported files, which have other authors."""
    return (rule for rule in grammar.rules.values() if rule.path == grammar.path)


def _broken_examples(grammar: Grammar) -> Iterator[Finding]:
    for rule, commands in _with_examples(grammar):
        for tag in rule.doc_tags:
            if tag.name == "example" and parse(commands, tag.text, (rule.key,)) is None:
                what = f'<{rule.key}> does not allow its example "{tag.text}"'
                yield Finding("error", rule.place(tag.span), what, "fix the rule or the example")


def _with_examples(grammar: Grammar) -> Iterator[tuple[Rule, Grammar]]:
    """The rules with examples, each with a grammar in which it is a command."""
    rules = [rule for rule in _own_rules(grammar) if rule.examples]
    yield from ((rule, grammar) for rule in rules if rule.is_public)
    parts = [rule for rule in rules if not rule.is_public]
    together = grammar.with_commands({rule.key for rule in parts})
    is_together = len(parts) > 1 and _fits(together)
    for rule in parts:
        yield rule, together if is_together else grammar.with_commands({rule.key})


def _fits(grammar: Grammar) -> bool:
    """Whether the commands can be written out side by side."""
    try:
        return bool(grammar.automaton)
    except AuthoringError:
        return False


def _unknown_marks(grammar: Grammar) -> Iterator[Finding]:
    for rule in _own_rules(grammar):
        for tag in rule.doc_tags:
            if tag.name not in KNOWN_TAGS:
                what = f"unknown mark @{tag.name}"
                yield warning(rule.place(tag.span), what, did_you_mean(tag.name, KNOWN_TAGS))


def _idle_marks(grammar: Grammar) -> Iterator[Finding]:
    for rule in _own_rules(grammar):
        for tag in rule.doc_tags:
            if tag.name in MARKS.keys() - OF_PARTS and not rule.is_public:
                what = f"@{tag.name} says nothing here, for <{rule.key}> is not public"
                yield warning(rule.place(tag.span), what, "mark the public rules that use it")


def _unused(grammar: Grammar) -> Iterator[Finding]:
    used = set(analysis.reachable(grammar.rules, grammar.public_rules))
    for rule in _own_rules(grammar):
        if rule.key not in used:
            what = f"<{rule.key}> is not used by any public rule"
            yield warning(rule.place(), what, "use it, make it public, or take it out")


def _idle_imports(grammar: Grammar) -> Iterator[Finding]:
    for use in grammar.idle_imports:
        place = Place(grammar.path, use.span.line, use.span.column)
        if not isinstance(use, Import):
            name = use.name if isinstance(use, NameListImport) else f"{use.slot}.spoken"
            yield warning(place, f"<{name}> is not used by any rule", "use it, or take it out")
        else:
            what = f"no rule uses <{use.grammar}.{use.rule}>, and what is imported is not a command"
            name = "name" if use.rule == "*" else use.rule
            remedy = f"write public <{name}> = <{use.grammar}.{name}>; or take it out"
            yield warning(place, what, remedy)


def _never_said(grammar: Grammar) -> Iterator[Finding]:
    for rule in _own_rules(grammar):
        alternatives = list(_alternatives(rule))
        if not all(map(heard_choices, alternatives)):
            for node in _unsayable(grammar, rule.expression):
                what = f'"{spell(node)}" can never be said, for <VOID> stands in it'
                yield warning(rule.place(node.span), what, "take it out")
        for node in alternatives:
            if 0.0 not in node.weights:
                continue
            for choice, weight in zip(node.choices, node.weights, strict=True):
                if weight == 0.0:
                    what = f'"{spell(choice)}" has the weight 0 and will not be heard'
                    yield warning(rule.place(choice.span), what, "raise its weight, or take it out")


def _unsayable(grammar: Grammar, node: Expression) -> Iterator[Expression]:
    """The largest parts of a node that have no sentence, where what is around them has one."""
    height = analysis.Height(grammar.made(analysis.heights))
    for child in children(node):
        if math.isinf(height(child)):
            yield child
        else:
            yield from _unsayable(grammar, child)


def _alternatives(rule: Rule) -> Iterator[Alternative]:
    return (node for node in rule.nodes if isinstance(node, Alternative))


def _silent(grammar: Grammar, said: Mapping[str, Phrases]) -> Iterator[Finding]:
    for key in grammar.public_rules:
        # What is only said with other rules may be left out there.
        if () in said[key].said and "part" not in grammar.rules[key].marks:
            what = f"<{key}> allows silence, which is never heard"
            yield warning(
                grammar.rules[key].place(), what, "leave at least one word outside of [ ] and *"
            )


def _said_twice(grammar: Grammar, known: Mapping[str, Phrases]) -> Iterator[Finding]:
    """Alternatives that say nothing which one before them does not say already."""
    for rule in _own_rules(grammar):
        for node in _alternatives(rule):
            yield from _said_before(rule, node, known)


def _said_before(rule: Rule, node: Alternative, known: Mapping[str, Phrases]) -> Iterator[Finding]:
    spelt: set[str] = set()
    said: set[Words] = set()
    phrases = PhrasesOf(known, LONGEST_PHRASE)
    for choice in node.choices:
        text = spell(choice)
        found = phrases(choice)
        if text in spelt or (found.is_all and found.said and found.said <= said):
            again = "stands twice among" if text in spelt else "is said already by others of"
            what = f'"{text}" {again} these alternatives'
            if _has_tags(choice):
                what += ", and its tags will not count"
            yield warning(rule.place(choice.span), what, "take the second one out")
        spelt.add(text)
        said |= found.said


def _has_tags(node: Expression) -> bool:
    return any(isinstance(below, Tagged) for below in walk(node))


def _ambiguous(grammar: Grammar) -> Iterator[Finding]:
    for two in islice(ambiguities(grammar), MOST_AMBIGUITIES):
        what = f'"{two.sentence}" means {_meaning(two.first)}, and also {_meaning(two.second)}'
        place = grammar.rules[two.first.rule].place()
        yield warning(place, what, "only the first counts: say one of them in other words")


def _meaning(reading: Parse) -> str:
    tags = spell_tags(reading.tags)
    return f"<{reading.rule}>" + (f" {{{tags}}}" if tags else "")


def _careful(grammar: Grammar, lexicon: Lexicon) -> Iterator[Finding]:
    """Rules that move the robot and sound like others."""
    careful = grammar.marked("careful")
    if not careful:
        return
    heard = grammar.spoken_rules
    sentences = grammar.sample(MOST_SENTENCES, heard)
    readings = [found for text in sentences if (found := parse(grammar, text, heard)) is not None]
    told = 0
    for pair in sound_alikes(readings, lexicon, MOST_LIKE):
        first, second = sorted((pair.first, pair.second), key=lambda said: said.rule not in careful)
        if first.rule in careful and first.rule != second.rule and told < MOST_ALIKE:
            told += 1
            what = f'"{first.text}" sounds much like "{second.text}" <{second.rule}>'
            remedy = f"<{first.rule}> is @careful: say one of them in other words"
            yield hint(grammar.rules[first.rule].place(), what, remedy)
