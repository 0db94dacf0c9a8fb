"""Free slots: `<name.spoken>` stands for words that nobody listed, and they are a value.

An author says what the words of a slot may look like in the comment of a rule:

    /** @spoken name 2-12 letters like "?*" without not */
    public <introduce> = my name is <name.spoken 1-2>;

and what they usually are by a list: `import "first_names.txt" as <name.spoken>;`. A slot is the
same wherever its name stands in a grammar.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase

from hri.hal.word_graph import MOST_LETTERS, SpokenSlot
from hri.speech.grammar.doc_comments import SPOKEN, DocTag
from hri.speech.grammar.expressions import Anything
from hri.speech.grammar.rules import Rule, Rules
from hri.speech.grammar.words import is_placeholder

LONGEST_PATTERN = 100
"""Characters behind "like"."""

_LIMITS = re.compile(
    r"(?P<name>[A-Za-z_]\w*)"
    r"(?:\s+(?P<least>\d{1,4})(?:\s*-\s*(?P<most>\d{1,4}))?\s+letters?)?"
    r'(?:\s+like\s+"(?P<like>[^"\s][^"]*)")?'
    r"(?:\s+without\s+(?P<without>\w[\w' -]*))?"
)


@dataclass(frozen=True, slots=True)
class Limits:
    """What an author says of a slot behind @spoken."""

    name: str
    letters: tuple[int, int] = (1, MOST_LETTERS)
    """How many letters and digits its words have together, least and most."""
    like: str = ""
    """A pattern that its words have, as in `fnmatch`."""
    without: frozenset[str] = frozenset()
    """Words that it never has."""

    def allow(self, text: str) -> bool:
        """Whether lower case words with one space between may stand in the slot."""
        if any(map(is_placeholder, text.split())):
            return True  # It stands for words that may.
        least, most = self.letters
        fits = least <= sum(map(str.isalnum, text)) <= most
        is_like = not self.like or fnmatchcase(text, self.like)
        return fits and is_like and self.without.isdisjoint(text.split())


def read_limits(tag: DocTag) -> Limits | None:
    """What stands behind @spoken; None for what is not understood."""
    match = _LIMITS.fullmatch(tag.text)
    if match is None or not any(match[part] for part in ("least", "like", "without")):
        return None
    least, most = 1, MOST_LETTERS
    if match["least"] is not None:
        least = int(match["least"])
        most = int(match["most"] or least)
    like = match["like"] or ""
    if not 1 <= least <= most <= MOST_LETTERS or len(like) > LONGEST_PATTERN:
        return None
    without = (match["without"] or "").lower().split()
    return Limits(match["name"], (least, most), like.lower(), frozenset(without))


def marks(grammar: Rules) -> Iterator[tuple[Rule, DocTag]]:
    """Each @spoken, with the rule that has it, in the order of writing."""
    for rule in grammar.rules.values():
        for tag in rule.doc_tags:
            if tag.name == SPOKEN:
                yield rule, tag


def limits(grammar: Rules) -> Mapping[str, Limits]:
    """What may stand in each slot that a mark limits, by its name."""
    found = (read_limits(tag) for _, tag in marks(grammar))
    return {each.name: each for each in found if each is not None}


def spoken_slots(grammar: Rules) -> Mapping[str, SpokenSlot]:
    """The free slots of all rules, by how they are written in a word graph."""
    nodes = {
        node.written: node
        for rule in grammar.rules.values()
        for node in rule.nodes
        if isinstance(node, Anything) and node.slot
    }
    limited = grammar.made(limits)
    slots = {}
    for written, node in nodes.items():
        limit = limited.get(node.slot, Limits(node.slot))
        known = tuple(text for text in grammar.known.get(node.slot, ()) if limit.allow(text))
        slots[written] = SpokenSlot(
            node.slot, node.least, node.most, known, limit.letters, limit.like, limit.without
        )
    return slots
