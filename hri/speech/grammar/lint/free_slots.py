"""Limits and lists of free slots that say nothing, or too much."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hri.core.errors import Place, did_you_mean
from hri.speech.grammar.free_slots import Limits, limits, marks, read_limits, spoken_slots
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.lint.finding import Finding, warning

Lengths = Mapping[str, list[range]]
"""How many words each slot takes where it stands, by its name."""


def odd_slots(grammar: Grammar) -> Iterator[Finding]:
    """What the main file says of free slots and hardly means."""
    lengths: dict[str, list[range]] = {}
    for slot in grammar.made(spoken_slots).values():
        lengths.setdefault(slot.name, []).append(range(slot.least, slot.most + 1))
    yield from _odd_marks(grammar, lengths)
    yield from _odd_lists(grammar, lengths)


def _odd_marks(grammar: Grammar, lengths: Lengths) -> Iterator[Finding]:
    """Limits of no slot, and second limits of one."""
    first: dict[str, int] = {}
    for rule, tag in marks(grammar):
        limit = read_limits(tag)
        if limit is None or rule.path != grammar.path:
            continue
        written = f"<{limit.name}.spoken>"
        if limit.name not in lengths:
            remedy = f"write {written} in a rule, or take the mark out"
            what = f"@spoken limits {written}, which stands in no rule"
            yield warning(rule.place(tag.span), what, did_you_mean(limit.name, lengths, remedy))
        elif limit.name in first:
            what = f"{written} has limits in line {first[limit.name]}, and only the last ones count"
            yield warning(rule.place(tag.span), what, "take one of the two marks out")
        first.setdefault(limit.name, tag.span.line)


def _odd_lists(grammar: Grammar, lengths: Lengths) -> Iterator[Finding]:
    """Lists with words that cannot stand in the slot that they are for."""
    limited = grammar.made(limits)
    for use in grammar.known_lists:
        limit = limited.get(use.slot, Limits(use.slot))
        strange = [
            text
            for text in grammar.known.get(use.slot, ())
            if not limit.allow(text)
            or not any(len(text.split()) in each for each in lengths.get(use.slot, ()))
        ]
        if strange and use.slot in lengths:
            more = f" (and {len(strange) - 1} more)" if len(strange) > 1 else ""
            what = f'"{strange[0]}"{more} cannot stand in <{use.slot}.spoken>'
            place = Place(grammar.path, use.span.line, use.span.column)
            yield warning(place, what, f"take it out of {use.file}, or let the slot take it")
