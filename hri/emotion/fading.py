"""How long feelings last and what they do to the mood: the closed forms, for one personality.

    du/dt = -u / tau_emotion            dq/dt = (q_resting - q) / tau_drive
    dm/dt = -m / tau_return + sum(PAD * u) / tau_follow + sum(PAD * (q - q_resting)) / tau_return

for charges u, needs q and the mood m (pleasure, arousal, dominance, off the baseline). Slow parts
of emotions and what is held pull it with less force, since they do for longer (CALMLY). An
exponential decay of rate a, in something that itself decays at rate b, leaves the convolution of
both, exp(-slow t) (1 - exp(-gap t)) / gap with slow = min(a, b) and gap = |a - b|. Written so, with
expm1, nearly equal rates and huge times are harmless.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import atanh, exp, expm1, tanh
from typing import NamedTuple

from hri.emotion.affect import Affect, Imprint, Need, Outlook
from hri.emotion.emotions import EMOTIONS, INDEX, NAMES, PART_OF
from hri.emotion.held import Held, Level
from hri.emotion.ledger import STILL, Axes, LedgerRow, Origin, merged
from hri.emotion.personality import Personality

FORGOTTEN = 1e-15
"""A charge below this is dropped when something new happens."""
CALMLY = 0.25
"""Of the force of a pulse, that of a slow part and of a state that goes on."""
_UNFELT = dict.fromkeys(NAMES, 0.0)
_NO_GAP = -1e-200
"""Instead of a gap of 0, so that (1 - exp(-gap t)) / gap is t as it ought to be."""


_Step = tuple[float, float, float, float]
"""What is left of 1, and how far it has pulled the mood."""


class Force(NamedTuple):
    """Something that fades exponentially and pulls the mood while it lasts."""

    slow: float
    """The smaller of the cause's rate and the mood's, 1/s."""
    gap: float
    """Minus the distance of both, 1/s; below 0."""
    pleasure: float
    """Speed at which 1 of it pulls the mood, 1/s, over the gap."""
    arousal: float
    dominance: float


class Fading:
    """What some seconds in which nothing happens leave of a state."""

    def __init__(self, personality: Personality) -> None:
        pleasure, arousal, dominance = map(atanh, personality.baseline)
        self.baseline = (pleasure, arousal, dominance)
        """Of the mood, before the tanh."""
        self._return_rate = 1.0 / personality.return_s
        self.rates = {
            part: 1.0 / personality.tau_s(EMOTIONS[INDEX[name]], is_slow=part != name)
            for part, name in PART_OF.items()
        }
        """Decay of each part of an emotion, 1/s."""
        follow_rate = 1.0 / personality.follow_s
        self._pulls = {
            emotion.name: tuple(
                CALMLY * follow_rate * axis
                for axis in (emotion.pleasure, emotion.arousal, emotion.dominance)
            )
            for emotion in EMOTIONS
        }
        """Speed at which a charge of 1 that is held pulls the mood, 1/s."""
        self._emotions = {
            part: self._force(
                self.rates[part],
                follow_rate if part == emotion.name else CALMLY * follow_rate,
                (emotion.pleasure, emotion.arousal, emotion.dominance),
            )
            for part, emotion in ((part, EMOTIONS[INDEX[name]]) for part, name in PART_OF.items())
        }
        self._drives = {
            drive.name: self._force(
                1.0 / drive.tau_s,
                self._return_rate,
                (drive.pleasure, drive.arousal, drive.dominance),
            )
            for drive in personality.drives
        }
        self._resting = {drive.name: drive.resting for drive in personality.drives}

    def _force(self, rate: float, scale: float, axes: Axes) -> Force:
        gap = -abs(rate - self._return_rate) or _NO_GAP
        pleasure, arousal, dominance = (axis * scale / gap for axis in axes)
        return Force(min(rate, self._return_rate), gap, pleasure, arousal, dominance)

    def read(self, affect: Affect) -> tuple[dict[str, float], Axes, dict[str, float]]:
        """All that is felt, whatever its cause.

        The intensities of all emotions, 0 to 1; the mood, -1 to 1 each; the needs, 0 to 1.
        """
        now, imprint, outlook = affect
        seconds = now - imprint.time
        forces, mood_rate, felt = self._emotions, self._return_rate, dict[str, float]()
        kept = exp(-mood_rate * seconds)
        p, a, d = outlook.mood
        p, a, d = p * kept, a * kept, d * kept
        for name, charge in outlook.charges.items():
            slow, gap, pleasure, arousal, dominance = forces[name]
            if slow == mood_rate:
                held = charge * kept
                lost = held * expm1(gap * seconds)
                charge = held + lost
            else:
                charge = held = charge * exp(-slow * seconds)
                lost = held * expm1(gap * seconds)
            emotion = PART_OF[name]
            felt[emotion] = felt.get(emotion, 0.0) + charge
            p += lost * pleasure
            a += lost * arousal
            d += lost * dominance
        levels, resting = {}, self._resting
        for name, (level, _) in imprint.needs.items():
            rest = resting[name]
            if level != rest:
                slow, gap, pleasure, arousal, dominance = self._drives[name]
                if slow == mood_rate:
                    held = (level - rest) * kept
                    lost = held * expm1(gap * seconds)
                    level = rest + (held + lost)
                else:
                    held = (level - rest) * exp(-slow * seconds)
                    lost = held * expm1(gap * seconds)
                    level = rest + held
                p += lost * pleasure
                a += lost * arousal
                d += lost * dominance
            levels[name] = level
        for state in imprint.held.values():
            charges, (pleasure, arousal, dominance), _ = self.held(state, now)
            for name, charge in charges.items():
                felt[name] = felt.get(name, 0.0) + charge
            p += pleasure
            a += arousal
            d += dominance
        intensities = _UNFELT.copy()
        for name, charge in felt.items():
            intensities[name] = -expm1(-charge) or 0.0
        pleasure, arousal, dominance = self.baseline
        return intensities, (tanh(pleasure + p), tanh(arousal + a), tanh(dominance + d)), levels

    def rows(self, imprint: Imprint, outlook: Outlook, seconds: float) -> dict[Origin, LedgerRow]:
        """The same cause by cause: what is left of its charges, and its pull on the mood."""
        kept = exp(-self._return_rate * seconds)
        steps = self._steps(self._emotions, outlook.charges, kept, seconds)
        rows = {}
        for origin, (charges, (p, a, d), time) in outlook.older.items():
            mood = p * kept, a * kept, d * kept
            rows[origin] = _evolved(charges, steps, mood, time)
        turned = outlook.turned
        for origin, charges in imprint.fresh.items():
            p, a, d = turned.get(origin, STILL)
            row = _evolved(charges, steps, (p * kept, a * kept, d * kept), imprint.time)
            rows[origin] = merged(rows[origin], row) if origin in rows else row
        return rows

    def held(self, state: Held, now: float) -> LedgerRow:
        """The charges of a state at a time, and its pull on the mood until then."""
        if now > state.until:
            state = self.ended(state)
        seconds, mood_rate = now - state.since, self._return_rate
        kept = exp(-mood_rate * seconds)
        steady = -expm1(-mood_rate * seconds) / mood_rate
        # The convolution of what is still on its way with the way back of the mood.
        gap = abs(state.rate - mood_rate) or -_NO_GAP
        moving = exp(-min(state.rate, mood_rate) * seconds) * -expm1(-gap * seconds) / gap
        p, a, d = state.mood
        p, a, d = p * kept, a * kept, d * kept
        charges = {}
        for name, level in state.levels.items():
            pleasure, arousal, dominance = self._pulls[name]
            pull = level.target * steady + (level.start - level.target) * moving
            p += pull * pleasure
            a += pull * arousal
            d += pull * dominance
            charges[name] = state.at(level, now)
        return LedgerRow(charges, (p, a, d), state.since)

    def ended(self, state: Held) -> Held:
        """A state from its end on, when its levels fall."""
        charges, mood, _ = self.held(state, state.until)
        levels = {name: Level(charge, 0.0) for name, charge in charges.items()}
        return Held(state.until, levels, state.fall_rate, mood, fall_rate=state.fall_rate)

    def needs(self, needs: Mapping[str, Need], seconds: float) -> dict[str, Need]:
        """The drives, and what they have done to the mood."""
        kept = exp(-self._return_rate * seconds)
        drifted, resting = dict(needs), self._resting
        moved = [name for name, need in needs.items() if need != (resting[name], STILL)]
        for name, step in self._steps(self._drives, moved, kept, seconds).items():
            decay, pleasure, arousal, dominance = step
            level, (p, a, d) = needs[name]
            off = level - resting[name]
            mood = p * kept + off * pleasure, a * kept + off * arousal, d * kept + off * dominance
            drifted[name] = Need(resting[name] + off * decay, mood)
        return drifted

    def _steps(
        self, forces: Mapping[str, Force], names: Iterable[str], kept: float, seconds: float
    ) -> dict[str, _Step]:
        """What some seconds do to 1 of some forces; `kept` is what they leave of a mood."""
        mood_rate, steps = self._return_rate, {}
        for name in names:
            slow, gap, pleasure, arousal, dominance = forces[name]
            if slow == mood_rate:
                # Of what fades faster than the mood exp(-slow t) exp(-gap t) is left.
                pull = kept * expm1(gap * seconds)
                left = kept + pull
            else:
                left = exp(-slow * seconds)
                pull = left * expm1(gap * seconds)
            steps[name] = left, pull * pleasure, pull * arousal, pull * dominance
        return steps


def _evolved(
    charges: Mapping[str, float], steps: Mapping[str, _Step], mood: Axes, time: float
) -> LedgerRow:
    """A row after the steps; of its mood this is left."""
    p, a, d = mood
    evolved = {}
    for name, charge in charges.items():
        decay, pleasure, arousal, dominance = steps[name]
        p += charge * pleasure
        a += charge * arousal
        d += charge * dominance
        charge *= decay
        if charge > FORGOTTEN:
            evolved[name] = charge
    return LedgerRow(evolved, (p, a, d), time)
