"""Where a speaker looks for the sake of the turn: away as a longer one begins, back at its end.

Speakers look away while they plan what to say, and at the listener as they finish, which hands the
turn over (Kendon 1967, "Some functions of gaze-direction in social interaction").
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hri.core.signals import Gaze, Speech
from hri.face.motion.chance import chance
from hri.face.motion.spring import Follower

LONGER = 80
"""Characters of a text from which on its turn is a longer one: some five seconds."""
AWAY_FROM, AWAY_UNTIL = 0.1, 0.9
"""Seconds of the speech in which the eyes are away."""
AWAY = (0.8, 0.4)
"""To the side and up, of a look away that is as large as the face's setting says."""
BACK = 0.6
"""Seconds before the end of what is said from which on the eyes do not wander."""
_AWAY, _BACK, _FREE = 45.0, 15.0, 2.5
"""Stiffness, radians a second: of looking away, of coming back, and of wandering again."""


@dataclass(frozen=True, slots=True)
class TurnLook:
    """What the turn asks of the eyes."""

    kept: float
    """How much they stay on the listener instead of wandering, 0 to 1."""
    away: Gaze
    """How far they look away."""


class TurnGaze:
    """The eyes of one face that speaks."""

    def __init__(self, aversion: float, seed: int) -> None:
        """`aversion` is how far the eyes look away, in units of gaze."""
        self._aversion, self._seed = aversion, seed
        self._kept, self._away = Follower(0.0), Follower(np.zeros(2))

    def follow(self, speech: Speech | None, position: float | None, dt: float) -> TurnLook:
        """`dt` seconds after the last call, `position` seconds into a speech."""
        ends = begins = False
        if speech is not None and position is not None:
            ends = position > speech.duration - BACK
            begins = AWAY_FROM < position < AWAY_UNTIL and len(speech.text) >= LONGER
        kept = self._kept.follow(float(ends), dt, _BACK if ends else _FREE)
        goal = self._way(speech.text) if speech is not None and begins else np.zeros(2)
        x, y = self._away.follow(goal, dt, _AWAY)
        return TurnLook(float(kept), Gaze(float(x), float(y)))

    def _way(self, text: str) -> np.ndarray:
        """To one side, the same whenever this is said."""
        side = 1.0 if chance(self._seed, text, 0) < 0.5 else -1.0
        return self._aversion * np.array([side * AWAY[0], AWAY[1]])
