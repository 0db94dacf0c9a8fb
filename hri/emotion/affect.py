"""All that is felt at a time, as a value: what it was when something last happened, and the time.

Everything between two events follows in closed form, so a state keeps what it was at the last one
and computes the rest when it is asked.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import exp
from typing import NamedTuple

from hri.emotion.emotions import EMOTIONS, OPPOSITES_OF, OPPOSITES_OF_THE_SAME, PART_OF, whole
from hri.emotion.held import Held
from hri.emotion.label import STRONG, Course
from hri.emotion.ledger import REST, Axes, Ledger, LedgerRow, Origin, merged, summed

Fresh = Mapping[Origin, Mapping[str, float]]
"""Charges by cause and part of an emotion."""

MOST_AT_ONCE = 50
"""Causes that are kept apart of what happens at one instant; what is more counts as the rest."""
TURNS = 0.4
"""How far each unit of charge above STRONG moves the mood at once, of the emotion's coordinates."""
_AXES = {
    emotion.name: (emotion.pleasure, emotion.arousal, emotion.dominance) for emotion in EMOTIONS
}


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


class Soothed(NamedTuple):
    """A deed, and how its doer made up for it."""

    deed: str
    """Under which the ledger has it."""
    amends: str
    """The same for what made up for it."""
    person: str | None
    emotion: str
    """The strongest feeling about the deed."""
    time: float
    """Seconds."""


class Outlook(NamedTuple):
    """What follows from an imprint, worked out once for all the times at which it is read."""

    older: Ledger
    """The imprint's ledger without what the fresh charges drove out."""
    charges: Mapping[str, float]
    """The sum of all causes by part of an emotion, without what is held."""
    mood: Axes
    """The sum of the pulls of all causes and drives on the mood, without what is held."""
    course: Course
    """Which emotions will have the label."""
    turned: Mapping[Origin, Axes]
    """How far strong fresh charges have moved the mood at once, by cause."""


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
    held: Mapping[Origin, Held] = {}
    """States that go on, or are still felt."""
    mood_name: str = ""
    """The name of the mood; empty: not named yet."""
    named_at: float = 0.0
    """When it was named, in seconds."""
    words: Mapping[str, str] = {}
    """What is said of goals, deeds and things, by the name of the cause."""
    soothed: Soothed | None = None
    """The last deed that was made up for."""


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
    against = {goal: summed(everywhere, there) for goal, there in about.items() if there}
    return {
        origin: _less(row, against.get(origin.goal, everywhere)) for origin, row in ledger.items()
    }


def _less(row: LedgerRow, against: Mapping[str, float]) -> LedgerRow:
    driven = against.keys() & row.charges.keys()
    if not driven:
        return row
    charges = dict(row.charges)
    for part in driven:
        charges[part] *= exp(-against[part])
    return LedgerRow(charges, row.mood, row.time)


def with_charges(fresh: Fresh, origin: Origin, charges: Mapping[str, float]) -> Fresh:
    """Fresh charges and those of one more cause; of too many, those of the rest."""
    if origin not in fresh and len(fresh) >= MOST_AT_ONCE:
        origin = REST
    if origin in fresh:
        charges = summed(fresh[origin], charges)
    return {**fresh, origin: charges}


def turns(fresh: Fresh) -> Mapping[Origin, Axes]:
    """How far the strong ones among fresh charges move the mood at once, by cause.

    What counts is all that comes at one instant, so that its order does not.
    """
    total: dict[str, float] = {}
    for charges in fresh.values():
        for part, charge in charges.items():
            name = PART_OF[part]
            total[name] = total.get(name, 0.0) + charge
    if not total or max(total.values()) <= STRONG:
        return {}
    strong = {
        name: TURNS * (charge - STRONG) / charge
        for name, charge in total.items()
        if charge > STRONG
    }
    moved = {}
    for origin, charges in fresh.items():
        p = a = d = 0.0
        for part, charge in charges.items():
            if share := strong.get(PART_OF[part]):
                pleasure, arousal, dominance = _AXES[PART_OF[part]]
                p += charge * share * pleasure
                a += charge * share * arousal
                d += charge * share * dominance
        moved[origin] = p, a, d
    return moved


def soothed(
    ledger: Ledger, about: Collection[Origin], shares: Mapping[str, float]
) -> tuple[Ledger, tuple[float, Origin, str]]:
    """A ledger in which less of some emotions is felt for some causes, and of their pull.

    `shares` say how much goes of each emotion, 0 to 1; of the pull on the mood goes as much as of
    all charges together. With it comes what fell most: by how much, for which cause, what emotion.
    """
    calmer, most = dict(ledger), (0.0, REST, "")
    for origin in about:
        charges, (p, a, d), time = ledger[origin]
        left = {part: c * (1.0 - shares.get(PART_OF[part], 0.0)) for part, c in charges.items()}
        fallen = whole({part: charge - left[part] for part, charge in charges.items()})
        # The pull stays when it is all that is left: what is over cannot be undone.
        share = sum(fallen.values()) / sum(charges.values()) if charges else 0.0
        calmer[origin] = LedgerRow(left, (p * (1 - share), a * (1 - share), d * (1 - share)), time)
        for name, charge in fallen.items():
            most = max(most, (charge, origin, name))
    return calmer, most


def sums(
    imprint: Imprint, older: Ledger, turned: Mapping[Origin, Axes]
) -> tuple[dict[str, float], Axes]:
    """All charges by emotion, and all pulls on the mood, just after an imprint.

    `older` is the rest of its ledger, `turned` the effect of strong fresh charges on the mood.
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
    for p, a, d in turned.values():
        pleasure += p
        arousal += a
        dominance += d
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
    held: dict[Origin, Held] = {}
    for origin, state in imprint.held.items():
        other = named(origin)
        # Of two that turn out to be one, the later is what goes on.
        if other not in held or state.since > held[other].since:
            held[other] = state
    last = imprint.soothed
    if last is not None:
        last = last._replace(person=named(Origin("", last.person)).person)
    return imprint._replace(
        ledger=ledger,
        fresh=fresh,
        habituation=habituation,
        relations=relations,
        held=held,
        soothed=last,
    )


def _together(one: Trace, other: Trace) -> Trace:
    """Both regards as one; how much the older one has faded by the time of the newer is little."""
    time = max(one.time, other.time)
    return Trace(one.before + other.before, one.after + other.after, time)


def shifted(imprint: Imprint, seconds: float) -> Imprint:
    """The same on a clock that shows `seconds` more, such as after a restart."""
    last = imprint.soothed
    return imprint._replace(
        time=imprint.time + seconds,
        ledger={
            origin: row._replace(time=row.time + seconds) for origin, row in imprint.ledger.items()
        },
        habituation={key: _shifted(trace, seconds) for key, trace in imprint.habituation.items()},
        relations={key: _shifted(trace, seconds) for key, trace in imprint.relations.items()},
        held={
            origin: state._replace(since=state.since + seconds, until=state.until + seconds)
            for origin, state in imprint.held.items()
        },
        named_at=imprint.named_at + seconds,
        soothed=None if last is None else last._replace(time=last.time + seconds),
    )


def _shifted(trace: Trace, seconds: float) -> Trace:
    return Trace(trace.before, trace.after, trace.time + seconds)
