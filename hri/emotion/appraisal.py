"""What an event means to the robot: the emotions of Ortony, Clore and Collins (OCC, 1988).

Three kinds of things happen: a goal becomes more or less likely (GoalEvent), someone does something
good or bad (ActionEvent), there is something to like or dislike (ObjectEvent). Goals follow
GAMYGDALA (Popescu, Broekens and van Someren 2014, IEEE Trans. Affective Computing 5:32-44): what
counts is the change of the expected utility, utility * (likelihood after - before). Its program
never gives relief and disappointment, since it asks for a rise of the likelihood where there is a
fall; here both come when what was more likely than not does not happen.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from hri.emotion.ledger import FORTUNES, MISFORTUNES, PROSPECTS

SELF = "self"
"""The robot as the agent of an event."""
UNKNOWN = 0.5
"""Likelihood of what one knows nothing about."""
CERTAIN = 0.95
"""Intensity that an appraisal of full strength reaches in a calm robot: an intensity of 1 would
take an infinite charge."""
OPEN = 0.7
"""Of the charge that a change of likelihood brings, that which an open goal holds."""
LATE = 0.25
"""Of a charge in full strength, that of the reproach for who comes when they were given up."""
REMAINS = 0.8
"""Of the likelihood that a goal once had, that which is missed when it fails."""
AMENDS = 0.5
"""Of the charge of a good deed, that of the relief that something is made good."""
RESENTFUL = ("anger", "reproach", "hate", "resentment", "sadness", "disgust")
"""Feelings about the deeds of others, which fall once they are sorry."""
GUILTY = ("shame", "remorse", "sadness")
"""Feelings about deeds of the robot itself, which fall once they are made good."""
LONGEST_NAME = 100
"""Letters that the name of a goal, a deed, a thing or a person may have."""


@dataclass(frozen=True, slots=True)
class GoalEvent:
    """A goal, or something to be avoided, has become more or less likely.

    Raises ValueError for a number out of range.
    """

    goal: str
    utility: float
    """What it is worth to its owner, -1 (must not happen) to 1."""
    likelihood_after: float
    """0 (it will not happen any more) to 1 (it has happened)."""
    likelihood_before: float | None = None
    """Left out, what the robot believes: UNKNOWN about a new goal."""
    owner: str | None = None
    """The person whose goal it is; None: it is the robot's."""
    liking: float | None = None
    """How much the robot likes the owner, -1 to 1; left out, the relation it has."""
    agent: str | None = None
    """The agent: a person, SELF, or nobody."""
    praiseworthiness: float | None = None
    """Of what the agent did, -1 to 1, 0 being an accident; left out, the agent is judged by what
    came of it for the owner."""
    expected_s: float | None = None
    """Seconds within which it should happen: with each such time it seems half as likely. None: it
    may take any time."""
    waiting: str = ""
    """What is said of the goal after "because" while it is open: "Anna is not here yet"."""
    fulfilled: str = ""
    """Once it has happened: "Anna came"."""
    failed: str = ""
    """Once it will not: "Anna did not come"."""

    def __post_init__(self) -> None:
        check_name("goal", self.goal)
        _check("utility", self.utility, -1.0)
        _check("likelihood_after", self.likelihood_after, 0.0)
        if self.likelihood_before is not None:
            _check("likelihood_before", self.likelihood_before, 0.0)
        if self.expected_s is not None and not 0 < self.expected_s < math.inf:
            raise ValueError(f"expected_s is {self.expected_s} - give seconds above 0")
        for name in ("liking", "praiseworthiness"):
            value = getattr(self, name)
            if value is not None:
                _check(name, value, -1.0)
        for name in ("owner", "agent"):
            if getattr(self, name) is not None:
                check_name(name, getattr(self, name))

    @property
    def before(self) -> float:
        """How likely it was, as far as the event says."""
        return UNKNOWN if self.likelihood_before is None else self.likelihood_before

    @property
    def change(self) -> float:
        """Change of the expected utility, -1 to 1."""
        return self.utility * (self.likelihood_after - self.before)

    @property
    def is_decided(self) -> bool:
        """Whether it has happened, or will not."""
        return not 0.0 < self.likelihood_after < 1.0

    @property
    def doubt_rate(self) -> float:
        """How fast its likelihood falls as nothing happens, 1/s."""
        return 0.0 if self.expected_s is None else math.log(2.0) / self.expected_s

    @property
    def praise(self) -> float:
        """How the agent is judged, -1 to 1; 0 without one."""
        if self.agent is None:
            return 0.0
        return self.change if self.praiseworthiness is None else self.praiseworthiness


