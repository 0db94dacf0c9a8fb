"""Finds commands that are hard to recognize: unknown words, and commands too short to stand out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from hri.core.errors import HriError, NotAvailable, Place
from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import Alternative, Token, spell
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.finding import Finding, hint, note, warning
from hri.speech.grammar.numerals import in_words
from hri.speech.grammar.phrases import Phrases, Words
from hri.speech.grammar.rules import Rule
from hri.speech.pronunciation import spelling
from hri.speech.pronunciation.lexicon import Lexicon, user_lexicon

FEWEST_PHONES = 4
"""Commands with fewer phones are heard in other people's talk (measured: "banana" as "no")."""
MOST_UNKNOWN = 20
"""Words that are told one by one."""
MOST_SHORT = 5
"""Short commands that are told one by one, and longer ones of one word."""
EXPECTED_SHORT = frozenset(("answer", "after", "typed", "wake", "part"))
"""Marks of rules that may be short: heard in few moments or never, guards of the rest, or no
commands."""


def heard_badly(grammar: Grammar, said: Mapping[str, Phrases], lexicon: Lexicon) -> list[Finding]:
    """What there is to say about how a grammar sounds; an error for a word that cannot be said.

    `said` has the short phrases of every rule.
    """
    places = _places(grammar)
    known = {word: variants for word in places if (variants := lexicon.known(word))}
    unknown = [word for word in places if word not in known]
    findings = [_unknown(word, places[word], lexicon) for word in unknown[:MOST_UNKNOWN]]
    if len(unknown) > MOST_UNKNOWN:
        what = f"the sounds of {len(unknown) - MOST_UNKNOWN} more words are guessed"
        remedy = "see them all with `hri grammar lexicon --missing`"
        findings.append(hint(places[unknown[MOST_UNKNOWN]], what, remedy))
    # Those words are not guessed, which could take seconds for a list of names.
    phones = {word: min(map(len, variants)) for word, variants in known.items()}
    short: list[Finding] = []
    single: list[Finding] = []
    remedy = "add a longer way to say it, or mark the rule @answer if it answers"
    for words, place in _commands(grammar, said):
        if sum(phones.get(word, FEWEST_PHONES) for word in words) < FEWEST_PHONES:
            what = f'"{" ".join(words)}" is very short and will be heard in other talk'
            short.append(warning(place, what, remedy))
        elif len(words) == 1:
            what = f'"{words[0]}" is one word and easily heard in other talk'
            single.append(note(place, what, remedy))
    return [*findings, *_first(short), *_first(single)]


def _first(findings: list[Finding]) -> list[Finding]:
    """At most MOST_SHORT, then how many more there are."""
    if len(findings) <= MOST_SHORT:
        return findings
    what = f"{len(findings) - MOST_SHORT} more commands are as short"
    rest = replace(findings[MOST_SHORT], what=what, remedy="do the same with them")
    return [*findings[:MOST_SHORT], rest]


def _places(grammar: Grammar) -> dict[str, Place]:
    """Every word that can be heard and where it is first written."""
    places: dict[str, Place] = {}
    spoken = [key for key in grammar.public_rules if "typed" not in grammar.rules[key].marks]
    heard = set(analysis.reachable(grammar.rules, spoken))
    for rule in (rule for key, rule in grammar.rules.items() if key in heard):
        for node in rule.nodes:
            if isinstance(node, Token) and node.text not in places:
                places[node.text] = rule.place(node.span)
    return places


def _unknown(word: str, place: Place, lexicon: Lexicon) -> Finding:
    what = f'"{word}" is in no dictionary, its sound is guessed'
    if any(letter.isdigit() for letter in word):
        return warning(place, what, f'write numbers as words, "{in_words(word)}"')
    meant = spelling.meant(word, lexicon)
    if meant:
        remedy = f'write "{meant}"?' if " " in meant else f'did you mean "{meant}"?'
        return warning(place, what, remedy)
    otherwise = f"write it into {user_lexicon()}"
    try:
        guessed = " ".join(lexicon.pronunciations(word)[0])
    except NotAvailable:
        return hint(place, f'"{word}" is in no dictionary', otherwise)
    except HriError as error:
        wrong, _, remedy = str(error).partition(" - ")
        return Finding("error", place, wrong, remedy)
    return hint(place, what, f'if it is not "{guessed}", {otherwise}')


def _commands(grammar: Grammar, said: Mapping[str, Phrases]) -> Iterator[tuple[Words, Place]]:
    """The short sentences of all rules that are not EXPECTED_SHORT, each once."""
    told: set[Words] = {()}
    for key in grammar.public_rules:
        if not EXPECTED_SHORT & grammar.rules[key].marks:
            found = said[key].said - told
            told |= found
            rule = grammar.rules[key]
            places = _whole(rule) if found else {}
            for words in sorted(found):
                yield words, places.get(" ".join(words)) or rule.place()


def _whole(rule: Rule) -> dict[str, Place]:
    """Where each command is that a rule writes whole, by its words."""
    choices = (
        choice for node in rule.nodes if isinstance(node, Alternative) for choice in node.choices
    )
    places: dict[str, Place] = {}
    for node in (*choices, rule.expression):
        places.setdefault(spell(node).lower(), rule.place(node.span))
    return places
