"""The causes of the state: the state kept as one row per cause.

Charges decay and pull the mood linearly, so the rows evolve each by itself and their sum is the
state, exactly. Rows beyond a bound are added together under "other": nothing of the sum is lost.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

TEMPERAMENT = "temperament"
"""The name under which a personality's baseline appears among the causes."""
OTHER = "other"
"""The name under which causes that count little appear together."""
MOST = 8
"""Rows that a ledger keeps apart, besides "other"."""
FAINT = 1e-3
"""A row that weighs less is not kept apart when it is older than OLD_S: it explains nothing."""
OLD_S = 60.0
PROSPECTS = frozenset({"hope", "fear"})
"""Emotions about a goal until it is decided."""
FORTUNES = frozenset({"happy_for", "resentment"})
"""Emotions while another's goal goes well."""
MISFORTUNES = frozenset({"pity", "gloating"})
"""Emotions while it goes badly."""
_OF_A_GOAL = PROSPECTS | FORTUNES | MISFORTUNES
MOST_OPEN = 50
"""Goals that are kept apart besides, as long as something is felt for them that may end with them:
it could not be found again."""

Axes = tuple[float, float, float]
"""Pleasure, arousal, dominance."""
STILL: Axes = (0.0, 0.0, 0.0)


class Origin(NamedTuple):
    """What happened, and who did it."""

    name: str
    """A stimulus, "goal.NAME", "action.NAME", "object.NAME", "drive.NAME" or OTHER."""
    person: str | None = None

    @property
    def goal(self) -> str:
        """The goal that it is about, as "goal.NAME"; empty for none."""
        return self.name if self.name[:5] == "goal." else ""


REST = Origin(OTHER)


class LedgerRow(NamedTuple):
    """What is left of a cause."""

    charges: Mapping[str, float]
    """By emotion, above 0; no unit."""
    mood: Axes
    """Its pull on the mood, off the baseline; no unit, before the tanh."""
    time: float
    """When it last happened, in seconds."""

    @property
    def weight(self) -> float:
        """How much it counts."""
        p, a, d = self.mood
        return sum(self.charges.values()) + abs(p) + abs(a) + abs(d)


@dataclass(frozen=True, slots=True)
class Cause:
    """A part of the feelings, with its cause."""

    name: str
    """A stimulus, "goal.NAME", "action.NAME", "object.NAME", "drive.NAME", TEMPERAMENT, OTHER."""
    share: float
    """Of the whole, above 0; all shares sum to 1."""
    age_s: float
    """Seconds since it last happened; 0 for what always acts: drives and the temperament."""
    person: str | None = None
    """Who did it."""
    lasts: bool = False
    """Whether it is a state that goes on."""


Ledger = Mapping[Origin, LedgerRow]


def merged(one: LedgerRow, other: LedgerRow) -> LedgerRow:
    """Both causes as one."""
    charges = summed(one.charges, other.charges)
    return LedgerRow(charges, added(one.mood, other.mood), max(one.time, other.time))


def pruned(ledger: Ledger, now: float) -> Ledger:
    """A ledger of few rows; faint rows, and of too many those that count least, go to REST.

    MOST are kept apart, and besides up to MOST_OPEN goals that something is still felt for.
    """
    before = now - OLD_S
    leaving = [
        origin
        for origin, row in ledger.items()
        if row.time < before and row.weight < FAINT and origin != REST
    ]
    if len(ledger) - len(leaving) > MOST:
        leaving += _lightest(ledger, leaving)
    if not leaving:
        return ledger
    result = dict(ledger)
    for origin in leaving:
        row = result.pop(origin)
        result[REST] = merged(result[REST], row) if REST in result else row
    return result


def _lightest(ledger: Ledger, leaving: Collection[Origin]) -> list[Origin]:
    """The rows that there is no room for, once those that are leaving have left."""
    goals: dict[Origin, float] = {}
    others: dict[Origin, float] = {}
    for origin, row in ledger.items():
        if origin != REST and origin not in leaving:
            is_open = origin.goal and not _OF_A_GOAL.isdisjoint(row.charges)
            (goals if is_open else others)[origin] = row.weight
    return [*_excess(goals, MOST_OPEN), *_excess(others, MOST)]


def _excess(weights: Mapping[Origin, float], most: int) -> list[Origin]:
    """The lightest ones, beyond the limit."""
    if len(weights) <= most:
        return []
    return sorted(weights, key=weights.__getitem__)[: len(weights) - most]


def summed(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """The charges of both, by emotion."""
    both = dict(one)
    for name, charge in other.items():
        both[name] = both.get(name, 0.0) + charge
    return both


def total_mood(rows: Iterable[LedgerRow]) -> Axes:
    """The sum of all rows, each axis."""
    total = STILL
    for row in rows:
        total = added(total, row.mood)
    return total


def added(one: Axes, other: Axes) -> Axes:
    """The sum of two points."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]