@dataclass(frozen=True, slots=True)
class ActionEvent:
    """Someone did something good or bad by the robot's standards.

    Raises ValueError for a number out of range.
    """

    action: str
    praiseworthiness: float
    """-1 to 1."""
    agent: str = SELF
    """A person, or SELF."""
    desirability: float = 0.0
    """How good it is for the robot, -1 to 1: a deed that hurts it makes angry."""
    makes_good: str = ""
    """The deed that this one makes good, as an apology does; empty for none."""

    def __post_init__(self) -> None:
        check_name("action", self.action)
        check_name("agent", self.agent)
        _check("praiseworthiness", self.praiseworthiness, -1.0)
        _check("desirability", self.desirability, -1.0)


@dataclass(frozen=True, slots=True)
class ObjectEvent:
    """There is something, or someone, to like or dislike.

    Raises ValueError for a number out of range.
    """

    object: str
    appeal: float
    """-1 to 1."""

    def __post_init__(self) -> None:
        check_name("object", self.object)
        _check("appeal", self.appeal, -1.0)


OccEvent = GoalEvent | ActionEvent | ObjectEvent


def people_of(event: OccEvent) -> set[str]:
    """Everyone who has a part in it, beside the robot itself."""
    match event:
        case GoalEvent(owner=owner, agent=agent):
            return {person for person in (owner, agent) if person not in (None, SELF)}
        case ActionEvent(agent=agent):
            return {agent} - {SELF}
    return set()


@dataclass(frozen=True, slots=True)
class Appraisal:
    """What an event means."""

    cause: str
    """Under which the ledger has it: "goal.charger", "action.rescue", "object.spider"."""
    charges: Mapping[str, float] = field(default_factory=dict)
    """Added to each emotion, >= 0, before the personality's gains."""
    person: str | None = None
    """The people involved."""
    ends: frozenset[str] = frozenset()
    """Emotions for the same goal that have no reason any more: once it is decided, hope and fear;
    with a good end pity, too, with a bad one joy for its owner."""
    praise: float = 0.0
    """How the person did, -1 to 1: a relation follows."""
    agent: str | None = None
    """The person who did something; None for the robot, or nobody."""
    about: str = ""
    """The cause that is seen in another light now; empty for none."""
    soothes: Mapping[str, float] = field(default_factory=dict)
    """Share of each emotion that is not felt for it any more."""


class Belief(NamedTuple):
    """How likely a goal seemed before an event."""

    likelihood: float
    """Just before, 0 to 1."""
    peak: float
    """At most, since it is open; 0 if it is new."""


NO_BELIEF = Belief(UNKNOWN, 0.0)
"""About a new goal."""


def appraise(event: OccEvent, relation: float = 0.0, belief: Belief = NO_BELIEF) -> Appraisal:
    """What an event means to a robot that has this relation, -1 to 1, to the owner of the goal, and
    this belief about it.
    """
    if isinstance(event, GoalEvent):
        return _goal(event, relation if event.liking is None else event.liking, belief)
    if isinstance(event, ActionEvent):
        return _deed(event)
    liked = {"love" if event.appeal > 0 else "hate": _charge(event.appeal)}
    return Appraisal(f"object.{event.object}", _felt(liked))


def _deed(event: ActionEvent) -> Appraisal:
    agent = None if event.agent == SELF else event.agent
    praise = event.praiseworthiness
    cause = f"action.{event.action}"
    if event.makes_good:
        # Amends are forgiven, not admired.
        charges = {"relief": AMENDS * _charge(praise)} if praise > 0 else {}
        if agent is None:
            charges |= _judged(SELF, praise)
        soothes = dict.fromkeys(RESENTFUL if agent else GUILTY, max(praise, 0.0))
        about = f"action.{event.makes_good}"
        return Appraisal(
            cause,
            _felt(charges),
            agent,
            praise=praise if agent else 0.0,
            agent=agent,
            about=about,
            soothes=soothes,
        )
    charges = _judged(event.agent, praise)
    if event.desirability:
        charges |= _compound(event.agent, event.desirability, praise)
    return Appraisal(cause, _felt(charges), agent, praise=praise if agent else 0.0, agent=agent)


def prospects(event: GoalEvent) -> tuple[dict[str, float], dict[str, float]]:
    """Charges of hope and fear for a goal of the robot's that is open: now, and in the long run.

    A pulse says that something has changed, these that it is not decided. They follow the expected
    utility, utility * likelihood, of either outcome.
    """
    likely = event.likelihood_after
    in_the_end = 0.0 if event.doubt_rate else likely
    good, bad = ("hope", "fear") if event.utility > 0 else ("fear", "hope")

    def levels(likelihood: float) -> dict[str, float]:
        return {
            good: OPEN * _charge(event.utility * likelihood),
            bad: OPEN * _charge(event.utility * (1.0 - likelihood)),
        }

    return levels(likely), levels(in_the_end)


