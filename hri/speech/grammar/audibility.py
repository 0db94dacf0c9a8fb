"""What will be heard badly: words nobody knows, and commands too short to be told from talk."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hri.core.errors import HriError, NotAvailable, Place
from hri.speech.grammar.expressions import Token
from hri.speech.grammar.finding import Finding, hint, warning
from hri.speech.grammar.phrases import Phrases, Words
from hri.speech.grammar.rules import Grammar
from hri.speech.pronunciation import spelling
from hri.speech.pronunciation.lexicon import Lexicon, user_lexicon

FEWEST_PHONES = 4
"""Commands with fewer phones are heard in other people's talk (measured: "banana" as "no")."""
MOST_UNKNOWN = 20
"""Words that are told one by one."""
MOST_SHORT = 5
"""Short commands that are told one by one."""
EXPECTED_SHORT = frozenset(("answer", "wake", "part"))
"""Marks of rules that may be short: heard in few moments, guards of the rest, or no commands."""


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
    short = list(_short_commands(grammar, said, phones, places))
    for words, place in short[:MOST_SHORT]:
        what = f'"{" ".join(words)}" is very short and will be heard in other talk'
        remedy = "add a longer way to say it, or mark the rule @answer if it answers"
        findings.append(warning(place, what, remedy))
    if len(short) > MOST_SHORT:
        what = f"{len(short) - MOST_SHORT} more commands are as short"
        findings.append(warning(short[MOST_SHORT][1], what, "do the same with them"))
    return findings


def _places(grammar: Grammar) -> dict[str, Place]:
    """Every word of the grammar and where it is first written."""
    places: dict[str, Place] = {}
    for rule in grammar.rules.values():
        for node in rule.nodes:
            if isinstance(node, Token) and node.text not in places:
                places[node.text] = rule.place(node.span)
    return places


def _unknown(word: str, place: Place, lexicon: Lexicon) -> Finding:
    what = f'"{word}" is in no dictionary, its sound is guessed'
    if any(letter.isdigit() for letter in word):
        return warning(place, what, 'write numbers as words, "ten"')
    parts = spelling.split(word, lexicon)
    if parts:
        return warning(place, what, f'write "{parts}"?')
    meant = spelling.near(word, lexicon)
    if meant:
        return warning(place, what, f'did you mean "{meant}"?')
    otherwise = f"write it into {user_lexicon()}"
    try:
        guessed = " ".join(lexicon.pronunciations(word)[0])
    except NotAvailable:
        return hint(place, f'"{word}" is in no dictionary', otherwise)
    except HriError as error:
        wrong, _, remedy = str(error).partition(" - ")
        return Finding("error", place, wrong, remedy)
    return hint(place, what, f'if it is not "{guessed}", {otherwise}')


def _short_commands(
    grammar: Grammar,
    said: Mapping[str, Phrases],
    phones: Mapping[str, int],
    places: Mapping[str, Place],
) -> Iterator[tuple[Words, Place]]:
    """Sentences of fewer than FEWEST_PHONES phones, unless their rules are EXPECTED_SHORT."""
    told: set[Words] = {()}
    for key in grammar.public_rules:
        if not EXPECTED_SHORT & grammar.rules[key].marks:
            for words in sorted(said[key].said - told):
                if sum(phones.get(word, FEWEST_PHONES) for word in words) < FEWEST_PHONES:
                    told.add(words)
                    yield words, places[words[0]]
