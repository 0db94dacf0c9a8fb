"""How feelings rise and fade, in closed form for any time step.

Each stimulus leaves a charge per emotion that decays exponentially; the charges pull a slow mood
(pleasure, arousal, dominance) that returns to the personality's baseline:

    du/dt = -u / tau_emotion        dm/dt = -m / tau_return + sum(PAD * u) / tau_follow

Both are linear, so the state is kept as one row per stimulus, a ledger of causes: the sum of its
rows is the state, and "why?" is answered by reading it. What others see saturates by itself:
intensity = 1 - exp(-u), mood = tanh(atanh(baseline) + m). Nothing is clamped, nothing needs a tick.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import EmotionState
from hri.emotion.emotions import EMOTIONS, NAMES, OPPOSITION, PAD, Vector
from hri.emotion.label import CALM, MOODS, NOTHING, leader, mood_name
from hri.emotion.personality import Personality
from hri.emotion.stimulus import TEMPERAMENT, StimulusSpec


@dataclass(frozen=True, slots=True)
class Affect:
    """All that is felt at a time, by cause: one row per stimulus. Charges have no unit."""

    time: float
    """Seconds."""
    settled: Vector
    """Charges from before this instant, shape [stimuli, emotions], >= 0."""
    fresh: Vector
    """Charges that came at this very instant, same shape. Kept apart so that stimuli of the same
    instant drive out older opposites, not each other, and their order does not matter."""
    mood: Vector
    """Pull on pleasure, arousal, dominance, off the baseline, shape [stimuli, 3]."""
    habituation: Vector
    """0 (new) to 1 (no effect any more), shape [stimuli]."""
    standing_out: int
    """Index of the emotion that has the label, NOTHING for none."""

    @property
    def charges(self) -> Vector:
        """Shape [stimuli, emotions]."""
        return self.settled + self.fresh


def drive_response(seconds: float, rate: Vector, other_rate: float) -> Vector:
    """What a decay at `rate` leaves in something that it drives and that decays at `other_rate`.

    The convolution of both exponentials, written so that equal rates and huge times are harmless.
    Rates in 1/s, above 0.
    """
    slow = np.minimum(rate, other_rate)
    gap = np.abs(rate - other_rate)
    grown = np.where(gap == 0, seconds, -np.expm1(-gap * seconds) / np.where(gap == 0, 1.0, gap))
    response: Vector = np.exp(-slow * seconds) * grown
    return response


class Dynamics:
    """The arithmetic of one personality and one set of stimuli; states go in and come out."""

    def __init__(self, personality: Personality, stimuli: Sequence[StimulusSpec]) -> None:
        self.personality = personality
        self.names = tuple(stimulus.name for stimulus in stimuli)
        self._index = {name: row for row, name in enumerate(self.names)}
        gains = np.array([personality.gain(emotion) for emotion in EMOTIONS])
        self._impulses = np.array([stimulus.charges() for stimulus in stimuli]) * gains
        self._rates = 1.0 / np.array([personality.tau_s(emotion) for emotion in EMOTIONS])
        self._return_rate = 1.0 / personality.return_s
        self._pull = PAD / personality.follow_s
        self._baseline = np.arctanh(np.array(personality.baseline))
        self._habituates = np.array([stimulus.habituates for stimulus in stimuli])
        self._recovery_rates = 1.0 / np.array([stimulus.recover_s for stimulus in stimuli])

    def rest(self, now: float = 0.0) -> Affect:
        """Nothing felt yet: the baseline."""
        rows = len(self.names)
        nothing = np.zeros((rows, len(NAMES)))
        return Affect(now, nothing, nothing, np.zeros((rows, 3)), np.zeros(rows), NOTHING)

    def advance(self, affect: Affect, now: float) -> Affect:
        """The state at a later time; an earlier time changes nothing.

        Raises ValueError for a time that is not finite.
        """
        if not math.isfinite(now):
            raise ValueError(f"the time must be finite, not {now}")
        seconds = now - affect.time
        if seconds <= 0:
            return affect
        charges = affect.charges
        driven = charges * drive_response(seconds, self._rates, self._return_rate)
        return Affect(
            time=now,
            settled=charges * np.exp(-self._rates * seconds),
            fresh=np.zeros_like(charges),
            mood=affect.mood * math.exp(-self._return_rate * seconds) + driven @ self._pull,
            habituation=affect.habituation * np.exp(-self._recovery_rates * seconds),
            standing_out=leader(affect.standing_out, charges.sum(axis=0), self._rates, seconds),
        )

    def feel(self, affect: Affect, name: str, intensity: float, now: float) -> Affect:
        """The state just after a stimulus of intensity 0 to 1.

        Raises HriError for an unknown stimulus, ValueError for an intensity out of range.
        """
        row = self._row(name)
        if not 0 <= intensity <= 1:
            raise ValueError(f"the intensity of {name} is {intensity} - give 0 to 1")
        affect = self.advance(affect, now)
        added = self._impulses[row] * intensity * (1 - affect.habituation[row])
        fresh = affect.fresh.copy()
        fresh[row] += added
        habituation = affect.habituation.copy()
        habituation[row] = 1 - (1 - habituation[row]) * (1 - self._habituates[row])
        settled = affect.settled * np.exp(-(added @ OPPOSITION))
        return replace(affect, settled=settled, fresh=fresh, habituation=habituation)

    def read(self, affect: Affect) -> EmotionState:
        """What is felt, as others may see it."""
        mood = self.mood(affect)
        charges = affect.charges.sum(axis=0)
        intensities = -np.expm1(-charges)
        standing_out = leader(affect.standing_out, charges, self._rates, 0.0)
        if standing_out == NOTHING:
            label, intensity = mood_name(mood), float(np.linalg.norm(mood)) / math.sqrt(3)
        else:
            label, intensity = NAMES[standing_out], float(intensities[standing_out])
        emotions = dict(zip(NAMES, intensities.tolist(), strict=True))
        pleasure, arousal, dominance = mood.tolist()
        return EmotionState(label, intensity, pleasure, arousal, dominance, emotions)

    def mood(self, affect: Affect) -> Vector:
        """Pleasure, arousal and dominance, each -1 to 1."""
        mood: Vector = np.tanh(self._baseline + affect.mood.sum(axis=0))
        return mood

    def why(self, affect: Affect) -> list[tuple[str, float]]:
        """The causes of what the label names, with their shares, the largest first.

        Shares sum to 1; one is negative when its cause pulls the other way. "temperament" stands
        for the personality's baseline. Empty when the robot is calm: that needs no reason.
        """
        label = self.read(affect).label
        if label == CALM:
            return []
        shares = self._mood_shares(affect) if label in MOODS else self._shares(affect, label)
        known = [(name, float(share)) for name, share in shares.items() if share != 0]
        return sorted(known, key=lambda cause: -cause[1])

    def _shares(self, affect: Affect, emotion: str) -> dict[str, float]:
        column = affect.charges[:, NAMES.index(emotion)]
        return dict(zip(self.names, column / column.sum(), strict=True))

    def _mood_shares(self, affect: Affect) -> dict[str, float]:
        """Each cause's part of the way from the origin to the mood."""
        causes = np.vstack([self._baseline, affect.mood])
        whole = causes.sum(axis=0)
        return dict(zip((TEMPERAMENT, *self.names), causes @ whole / (whole @ whole), strict=True))

    def _row(self, name: str) -> int:
        if name not in self._index:
            raise HriError(f'no stimulus "{name}" - {did_you_mean(name, self.names)}')
        return self._index[name]
