"""Idle life over time: the states of `idle`, blended into each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Gaze
from hri.face.model import FaceModel
from hri.face.motion import idle
from hri.face.motion.blinking import Blinks
from hri.face.motion.lids import Closures
from hri.face.motion.spring import Follower, Values
from hri.face.vocabulary import TURNS

TIRED = -0.75
"""Arousal of who is wholly tired: that of the expression "tired"."""
_STATE, _AROUSAL = 5.0, 1.5
"""Stiffness, radians a second: of going from one state to another, and of pupils."""


@dataclass(frozen=True, slots=True)
class IdlePose:
    """What life adds now."""

    moves: dict[str, float]
    """Weights of the head's motions and of the pupils."""
    drift: Gaze
    """How far the eyes have wandered."""
    blink: Closures
    """How far a blink shuts the eyes."""


class IdleState:
    """Blinks, eyes, breath and pupils of one face."""

    def __init__(self, model: FaceModel, seed: int) -> None:
        self._settings = model.settings
        self._seed = seed
        self._blinks = Blinks(model.settings.blink, seed)
        self._goal = _shares("resting")
        self._shares = Follower(self._goal)
        self._arousal_goal, self._arousal = 0.0, Follower(0.0)
        self._pupils = model.weights(model.vector(model.settings.pupils))
        self._turns = set(TURNS) <= set(model.channels)

    def be(self, state: str) -> None:
        """Live as in this state from now on."""
        self._goal = _shares(state)

    def feel(self, arousal: float) -> None:
        """How excited the face is, -1 to 1."""
        self._arousal_goal = arousal

    def cause(self, why: str, now: float) -> None:
        """Something happened that may bring a blink; see `Blinks.cause`."""
        self._blinks.cause(why, now)

    def follow(
        self, now: float, dt: float, *, shutting: bool = False, shown: float = 0.0
    ) -> IdlePose:
        """What life adds `dt` seconds after the last call.

        No blink begins while the face is `shutting` its eyes. `shown` is the arousal of the
        expression that is shown: who feels or looks tired blinks slowly.
        """
        arousal = float(self._arousal.follow(self._arousal_goal, dt, _AROUSAL))
        shares = self._shares.follow(self._goal, dt, _STATE)
        states = [(s, float(n)) for s, n in zip(idle.STATES, shares, strict=True) if n > 1e-3]
        moves = {name: weight * arousal for name, weight in self._pupils.items()}
        x = y = rate = 0.0
        for state, share in states:
            look = idle.wandering(self._settings.idle, self._seed, now, state)
            x, y = x + share * look.x, y + share * look.y
            rate += share * idle.STATES[state].blinks * self._settings.blink.rate
            for name, weight in self._body(now, state).items():
                moves[name] = moves.get(name, 0.0) + share * weight
        rate *= 1 + 0.5 * arousal
        tired = min(max(min(arousal, shown) / TIRED, 0.0), 1.0)
        blink = self._blinks.closure(now, rate, shutting=shutting, tired=tired)
        return IdlePose(moves, Gaze(x, y), blink)

    def _body(self, now: float, state: str) -> dict[str, float]:
        moves = idle.sway(self._settings.idle, self._seed, now, state)
        if self._turns:
            turn = idle.turning(self._settings.idle, self._seed, now, state)
            moves |= dict(zip(TURNS, turn, strict=True))
        return moves


def check_state(state: str) -> None:
    """Raises HriError for an unknown state; "" means no state."""
    if state and state not in idle.STATES:
        raise HriError(f'no state "{state}" - {did_you_mean(state, idle.STATES)}')


def _shares(state: str) -> Values:
    """All of one state."""
    return np.array([float(name == state) for name in idle.STATES])
