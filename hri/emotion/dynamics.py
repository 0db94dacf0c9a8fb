"""How feelings rise and fade: a state goes in, what has happened since, and a state comes out.

Each event leaves a charge per emotion that decays exponentially, some of it slowly; what goes on
holds its charges for as long as it does (see `held`); each need drifts to its resting level. All
of them pull a slow mood (pleasure, arousal, dominance) that returns to the personality's
baseline. All of it is linear, so the state is kept as one row per cause, a ledger: the sum of its
rows is the state, and "why?" is answered by reading it. What others see saturates by itself:
intensity = 1 - exp(-charge), mood = tanh(atanh(baseline) + pull). Nothing is clamped, and nothing
needs a tick: a state is what it was at the last event, and the time (see `affect`); what lies
between is closed form (see `fading`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import exp, hypot, isfinite, sqrt

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import EmotionState
from hri.emotion import relations
from hri.emotion.affect import (
    FRESH,
    Affect,
    Imprint,
    Need,
    Outlook,
    Soothed,
    Trace,
    driven_out,
    renamed,
    soothed,
    sums,
    turns,
    with_charges,
    without,
)
from hri.emotion.appraisal import (
    NO_BELIEF,
    Appraisal,
    Belief,
    GoalEvent,
    OccEvent,
    appraise,
    check_name,
)
from hri.emotion.clauses import words_of
from hri.emotion.drives import cause_of
from hri.emotion.emotions import EMOTIONS, NAMES, SLOW, in_parts, whole
from hri.emotion.fading import Fading
from hri.emotion.held import lines_of
from hri.emotion.label import (
    CALM,
    MOOD_S,
    MOODS,
    NOTHING,
    course,
    known_as,
    label_at,
    mood_name,
)
from hri.emotion.ledger import (
    STILL,
    TEMPERAMENT,
    Axes,
    Cause,
    Ledger,
    LedgerRow,
    Origin,
    merged,
    pruned,
    summed,
    total_mood,
)
from hri.emotion.personality import Personality
from hri.emotion.states import States
from hri.emotion.stimulus import HeldSpec, StimulusSpec

MOST_HABITS = 500
"""Habituations that are remembered; of more the one that was touched longest ago is forgotten."""
_FADING_RATE = 1.0 / relations.FADES_S
UNWELCOME = 2.5
"""How much of the pleasure of meeting someone goes with each unit of dislike."""
RELIEVED = 0.05
"""Charge that must fall for it to be worth words that someone made up for a deed."""
_REUNION = "joy" + SLOW
_FARTHEST = sqrt(3)
"""Distance of a corner from the origin."""


@dataclass(frozen=True, slots=True)
class _Taken:
    """A stimulus as a personality takes it."""

    charges: Mapping[str, float]
    """Charge per part of an emotion in full strength, with the personality's gains; per emotion
    where it is held."""
    spec: StimulusSpec
    satisfies: Mapping[str, float]
    relation: float
    habituates: float
    recovery_rate: float
    """1/s."""


class Dynamics:
    """The arithmetic of one personality and one set of stimuli; states go in and come out."""

    def __init__(self, personality: Personality, stimuli: Sequence[StimulusSpec]) -> None:
        self.personality = personality
        self.names = tuple(stimulus.name for stimulus in stimuli)
        self._gains = {emotion.name: personality.gain(emotion) for emotion in EMOTIONS}
        self._stimuli = {stimulus.name: self._taken(stimulus) for stimulus in stimuli}
        self._fading = Fading(personality)
        self._named: tuple[Imprint, float, str] | None = None
        """The last mood that was named, for which imprint and time: it is asked for often."""
        self._states = States(self._fading, self._gains)
        self._rest = {drive.name: Need(drive.resting, STILL) for drive in personality.drives}

    def _taken(self, stimulus: StimulusSpec) -> _Taken:
        charges = {
            name: self._gains[name] * charge
            for name, charge in zip(NAMES, stimulus.charges(), strict=True)
            if charge
        }
        return _Taken(
            charges=charges if stimulus.held else in_parts(charges),
            spec=stimulus,
            satisfies=stimulus.satisfies,
            relation=stimulus.relation,
            habituates=stimulus.habituates,
            recovery_rate=1.0 / stimulus.recover_s,
        )

    # States.

    def rest(self, now: float = 0.0) -> Affect:
        """Nothing felt yet: the baseline, all drives at rest."""
        return self.resume(Imprint(now, {}, {}, {}, {}, {}, NOTHING), now)

    def resume(self, imprint: Imprint, now: float) -> Affect:
        """The state at a time, from the feelings at the last event.

        The imprint may come from a file, or from the settled state of another personality: drives
        that it lacks are at rest, those that this personality lacks are dropped. Raises ValueError
        for a time that is not finite.
        """
        needs = {name: imprint.needs.get(name, need) for name, need in self._rest.items()}
        affect = self._affect(imprint._replace(needs=needs))
        if not imprint.mood_name:
            name = mood_name(self.mood(affect))
            affect = affect._replace(
                imprint=affect.imprint._replace(mood_name=name, named_at=imprint.time)
            )
        return self.advance(affect, now)

    def settle(self, affect: Affect) -> Affect:
        """The same state with all that has faded since the last event worked out.

        What goes on under another personality: `other.resume(one.settle(affect).imprint, now)`.
        """
        return self._affect(self._imprint_at(affect, affect.time))

    def advance(self, affect: Affect, now: float) -> Affect:
        """The state at a later time; an earlier time changes nothing.

        Raises ValueError for a time that is not finite.
        """
        if not isfinite(now):
            raise ValueError(f"the time must be finite, not {now}")
        return affect if now <= affect.time else Affect(now, affect.imprint, affect.outlook)

    def rename(self, affect: Affect, names: Mapping[str, str | None]) -> Affect:
        """The same state with people under other names, once it is known who they are; None is for
        one who is forgotten.
        """
        return self.advance(self._affect(renamed(affect.imprint, names)), affect.time)

    # What happens.

    def feel(
        self, affect: Affect, name: str, intensity: float, now: float, person: str | None = None
    ) -> Affect:
        """The state just after a stimulus of intensity 0 to 1, which may come from a person.

        One of intensity 0 has not happened; one that lasts is over then. Raises HriError for an
        unknown stimulus, ValueError for an intensity out of range, a person without a name or of a
        very long one, or a time that is not finite.
        """
        if name not in self._stimuli:
            raise HriError(f'no stimulus "{name}" - {did_you_mean(name, self.names)}')
        if not 0 <= intensity <= 1:
            raise ValueError(f"the intensity of {name} is {intensity} - give 0 to 1")
        if person is not None:
            check_name("person", person)
        stimulus, origin = self._stimuli[name], Origin(name, person)
        if stimulus.spec.held is not None:
            imprint = self._imprint_at(affect, now)
            return self._affect(self._lasting(imprint, origin, stimulus.spec.held, intensity))
        if intensity == 0:
            return self.advance(affect, now)
        habit = _habit(name, person)
        imprint = self._imprint_at(affect, now)
        worn = imprint.habituation.get(habit, FRESH).at(imprint.time, stimulus.recovery_rate)
        strength = intensity * (1.0 - worn.before)
        charges = {name: charge * strength for name, charge in stimulus.charges.items()}
        if person is not None and (relation := _relation(imprint, person)):
            charges = relations.weighted(charges, relation)
            if stimulus.spec.reunion:
                charges = self._met(imprint, stimulus, person, charges, strength)
        imprint = Imprint(
            imprint.time,
            imprint.ledger,
            with_charges(imprint.fresh, origin, charges),
            _satisfied(imprint.needs, stimulus.satisfies, strength),
            _habituated(imprint.habituation, habit, worn, stimulus.habituates),
            _regarded(imprint, person, stimulus.relation * strength),
            *imprint[6:],
        )
        if stimulus.spec.soothes:
            shares = {name: share * strength for name, share in stimulus.spec.soothes.items()}
            about = [cause for cause in imprint.ledger if self._is_deed_of(cause, person)]
            imprint = _soothed(imprint, about, shares, origin)
        return self._affect(imprint)

    def appraise(self, affect: Affect, event: OccEvent, now: float) -> Affect:
        """The state just after an event that touches the robot's goals, standards or tastes.

        Raises ValueError for a time that is not finite.
        """
        imprint = self._imprint_at(affect, now)
        if isinstance(event, GoalEvent):
            imprint, meaning = self._goal(imprint, event)
        else:
            meaning = appraise(event)
        charges = {name: charge * self._gains[name] for name, charge in meaning.charges.items()}
        if relation := _relation(imprint, meaning.agent):
            charges = relations.weighted(charges, relation)
        origin = Origin(meaning.cause, meaning.person)
        if meaning.ends:
            imprint = imprint._replace(ledger=without(imprint.ledger, meaning.cause, meaning.ends))
        imprint = imprint._replace(words={**imprint.words, meaning.cause: words_of(event)})
        imprint = imprint._replace(
            fresh=with_charges(imprint.fresh, origin, in_parts(charges)),
            relations=_regarded(imprint, meaning.person, relations.PRAISED * meaning.praise),
        )
        if meaning.soothes:
            about = [cause for cause in imprint.ledger if cause.name == meaning.about]
            imprint = _soothed(imprint, about, meaning.soothes, origin)
        return self._affect(imprint)

    def _lasting(
        self, imprint: Imprint, origin: Origin, spec: HeldSpec, intensity: float
    ) -> Imprint:
        """A state that goes on in a strength from now on; 0: it is over."""
        if intensity == 0.0:
            return self._states.end(imprint, origin)
        relation = _relation(imprint, origin.person)
        strength = intensity * (1.0 + relation) / 2.0 if spec.as_liked else intensity
        full = self._stimuli[origin.name].charges
        charges = {name: charge * strength for name, charge in full.items()}
        return self._states.begin(imprint, origin, spec, relations.weighted(charges, relation))

    def _goal(self, imprint: Imprint, event: GoalEvent) -> tuple[Imprint, Appraisal]:
        """The meaning of a goal; as long as it is open, hope and fear are held for it."""
        origin = Origin(f"goal.{event.goal}", event.owner)
        held, belief = imprint.held.get(origin), NO_BELIEF
        if held is not None and held.likelihood is not None:
            belief = Belief(held.at(held.likelihood, imprint.time), held.peak)
        meaning = appraise(event, _relation(imprint, event.owner), belief)
        if event.owner is None and not event.is_decided:
            imprint = self._states.open(imprint, origin, event, belief.peak)
        elif held is not None:
            imprint = self._states.let_go(imprint, origin)
        return imprint, meaning

    def _is_deed_of(self, origin: Origin, person: str | None) -> bool:
        """Whether a cause is a deed of a person: of one without a name, a stimulus that names its
        doer.
        """
        if origin.person is not None or person is not None:
            return origin.person == person
        stimulus = self._stimuli.get(origin.name)
        return stimulus is not None and "{" in stimulus.spec.words

    def _met(
        self,
        imprint: Imprint,
        stimulus: _Taken,
        person: str,
        charges: dict[str, float],
        strength: float,
    ) -> dict[str, float]:
        """What it is to meet someone again: a friend who was missed, or a bully."""
        relation = _relation(imprint, person)
        if relation < 0.0:
            left = max(1.0 + UNWELCOME * relation, 0.0)
            return {
                part: charge * left if relations.SIGNS[part] > 0 else charge
                for part, charge in charges.items()
            }
        missed = 1.0 - exp((imprint.relations[person].time - imprint.time) / relations.MISSED_S)
        more = self._gains["joy"] * stimulus.spec.reunion * relation * missed * strength
        return summed(charges, {_REUNION: more})

    def report(self, affect: Affect, drive: str, level: float, now: float) -> Affect:
        """The state just after a need was found at a level, 0 to 1: energy is 1 minus the battery.

        Raises HriError for an unknown drive, ValueError for a level out of range or a time that is
        not finite.
        """
        if drive not in self._rest:
            raise HriError(f'no drive "{drive}" - {did_you_mean(drive, self._rest)}')
        if not 0 <= level <= 1:
            raise ValueError(f"the need of {drive} is {level} - give 0 to 1")
        imprint = self._imprint_at(affect, now)
        need = Need(level, imprint.needs[drive].mood)
        return self._affect(imprint._replace(needs={**imprint.needs, drive: need}))

    # Feelings.

    def read(self, affect: Affect) -> EmotionState:
        """The feelings, as a value for others."""
        intensities, mood, levels = self._fading.read(affect)
        label = label_at(affect.outlook.course, affect.time - affect.imprint.time)
        named = self._mood_name(affect)
        if label == NOTHING:
            label, intensity = named, hypot(*mood) / _FARTHEST
        else:
            intensity = intensities[label]
        return EmotionState(label, intensity, *mood, intensities, levels, named)

    def _mood_name(self, affect: Affect) -> str:
        """The name of the mood, which it keeps from one naming to the next."""
        return self._mood_named_at(affect, _last_naming(affect))

    def _mood_named_at(self, affect: Affect, at: float) -> str:
        imprint = affect.imprint
        if at <= imprint.named_at:
            return imprint.mood_name
        if self._named is None or self._named[0] is not imprint or self._named[1] != at:
            mood = self._fading.read(affect._replace(time=max(at, imprint.time)))[1]
            self._named = imprint, at, mood_name(mood)
        return self._named[2]

    def charges(self, affect: Affect) -> dict[str, float]:
        """The charge, above 0, of each emotion that has one."""
        rates, seconds = self._fading.rates, affect.age
        charges = affect.outlook.charges.items()
        felt = whole({part: charge * exp(-rates[part] * seconds) for part, charge in charges})
        for held in affect.imprint.held.values():
            felt = summed(felt, self._fading.held(held, affect.time).charges)
        return {name: charge for name, charge in felt.items() if charge > 0.0}

    def mood(self, affect: Affect) -> Axes:
        """Pleasure, arousal and dominance, each -1 to 1."""
        return self._fading.read(affect)[1]

    def drives(self, affect: Affect) -> dict[str, float]:
        """How pressing each need is, 0 to 1."""
        return self._fading.read(affect)[2]

    def relations(self, affect: Affect) -> dict[str, float]:
        """What the robot thinks of everyone it knows, -1 to 1; see `relations`."""
        return {
            person: relations.relation_of(trace.at(affect.time, _FADING_RATE).after)
            for person, trace in affect.imprint.relations.items()
        }

    def wear(self, affect: Affect, name: str, person: str | None = None) -> float:
        """How much of a stimulus is lost because it came so often: 0 (nothing) to 1.

        Raises HriError for an unknown stimulus.
        """
        if name not in self._stimuli:
            raise HriError(f'no stimulus "{name}" - {did_you_mean(name, self.names)}')
        trace = affect.imprint.habituation.get(_habit(name, person), FRESH)
        return trace.at(affect.time, self._stimuli[name].recovery_rate).after

    # Why.

    def ledger(self, affect: Affect) -> Ledger:
        """What every cause has left by now: its charges, and its pull on the mood.

        The charges sum to the state's, the pulls to the argument of the mood's tanh. TEMPERAMENT
        stands for the baseline, "drive.NAME" for a drive.
        """
        parts = self._fading.rows(affect.imprint, affect.outlook, affect.age)
        rows = {origin: row._replace(charges=whole(row.charges)) for origin, row in parts.items()}
        for origin, held in affect.imprint.held.items():
            row = self._fading.held(held, affect.time)
            rows[origin] = merged(rows[origin], row) if origin in rows else row
        rows[Origin(TEMPERAMENT)] = LedgerRow({}, self._fading.baseline, affect.time)
        for name, need in self._fading.needs(affect.imprint.needs, affect.age).items():
            rows[Origin(cause_of(name))] = LedgerRow({}, need.mood, affect.time)
        return rows

    def why(self, affect: Affect, about: str = "") -> tuple[Cause, ...]:
        """The causes of what the label names, with shares that sum to 1, the largest first.

        `about` asks about another emotion, or the mood, instead. What pulls the other way is not a
        cause; `ledger` has it. Empty when there is nothing to explain: the robot is calm, or does
        not feel that. Raises HriError for a name that is neither an emotion nor a mood.
        """
        label, ledger = known_as(about) or self.read(affect).label, self.ledger(affect)
        if label in NAMES:
            parts = {origin: row.charges.get(label, 0.0) for origin, row in ledger.items()}
        elif label not in MOODS:
            remedy = did_you_mean(label, (*NAMES, *MOODS))
            raise HriError(f'no emotion and no mood "{label}" - {remedy}')
        elif label == CALM or label != self._mood_name(affect):
            parts = {}
        else:
            parts = _toward_sum(ledger)
        total = sum(part for part in parts.values() if part > 0)
        causes = [
            Cause(
                origin.name,
                part / total,
                affect.time - ledger[origin].time,
                origin.person,
                lasts=_lasts(affect, origin),
            )
            for origin, part in parts.items()
            if part > 0
        ]
        return tuple(sorted(causes, key=lambda cause: (-cause.share, cause.name)))

    def said(self, affect: Affect) -> Mapping[str, str]:
        """What is said of goals, deeds and things after "because", by the name of the cause."""
        return affect.imprint.words

    # What an event finds and leaves.

    def _imprint_at(self, affect: Affect, now: float) -> Imprint:
        """The feelings just before an event: now, or, when that is past, at the state's time. At
        the same instant as the last event, its imprint, so that both count together.

        Raises ValueError for a time that is not finite.
        """
        if not isfinite(now):
            raise ValueError(f"the time must be finite, not {now}")
        imprint, time = affect.imprint, max(now, affect.time)
        seconds = time - imprint.time
        if seconds == 0:
            return imprint
        named_at = _last_naming(Affect(time, imprint, affect.outlook))
        rows = self._fading.rows(imprint, affect.outlook, seconds)
        found = Imprint(
            time,
            pruned(rows, time),
            {},
            self._fading.needs(imprint.needs, seconds),
            imprint.habituation,
            imprint.relations,
            label_at(affect.outlook.course, seconds),
            imprint.held,
            self._mood_named_at(affect, named_at),
            named_at,
            imprint.words,
            imprint.soothed,
        )
        return self._states.without_faded(found) if imprint.held or imprint.words else found

    def _affect(self, imprint: Imprint) -> Affect:
        """The state just after an imprint."""
        older = driven_out(imprint.ledger, imprint.fresh)
        turned = turns(imprint.fresh)
        charges, mood = sums(imprint, older, turned)
        lines = [line for held in imprint.held.values() for line in lines_of(held, imprint.time)]
        ahead = course(imprint.label, charges, self._fading.rates, lines)
        affect = Affect(imprint.time, imprint, Outlook(older, charges, mood, ahead, turned))
        if turned:
            name = mood_name(self._fading.read(affect)[1])
            affect = affect._replace(
                imprint=imprint._replace(mood_name=name, named_at=imprint.time)
            )
        return affect


def _habit(name: str, person: str | None) -> Origin:
    """Under which it gets used to a stimulus; people without a name count as one."""
    return Origin(name, None if person is not None and relations.is_unnamed(person) else person)


def _last_naming(affect: Affect) -> float:
    """When the mood was named last: once an emotion has given way to it, and each MOOD_S."""
    now, imprint = affect.time, affect.imprint
    at, emotion = affect.outlook.course[-1]
    since = imprint.named_at
    if emotion == NOTHING and at > 0.0 and imprint.time + at <= now:
        since = imprint.time + at
    return since + int((now - since) / MOOD_S) * MOOD_S


def _lasts(affect: Affect, origin: Origin) -> bool:
    held = affect.imprint.held.get(origin)
    return held is not None and not held.is_over and affect.time < held.until


def _soothed(
    imprint: Imprint, about: Sequence[Origin], shares: Mapping[str, float], amends: Origin
) -> Imprint:
    """After someone made up for what they did."""
    ledger, (fallen, deed, emotion) = soothed(imprint.ledger, about, shares)
    imprint = imprint._replace(ledger=ledger)
    if fallen < RELIEVED:
        return imprint
    last = Soothed(deed.name, amends.name, deed.person, emotion, imprint.time)
    return imprint._replace(soothed=last)


def _satisfied(
    needs: Mapping[str, Need], satisfies: Mapping[str, float], strength: float
) -> Mapping[str, Need]:
    if not satisfies:
        return needs
    changed = dict(needs)
    for name, share in satisfies.items():
        if name in changed:
            level, mood = changed[name]
            changed[name] = Need(level * (1.0 - share * strength), mood)
    return changed


def _habituated(
    habituation: Mapping[Origin, Trace], origin: Origin, worn: Trace, share: float
) -> Mapping[Origin, Trace]:
    if not share:
        return habituation
    after = 1.0 - (1.0 - worn.after) * (1.0 - share)
    changed = {**habituation, origin: Trace(worn.before, after, worn.time)}
    if len(changed) > MOST_HABITS:
        del changed[min(changed, key=lambda key: changed[key].time)]
    return changed


def _relation(imprint: Imprint, person: str | None) -> float:
    """The relation to a person just before the imprint, -1 to 1; 0 without a person."""
    if person is None or person not in imprint.relations:
        return 0.0
    trace = imprint.relations[person].at(imprint.time, _FADING_RATE)
    return relations.relation_of(trace.before)


def _regarded(imprint: Imprint, person: str | None, regard: float) -> Mapping[str, Trace]:
    if person is None or not regard:
        return imprint.relations
    trace = imprint.relations.get(person, FRESH).at(imprint.time, _FADING_RATE)
    trace = Trace(trace.before, trace.after + regard, trace.time)
    changed = {**imprint.relations, person: trace}
    if len(changed) > relations.MOST:
        del changed[min(changed, key=lambda name: abs(changed[name].after))]
    return changed


def _toward_sum(ledger: Ledger) -> dict[Origin, float]:
    """How far each cause goes in the direction in which all of them go together."""
    p, a, d = total_mood(ledger.values())
    return {
        origin: p * row.mood[0] + a * row.mood[1] + d * row.mood[2]
        for origin, row in ledger.items()
    }
