"""All that is felt at a time, as a value: what it was when something last happened, and the time.

Everything between two events follows in closed form, so a state keeps what it was at the last one
and computes the rest when it is asked.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import exp
from typing import NamedTuple

from hri.emotion.emotions import OPPOSITES_OF
from hri.emotion.label import Course
from hri.emotion.ledger import PROSPECTS, Axes, Ledger, Origin, Row, merged, summed

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

    left: Mapping[str, float]
    """The share that is left of older charges, for each emotion of which some was driven out."""
    charges: Mapping[str, float]
    """The sum of all causes by emotion."""
    mood: Axes
    """The sum of the pulls of all causes and drives on the mood."""
    course: Course
    """Which emotions will have the label."""


class Imprint(NamedTuple):
    """What was felt when something last happened. Plain numbers and names, to be kept in a file."""

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
    """What is felt at a time."""

    time: float
    """Seconds, not before the imprint's."""
    imprint: Imprint
    outlook: Outlook

    @property
    def age(self) -> float:
        """Seconds since the imprint."""
        return self.time - self.imprint.time


def without_prospects(ledger: Ledger, cause: str) -> Ledger:
    """A ledger in which nobody hopes or fears any more for what has been decided."""
    return {
        origin: _without_prospects(row) if origin.name == cause else row
        for origin, row in ledger.items()
    }


def _without_prospects(row: Row) -> Row:
    charges = {name: charge for name, charge in row.charges.items() if name not in PROSPECTS}
    return Row(charges, row.mood, row.time)


def shares_left(fresh: Fresh) -> dict[str, float]:
    """The share that fresh charges leave of each of their opposites."""
    against: dict[str, float] = {}
    for charges in fresh.values():
        for name, charge in charges.items():
            for opposite in OPPOSITES_OF[name]:
                against[opposite] = against.get(opposite, 0.0) + charge
    return {name: exp(-charge) for name, charge in against.items()}


def sums(imprint: Imprint, left: Mapping[str, float]) -> tuple[dict[str, float], Axes]:
    """All charges by emotion, and all pulls on the mood, just after an imprint.

    Of the older charges these shares are left.
    """
    total: dict[str, float] = {}
    pleasure = arousal = dominance = 0.0
    for charges, (p, a, d), _ in imprint.ledger.values():
        pleasure += p
        arousal += a
        dominance += d
        for name, charge in charges.items():
            total[name] = total.get(name, 0.0) + charge
    for name, share in left.items():
        if name in total:
            total[name] *= share
    for charges in imprint.fresh.values():
        for name, charge in charges.items():
            total[name] = total.get(name, 0.0) + charge
    for _, (p, a, d) in imprint.needs.values():
        pleasure += p
        arousal += a
        dominance += d
    return total, (pleasure, arousal, dominance)


def renamed(imprint: Imprint, names: Mapping[str, str | None]) -> Imprint:
    """The same with people under other names: what they caused, and what is thought of them.

    Of whose name becomes None nothing is thought any more; what they caused, nobody has done.
    """

    def named(origin: Origin) -> Origin:
        return Origin(origin.name, names.get(origin.person or "", origin.person))

    ledger: dict[Origin, Row] = {}
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
            origin: Row(row.charges, row.mood, row.time + seconds)
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