def _goal(event: GoalEvent, liking: float, belief: Belief) -> Appraisal:
    doubted = 0.0
    if event.likelihood_before is None and event.owner is None:
        before = belief.likelihood
        if event.likelihood_after == 1.0:
            doubted = max(UNKNOWN - before, 0.0) / UNKNOWN
        elif event.likelihood_after == 0.0:
            # Who has given up hope, or lost a fear, still feels that it was there.
            before = max(before, REMAINS * belief.peak)
        event = replace(event, likelihood_before=before)
    own = event.owner is None
    desired = event.change if own else event.change * liking
    charges = _prospects(event, doubted) if own else _fortunes(event, liking)
    if event.agent is not None:
        charges |= _judged(event.agent, event.praise)
        charges |= _compound(event.agent, desired, event.praise)
        if doubted and event.agent != SELF:
            # Who comes late is welcome all the same.
            charges["reproach"] = charges.get("reproach", 0.0) + LATE * _charge(doubted)
    doer = None if event.agent == SELF else event.agent
    return Appraisal(
        cause=f"goal.{event.goal}",
        charges=_felt(charges),
        person=event.owner if doer is None else doer,
        ends=_ended(event),
        praise=0.0 if doer is None else event.praise,
        agent=doer,
    )


def _prospects(event: GoalEvent, doubted: float) -> dict[str, float]:
    """Hope and fear; when it is decided, joy or sadness and what became of hope and fear.

    `doubted` is how much, 0 to 1, the robot had come to expect the opposite while it waited.
    """
    charge, pleases = _charge(event.change), event.change > 0
    if not event.is_decided:
        return {"hope" if pleases else "fear": charge}
    charges = {"joy" if pleases else "sadness": charge}
    happened = event.likelihood_after == 1.0
    if doubted:
        # Expecting the worst is as good as a fear of it, and the best as good as a hope.
        feared = event.utility > 0
        name = "relief" if pleases else "fears_confirmed"
        if not feared:
            name = "satisfaction" if pleases else "disappointment"
        charges[name] = charge * doubted
    if event.before > UNKNOWN:
        if pleases:
            charges["satisfaction" if happened else "relief"] = charge
        else:
            charges["fears_confirmed" if happened else "disappointment"] = charge
    return charges


def _ended(event: GoalEvent) -> frozenset[str]:
    """What is not felt for the goal any more."""
    if not event.is_decided:
        return frozenset()
    ends_well = event.utility > 0 if event.likelihood_after == 1.0 else event.utility < 0
    return PROSPECTS | (MISFORTUNES if ends_well else FORTUNES)


def _fortunes(event: GoalEvent, liking: float) -> dict[str, float]:
    """Emotions felt for others."""
    if event.change > 0:
        name = "happy_for" if liking > 0 else "resentment"
    else:
        name = "pity" if liking > 0 else "gloating"
    return {name: _charge(event.change * liking)}


def _judged(agent: str, praise: float) -> dict[str, float]:
    """Pride and shame of oneself, admiration and reproach of others."""
    if agent == SELF:
        name = "pride" if praise > 0 else "shame"
    else:
        name = "admiration" if praise > 0 else "reproach"
    return _felt({name: _charge(praise)})


def _compound(agent: str, desired: float, praise: float) -> dict[str, float]:
    """A deed and what came of it together: as much as both parts, and nothing without either.

    A good deed of which harm came, or the other way round, is not a compound.
    """
    if desired * praise <= 0:
        return {}
    if agent == SELF:
        name = "gratification" if praise > 0 else "remorse"
    else:
        name = "gratitude" if praise > 0 else "anger"
    return {name: 2.0 * math.sqrt(_charge(desired) * _charge(praise))}


def _charge(strength: float) -> float:
    """The charge that reads as an intensity of CERTAIN times the strength, whatever its sign."""
    return -math.log1p(-CERTAIN * abs(strength))


def _felt(charges: dict[str, float]) -> dict[str, float]:
    return {name: charge for name, charge in charges.items() if charge > 0}


def _check(name: str, value: float, minimum: float) -> None:
    if not minimum <= value <= 1.0:
        raise ValueError(f"{name} is {value} - give {minimum:g} to 1")


def check_name(name: str, value: str) -> None:
    """Raises ValueError for a name that is empty or too long; `name` says whose it is."""
    if not 0 < len(value) <= LONGEST_NAME:
        raise ValueError(f"{name} has {len(value)} letters - give 1 to {LONGEST_NAME}")


def name_of(value: object) -> str | None:
    """A name as it can be kept: cut to its length, without halves of letters; None for none."""
    written = str(value or "").encode("utf-8", "replace").decode("utf-8")
    return written[:LONGEST_NAME] or None
