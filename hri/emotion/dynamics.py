"""How feelings rise and fade: a state goes in, what has happened since, and a state comes out.

Each event leaves a charge per emotion that decays exponentially, each need drifts to its resting
level; both pull a slow mood (pleasure, arousal, dominance) that returns to the personality's
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
    Fresh,
    Imprint,
    Need,
    Outlook,
    Trace,
    driven_out,
    renamed,
    sums,
    without,
)
from hri.emotion.appraisal import GoalEvent, OccEvent, appraise, check_name
from hri.emotion.drives import cause_of
from hri.emotion.emotions import EMOTIONS, NAMES
from hri.emotion.fading import Fading
from hri.emotion.label import CALM, MOODS, NOTHING, course, known_as, label_at, mood_name
from hri.emotion.ledger import (
    REST,
    STILL,
    TEMPERAMENT,
    Axes,
    Cause,
    Ledger,
    LedgerRow,
    Origin,
    pruned,
    summed,
    total_mood,
)
from hri.emotion.personality import Personality
from hri.emotion.stimulus import StimulusSpec

MOST_HABITS = 500
"""Habituations that are remembered; of more the one that was touched longest ago is forgotten."""
MOST_AT_ONCE = 50
"""Causes that are kept apart of what happens at one instant; what is more counts as the rest."""
_FADING_RATE = 1.0 / relations.FADES_S
_FARTHEST = sqrt(3)
"""Distance of a corner from the origin."""


@dataclass(frozen=True, slots=True)
class _Taken:
    """A stimulus as a personality takes it."""

    charges: Mapping[str, float]
    """Charge per emotion in full strength, with the personality's gains."""
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
        self._rest = {drive.name: Need(drive.resting, STILL) for drive in personality.drives}

    def _taken(self, stimulus: StimulusSpec) -> _Taken:
        return _Taken(
            charges={
                name: self._gains[name] * charge
                for name, charge in zip(NAMES, stimulus.charges(), strict=True)
                if charge
            },
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
        return self.advance(self._affect(imprint._replace(needs=needs)), now)

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

    def rename(self, affect: Affect, names: Mapping[str, str]) -> Affect:
        """The same state with people under other names, once it is known who they are."""
        return self.advance(self._affect(renamed(affect.imprint, names)), affect.time)

    # What happens.

    def feel(
        self, affect: Affect, name: str, intensity: float, now: float, person: str | None = None
    ) -> Affect:
        """The state just after a stimulus of intensity 0 to 1, which may come from a person.

        One of intensity 0 has not happened. Raises HriError for an unknown stimulus, ValueError for
        an intensity out of range, a person without a name or of a very long one, or a time that is
        not finite.
        """
        if name not in self._stimuli:
            raise HriError(f'no stimulus "{name}" - {did_you_mean(name, self.names)}')
        if not 0 <= intensity <= 1:
            raise ValueError(f"the intensity of {name} is {intensity} - give 0 to 1")
        if person is not None:
            check_name("person", person)
        if intensity == 0:
            return self.advance(affect, now)
        stimulus, origin = self._stimuli[name], Origin(name, person)
        # It habituates to people it cannot distinguish as if they were one.
        habit = Origin(name) if person is not None and relations.is_unnamed(person) else origin
        imprint = self._imprint_at(affect, now)
        worn = imprint.habituation.get(habit, FRESH).at(imprint.time, stimulus.recovery_rate)
        strength = intensity * (1.0 - worn.before)
        charges = {name: charge * strength for name, charge in stimulus.charges.items()}
        if relation := _relation(imprint, person):
            charges = relations.weighted(charges, relation)
        return self._affect(
            Imprint(
                imprint.time,
                imprint.ledger,
                _with_charges(imprint.fresh, origin, charges),
                _satisfied(imprint.needs, stimulus.satisfies, strength),
                _habituated(imprint.habituation, habit, worn, stimulus.habituates),
                _regarded(imprint, person, stimulus.relation * strength),
                imprint.label,
            )
        )

    def appraise(self, affect: Affect, event: OccEvent, now: float) -> Affect:
        """The state just after an event that touches the robot's goals, standards or tastes.

        Raises ValueError for a time that is not finite.
        """
        imprint = self._imprint_at(affect, now)
        owner = event.owner if isinstance(event, GoalEvent) else None
        meaning = appraise(event, _relation(imprint, owner))
        charges = {name: charge * self._gains[name] for name, charge in meaning.charges.items()}
        ledger = imprint.ledger
        if meaning.ends:
            ledger = without(ledger, meaning.cause, meaning.ends)
        return self._affect(
            Imprint(
                imprint.time,
                ledger,
                _with_charges(imprint.fresh, Origin(meaning.cause, meaning.person), charges),
                imprint.needs,
                imprint.habituation,
                _regarded(imprint, meaning.person, relations.PRAISED * meaning.praise),
                imprint.label,
            )
        )

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
        if label == NOTHING:
            label, intensity = mood_name(mood), hypot(*mood) / _FARTHEST
        else:
            intensity = intensities[label]
        return EmotionState(label, intensity, *mood, intensities, levels)

    def charges(self, affect: Affect) -> dict[str, float]:
        """The charge, above 0, of each emotion that has one."""
        rates, seconds = self._fading.rates, affect.age
        charges = affect.outlook.charges.items()
        return {name: charge * exp(-rates[name] * seconds) for name, charge in charges}

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

    # Why.

    def ledger(self, affect: Affect) -> Ledger:
        """What every cause has left by now: its charges, and its pull on the mood.

        The charges sum to the state's, the pulls to the argument of the mood's tanh. TEMPERAMENT
        stands for the baseline, "drive.NAME" for a drive.
        """
        rows = self._fading.rows(affect.imprint, affect.outlook, affect.age)
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
        elif label == CALM or label != mood_name(self.mood(affect)):
            parts = {}
        else:
            parts = _toward_sum(ledger)
        whole = sum(part for part in parts.values() if part > 0)
        causes = [
            Cause(origin.name, part / whole, affect.time - ledger[origin].time, origin.person)
            for origin, part in parts.items()
            if part > 0
        ]
        return tuple(sorted(causes, key=lambda cause: (-cause.share, cause.name)))

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
        return Imprint(
            time,
            pruned(self._fading.rows(imprint, affect.outlook, seconds), time),
            {},
            self._fading.needs(imprint.needs, seconds),
            imprint.habituation,
            imprint.relations,
            label_at(affect.outlook.course, seconds),
        )

    def _affect(self, imprint: Imprint) -> Affect:
        """The state just after an imprint."""
        older = driven_out(imprint.ledger, imprint.fresh)
        charges, mood = sums(imprint, older)
        ahead = course(imprint.label, charges, self._fading.rates)
        return Affect(imprint.time, imprint, Outlook(older, charges, mood, ahead))


def _with_charges(fresh: Fresh, origin: Origin, charges: Mapping[str, float]) -> Fresh:
    if origin not in fresh and len(fresh) >= MOST_AT_ONCE:
        origin = REST
    if origin in fresh:
        charges = summed(fresh[origin], charges)
    return {**fresh, origin: charges}


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
