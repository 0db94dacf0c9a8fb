"""Mood, states and expressions over time: requests jump, the face glides."""

from __future__ import annotations

import math

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Expression
from hri.face.model import FaceModel
from hri.face.motion.affect_map import AffectMap
from hri.face.motion.lids import Lids
from hri.face.motion.run_up import RunUp
from hri.face.motion.spring import ARRIVAL, Follower, Values
from hri.face.regions import NAMES, by_region
from hri.face.settings import Timing

MOOD = 0.6
"""Share of an expression that a mood shows: it is weaker than an explicit expression."""
OBEYED = 0.25
"""Presence of an expression from which on a mood against it does not show: who says in fear that
the battery is low does not smile."""
COVERING = ("asleep", "error")
"""States whose look hides what is expressed; that of the others shows where nothing is."""
PACES = {**dict.fromkeys(NAMES, 1.0), "brows": 1.6, "lids": 1.3, "eyes": 1.3, "head": 0.7}
"""How fast an expression sets in, of its onset: brows and eyes lead, the head follows. Brows are so
fast that they lead in spite of their run-up."""

_BELOW = 4.0
"""Stiffness of mood and state, radians a second."""
_CHANGE = 8.0
"""Least stiffness of an expression that grows stronger or weaker."""


class ExpressionBlender:
    """Blends the expression of a face over its mood and state."""

    def __init__(self, model: FaceModel) -> None:
        self.label = ""
        """Of the expression that is shown, or was last asked for; empty for none."""
        self.displeasure = 0.0
        """How far an unpleasant expression rules out a smile, 0 to 1."""
        self._model = model
        self._affect = AffectMap(model)
        self._lids = Lids(model)
        size = len(model.channels)
        # Behind the weights stands how much an expression is there at all.
        self._goal = np.zeros(size + 1)
        self._shown = Follower(self._goal, np.append(by_region(model.channels, PACES), 1.0))
        self._timing, self._stiffness = Timing(), _CHANGE
        self._run_up, self._is_new = RunUp(model.channels), False
        self._lasts: float | None = None
        self._falls_at = math.inf
        self._mood: tuple[float, float] | None = None
        self._contrary = Follower(0.0)
        self._state = ""
        self._below_goal = np.zeros(size)
        self._below = Follower(self._below_goal)

    def show(self, expression: Expression) -> None:
        """Show an expression. Raises HriError for an unknown label or what is not finite."""
        intensity = bounded("intensity", expression.intensity, 0.0, 1.0)
        if expression.duration is not None and not 0 <= expression.duration < math.inf:
            what = f"an expression for {expression.duration} s"
            raise HriError(f"{what} - give seconds from 0, or None to let it stay")
        weights = self._model.vector(self._model.expression(expression.label))
        # Neutral is how a mood looks through.
        is_neutral = expression.label == "neutral"
        self._goal = intensity * np.append(weights.astype(float), float(not is_neutral))
        self._lasts, self._falls_at = expression.duration, math.inf
        before, self._timing = self._timing, self._model.settings.timing[expression.label]
        if expression.label == self.label:
            self._stiffness = max(self._stiffness, _CHANGE)
        else:
            seconds = before.offset_s if is_neutral else self._timing.onset_s
            self._stiffness = ARRIVAL / seconds
            self._is_new = not is_neutral
        self.label = expression.label

    def fall(self) -> None:
        """Let the expression go."""
        self.label, self._goal, self._falls_at = "", np.zeros_like(self._goal), math.inf
        self._stiffness = ARRIVAL / self._timing.offset_s

    def feel(self, mood: tuple[float, float] | None) -> None:
        """Have a mood: valence and arousal, -1 to 1; None for none."""
        if mood != self._mood:
            self._mood = mood
            self._settle()

    def be(self, state: str) -> None:
        """Look like a state, if the face has an expression of that name; "" for none."""
        self._state = state
        self._settle()

    @property
    def shuts(self) -> float:
        """How far the requested look shuts the eyes, 0 to 1."""
        goal = self._wanted()
        shown = goal[:-1] + (1 - goal[-1]) * self._below_goal
        return self._lids.shut(shown)

    @property
    def arousal(self) -> float:
        """Of the expression that is shown, -1 to 1; 0 where it is about something else."""
        return self._model.settings.affect.get(self.label, (0.0, 0.0))[1]

    def follow(self, now: float, dt: float) -> Values:
        """The weights of all channels: the mood, and in its place as much expression as there is.

        An expression that has lasted long enough falls.
        """
        if self._lasts is not None:
            lasts = self._lasts or self._timing.onset_s + self._timing.apex_s
            self._falls_at, self._lasts = now + lasts, None
        if now >= self._falls_at:
            self.fall()
        shown = self._shown.follow(self._goal_at(now), dt, self._stiffness)
        below = self._below.follow(self._below_goal, dt, _BELOW)
        is_unpleasant = self._affect.valence(self.label) < 0
        self.displeasure = min(shown[-1] / OBEYED, 1.0) if is_unpleasant else 0.0
        contrary = float(self._contrary.follow(float(self._is_contrary), dt, _CHANGE))
        covered = shown[-1] + contrary * (min(shown[-1] / OBEYED, 1.0) - shown[-1])
        mixed: Values = shown[:-1] + (1 - covered) * below
        return mixed

    @property
    def _is_contrary(self) -> bool:
        """Whether the mood is pleasant and what is expressed is not, or the other way round."""
        is_mood = self._mood is not None and self._state not in self._model.expressions
        valence = self._mood[0] if is_mood and self._mood is not None else 0.0
        return valence * self._affect.valence(self.label) < 0

    def _goal_at(self, now: float) -> Values:
        """What is wanted, with the run-up of head and brows."""
        wanted = self._wanted()
        if self._is_new:
            self._run_up.begin(self._shown.value, wanted, self._timing.onset_s, now)
            self._is_new = False
        return self._run_up.goal(wanted, now)

    def _wanted(self) -> Values:
        """What an expression asks for, and how much it is there."""
        return np.zeros_like(self._goal) if self._state in COVERING else self._goal

    def _settle(self) -> None:
        """Set what shows below the expression: the look of the state, else the mood."""
        goal = np.zeros(len(self._below_goal))
        if self._state in self._model.expressions:
            goal = self._model.vector(self._model.expression(self._state)).astype(float)
        elif self._mood is not None:
            goal = MOOD * self._affect.weights(*self._mood).astype(float)
        self._below_goal = goal


def bounded(name: str, value: float, least: float, most: float) -> float:
    """The value within its range. Raises HriError when it is not finite."""
    if not math.isfinite(value):
        raise HriError(f"the {name} is {value} - give a number from {least:g} to {most:g}")
    return min(max(float(value), least), most)
