"""All that is felt at a time, as a value: what it was when something last happened, and the time.

Everything between two events follows in closed form, so a state keeps what it was at the last one
and computes the rest when it is asked.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import exp
from typing import NamedTuple

from hri.emotion.emotions import OPPOSITES_OF, OPPOSITES_OF_THE_SAME
from hri.emotion.label import Course
from hri.emotion.ledger import Axes, Ledger, LedgerRow, Origin, merged, summed

Fresh = Mapping[Origin, Mapping[str, float]]
"""Charges by cause and emotion."""


class Trace(NamedTuple):
    """Something slow that events add to. What comes at one instant sees it as it was before, so
    that the order within an instant does not matter."""

    before: float
    """Just before `time`."""
    after: float
    """Just after it."""
    time: float
    """When it was last added to, in seconds."""

    def at(self, now: float, rate: float) -> Trace:
        """What is left of it at a time, ready to be added to; `rate` is its decay in 1/s."""
        if now == self.time:
            return self
        left = self.after * exp(-rate * (now - self.time))
        return Trace(left, left, now)


FRESH = Trace(0.0, 0.0, 0.0)
"""Nothing added yet."""


class Need(NamedTuple):
    """A drive."""

    level: float
    """0 (stilled) to 1 (pressing)."""
    mood: Axes
    """What it has done to the mood; see Row."""


class Outlook(NamedTuple):
    """What follows from an imprint, worked out once for all the times at which it is read."""

    older: Ledger
    """The imprint's ledger without what the fresh charges drove out."""
    charges: Mapping[str, float]
    """The sum of all causes by emotion."""
    mood: Axes
    """The sum of the pulls of all causes and drives on the mood."""
    course: Course
    """Which emotions will have the label."""


class Imprint(NamedTuple):
    """The feelings at the last event. Plain numbers and names, so that a file can hold them."""

    time: float
    """Seconds."""
    ledger: Ledger
    """The causes just before that instant."""
    fresh: Fresh
    """Charges that came at that very instant. Kept apart so that they drive out older opposites,
    not each other, and their order does not matter."""
    needs: Mapping[str, Need]
    """Drives just after that instant."""
    habituation: Mapping[Origin, Trace]
    """0 (new) to 1 (no effect any more), by stimulus and person."""
    relations: Mapping[str, Trace]
    """Regard by person; see relations.relation_of."""
    label: str
    """The emotion that stood out just before that instant; label.NOTHING for none."""


class Affect(NamedTuple):
    """The feelings at a time."""

    time: float
    """Seconds, not before the imprint's."""
    imprint: Imprint
    outlook: Outlook

    @property
    def age(self) -> float:
        """Seconds since the imprint."""
        return self.time - self.imprint.time


def without(ledger: Ledger, cause: str, emotions: Collection[str]) -> Ledger:
    """A ledger in which these emotions are not felt any more for a cause."""
    return {
        origin: _without(row, emotions) if origin.name == cause else row
        for origin, row in ledger.items()
    }


def _without(row: LedgerRow, emotions: Collection[str]) -> LedgerRow:
    charges = {name: charge for name, charge in row.charges.items() if name not in emotions}
    return LedgerRow(charges, row.mood, row.time)


def driven_out(ledger: Ledger, fresh: Fresh) -> Ledger:
    """What fresh charges leave of a ledger: each drives out its opposites.

    A hope for a goal drives out the fear for that goal, not for another one; charges without a goal
    are treated as if about one goal.
    """
    everywhere: dict[str, float] = {}
    about: dict[str, dict[str, float]] = {}
    for origin, charges in fresh.items():
        there = about.setdefault(origin.goal, {})
        for name, charge in charges.items():
            for opposite in OPPOSITES_OF[name]:
                everywhere[opposite] = everywhere.get(opposite, 0.0) + charge
            for opposite in OPPOSITES_OF_THE_SAME[name]:
                there[opposite] = there.get(opposite, 0.0) + charge
    if not everywhere and not any(about.values()):
        return ledger
    return {
        origin: _less(row, summed(everywhere, about.get(origin.goal, {})))
        for origin, row in ledger.items()
    }


def _less(row: LedgerRow, against: Mapping[str, float]) -> LedgerRow:
    if against.keys().isdisjoint(row.charges):
        return row
    charges = {
        name: charge * exp(-against[name]) if name in against else charge
        for name, charge in row.charges.items()
    }
    return LedgerRow(charges, row.mood, row.time)


def sums(imprint: Imprint, older: Ledger) -> tuple[dict[str, float], Axes]:
    """All charges by emotion, and all pulls on the mood, just after an imprint.

    `older` is what is left of its ledger.
    """
    total: dict[str, float] = {}
    pleasure = arousal = dominance = 0.0
    for charges, (p, a, d), _ in older.values():
        pleasure += p
        arousal += a
        dominance += d
        for name, charge in charges.items():
            total[name] = total.get(name, 0.0) + charge
    for charges in imprint.fresh.values():
        for name, charge in charges.items():
            total[name] = total.get(name, 0.0) + charge
    for _, (p, a, d) in imprint.needs.values():
        pleasure += p
        arousal += a
        dominance += d
    return total, (pleasure, arousal, dominance)


def renamed(imprint: Imprint, names: Mapping[str, str | None]) -> Imprint:
    """The same with people under other names, both as causes and in relations.

    A name that becomes None loses its relation; what that person caused has no author any more.
    """

    def named(origin: Origin) -> Origin:
        return Origin(origin.name, names.get(origin.person or "", origin.person))

    ledger: dict[Origin, LedgerRow] = {}
    for origin, row in imprint.ledger.items():
        other = named(origin)
        ledger[other] = merged(ledger[other], row) if other in ledger else row
    fresh: dict[Origin, Mapping[str, float]] = {}
    for origin, charges in imprint.fresh.items():
        fresh[named(origin)] = summed(fresh.get(named(origin), {}), charges)
    habituation: dict[Origin, Trace] = {}
    for origin, trace in imprint.habituation.items():
        if origin.person is None or named(origin).person is not None:
            habituation[named(origin)] = trace
    relations: dict[str, Trace] = {}
    for person, trace in imprint.relations.items():
        if (name := names.get(person, person)) is not None:
            relations[name] = _together(relations[name], trace) if name in relations else trace
    return imprint._replace(
        ledger=ledger, fresh=fresh, habituation=habituation, relations=relations
    )


def _together(one: Trace, other: Trace) -> Trace:
    """Both regards as one; how much the older one has faded by the time of the newer is little."""
    time = max(one.time, other.time)
    return Trace(one.before + other.before, one.after + other.after, time)


def shifted(imprint: Imprint, seconds: float) -> Imprint:
    """The same on a clock that shows `seconds` more, such as after a restart."""
    return Imprint(
        imprint.time + seconds,
        {
            origin: LedgerRow(row.charges, row.mood, row.time + seconds)
            for origin, row in imprint.ledger.items()
        },
        imprint.fresh,
        imprint.needs,
        {key: _shifted(trace, seconds) for key, trace in imprint.habituation.items()},
        {person: _shifted(trace, seconds) for person, trace in imprint.relations.items()},
        imprint.label,
    )


def _shifted(trace: Trace, seconds: float) -> Trace:
    return Trace(trace.before, trace.after, trace.time + seconds)
