"""People that the robot knows: their names and sounds, their meetings, and what they told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal, Self, TypeVar

from hri.conversation.facts import Fact
from hri.core.privacy import is_named, is_same_name

T = TypeVar("T")
How = Literal["word", "nod"]
WAYS: tuple[How, ...] = ("word", "nod")
"""How someone allows something."""
MOST_PHONES = 100
"""Phones of a name."""
MOST_FACTS = 50
"""Facts of a person."""
MOST_FELT = 10
"""Feelings that are remembered of a person; the oldest give way."""
MOST_ASKED = 50
"""Questions that are remembered of a person; the oldest give way."""


@dataclass(frozen=True, slots=True)
class Consent:
    """A person has allowed to be remembered."""

    when: datetime
    how: How


@dataclass(frozen=True, slots=True)
class Felt:
    """What the robot felt when it was with a person."""

    feeling: str
    because: str
    when: datetime


@dataclass(frozen=True, slots=True)
class Asked:
    """A question that was asked in a meeting."""

    relation: str
    value: str
    """Of the fact that it was about; empty for one that asked for a fact."""
    question: str
    meeting: int


@dataclass(frozen=True, slots=True)
class KnownPerson:
    """A person as they are known at a moment. All times are wall times, to the second."""

    id: int
    """From 1; that of a person who was forgotten is not given to another one."""
    name: str
    since: datetime
    seen: datetime
    """When they were here last."""
    met: datetime
    """When this meeting, or the last one, began."""
    meetings: int = 1
    heard: tuple[str, ...] = ()
    """Phones of the CMU set, as the name was heard; none for one that was typed."""
    said: tuple[str, ...] = ()
    """Phones with which the robot says the name; none for as it is spelled."""
    consent: Consent | None = None
    """Without it the person is known in this run alone."""
    facts: tuple[Fact, ...] = ()
    """The newest last."""
    felt: tuple[Felt, ...] = ()
    asked: tuple[Asked, ...] = ()

    def values(self, relation: str) -> tuple[str, ...]:
        """What they told of a relation, the newest last."""
        return tuple(fact.value for fact in self.facts if fact.relation == relation)

    def has(self, relation: str, value: str) -> bool:
        """Whether they told this; capital letters do not count."""
        return any(fact.is_about(relation, value) for fact in self.facts)

    def is_called(self, name: str) -> bool:
        """Whether that is their name; capital letters do not count."""
        return is_same_name(self.name, name)

    def texts(self) -> Iterator[str]:
        """All that is written about them in words, their name first."""
        yield self.name
        for fact in self.facts:
            yield fact.value
            yield from (value for value in fact.values.values() if isinstance(value, str))
        yield from (felt.because for felt in self.felt)
        for asked in self.asked:
            yield from (asked.value, asked.question)

    def without(self, name: str) -> Self:
        """The same without what mentions someone else of that name."""
        return replace(
            self,
            facts=tuple(one for one in self.facts if not _mentions(one, name)),
            felt=tuple(one for one in self.felt if not is_named(name, one.because)),
            asked=tuple(
                one for one in self.asked if not is_named(name, f"{one.value} {one.question}")
            ),
        )


def merged(mine: KnownPerson, before: KnownPerson, theirs: KnownPerson) -> KnownPerson:
    """One edition of two that were both made from the one before, without all that either took
    out, and with all that either added, as far as there is room.
    """
    if mine == before:
        return theirs
    return replace(
        mine,
        seen=max(mine.seen, theirs.seen),
        met=max(mine.met, theirs.met),
        meetings=max(mine.meetings, theirs.meetings),
        facts=_joined(mine.facts, before.facts, theirs.facts, MOST_FACTS),
        felt=_joined(mine.felt, before.felt, theirs.felt, MOST_FELT),
        asked=_joined(mine.asked, before.asked, theirs.asked, MOST_ASKED),
    )


def _joined(
    mine: tuple[T, ...], before: tuple[T, ...], theirs: tuple[T, ...], most: int
) -> tuple[T, ...]:
    kept = tuple(one for one in mine if one in theirs or one not in before)
    added = tuple(one for one in theirs if one not in before and one not in kept)
    return (*added, *kept)[-most:]


def _mentions(fact: Fact, name: str) -> bool:
    texts = (fact.value, *map(str, fact.values.values()))
    return any(is_named(name, text) for text in texts)
