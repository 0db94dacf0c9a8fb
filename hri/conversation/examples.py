"""Sentences of a grammar that show people what can be said, and which of them is near a text."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from itertools import islice

from hri.conversation.gist import Gist, stem
from hri.speech.grammar import Grammar, expansion, parse
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.slot_values import values_of
from hri.speech.grammar.words import ANY, normalize

MOST_COMPARED = 400
"""Sentences of a rule that are looked at for different ones."""
MOST_SHOWN = 3
"""Sentences of a rule that are shown."""
PERSONAL = ("i", "i'm", "i've", "i'd", "i'll", "my", "we", "you are", "you're", "your", "he", "she")
"""What people say of themselves and of the robot begins so: no one is told to say such a thing."""
MOST_NAMED = 4
"""Answers to a question that are all shown; of more, two are."""
LEAST_SHARED = 2
"""Words that a text has in common with a sentence that is like it."""
ALIKE = 0.6
"""Share of letters in common, of 1, from which a text is like a sentence."""


def different(grammar: Rules, rule: str) -> Iterator[str]:
    """Sentences of a rule that do not begin with one another, as "large" and "large please" do."""
    told: list[str] = []
    for text in expansion.sentences(grammar, (rule,), MOST_COMPARED):
        is_new = not any(f"{text} ".startswith(f"{one} ") for one in told)
        if text and is_new and ANY not in text:
            told.append(text)
            yield text


def example_of(grammar: Rules, rule: str) -> str:
    """What the comment of a rule gives as an example, else its first sentence; perhaps empty.

    The example of a rule that counts among other words has such words, which do not help.
    """
    given = () if "anywhere" in grammar.rules[rule].marks else grammar.rules[rule].examples
    return given[0] if given else next(different(grammar, rule), "")


def commands_of(grammar: Rules) -> list[str]:
    """The rules that can be said at any time; the own ones of its file come first."""
    others = grammar.marked("answer") | grammar.marked("after") | grammar.marked("typed")
    rules = [rule for rule in grammar.public_rules if rule not in others]
    return sorted(rules, key=lambda rule: grammar.rules[rule].path != grammar.path)


def is_personal(sentence: str) -> bool:
    """Whether it says something of a person, which may be sad or rude, and asks nothing."""
    return f"{sentence} ".startswith(tuple(f"{one} " for one in PERSONAL))


def sayings(grammar: Rules) -> dict[str, list[str]]:
    """Up to MOST_SHOWN sentences of each command by its rule, the best example first.

    Found once. What people say of themselves is left out, and rules of which that is the example.
    """
    return grammar.made(_sayings)


def _sayings(grammar: Rules) -> dict[str, list[str]]:
    found = {}
    for rule in commands_of(grammar):
        if any(map(is_personal, grammar.rules[rule].examples[:1])):
            continue
        others = islice(different(grammar, rule), 2 * MOST_SHOWN)
        texts = dict.fromkeys((example_of(grammar, rule), *others))
        if shown := [text for text in texts if text and not is_personal(text)][:MOST_SHOWN]:
            found[rule] = shown
    return found


def answers_shown(grammar: Grammar, tag: str | None = None) -> list[str]:
    """Sentences of its files that mean different things: all where they are few, else two.

    With a tag, those that give it different values.
    """
    others = grammar.marked("interrupts")
    # What may be said around an answer belongs to other grammars.
    own = [rule for rule in grammar.public_rules if rule not in others and "." not in rule]
    shown = [text for rule in own for text in grammar.rules[rule].examples]
    shown += [text for rule in own for text in _answers_for(grammar, rule, tag)]
    texts = _of_different_meaning(grammar, shown, tag)
    return texts if len(texts) <= MOST_NAMED else texts[:2]


def _answers_for(grammar: Grammar, rule: str, tag: str | None) -> Iterator[str]:
    """Sentences of a rule, or of what gives a tag its value there."""
    values = values_of(grammar, rule, tag) if tag else grammar
    for key in values.public_rules if tag else [rule]:
        yield from islice(different(values, key), MOST_NAMED + 1)


def _of_different_meaning(grammar: Grammar, texts: Iterable[str], tag: str | None) -> list[str]:
    """The first text of each value of a tag; any tag where none is given."""
    found: dict[object, str] = {}
    for text in texts:
        parsed = parse(grammar, text)
        if parsed is not None and (not tag or tag in parsed.tags):
            value = parsed.tags[tag] if tag else tuple(sorted(parsed.tags.items()))
            found.setdefault(value if value != () else text, text)
    return list(found.values())


def are_alike(text: str, sentence: str) -> bool:
    """Whether a text has at least half of its words, and two, in common with a sentence."""
    words = set(map(stem, normalize(text)))
    shared = words & set(map(stem, normalize(sentence)))
    return len(shared) >= max(LEAST_SHARED, len(words) / 2)


def nearest_sentence(grammar: Rules, text: str) -> str:
    """The sentence that is most like a text, else one about the same; empty when none is near."""
    shown = sayings(grammar)
    every = [sentence for sentences in shown.values() for sentence in sentences]
    near = difflib.get_close_matches(text.lower(), every, n=1, cutoff=ALIKE)
    rule = "" if near else grammar.made(Gist.of).rule_of(text)
    return near[0] if near else next(iter(shown.get(rule, ())), "")
