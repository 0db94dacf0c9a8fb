"""Brings a face to life: what is asked of it, over time, becomes weights that never jump."""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Expression, FaceWeights, Gaze, Speech
from hri.face import idle
from hri.face.lipsync import LipTrack, lip_track
from hri.face.mixer import Layers, Mixer
from hri.face.model import FaceModel
from hri.face.spring import Spring, Values

PICTURE_LEAD = 0.05
"""Seconds by which the track of the lips is read ahead of what is heard: one frame until the
picture is seen, and a little more, since lips that are early look right and late ones do not."""

_BROWS, _MOUTH, _HEAD = 12.0, 9.0, 6.0
"""Stiffness of expressions, radians a second: the brows lead, the head follows."""
_LIPS = 70.0
"""Shut within 100 ms of a cut."""
_TALKING, _EYES, _AROUSAL = 30.0, 25.0, 1.5
_BLINK_GAP = 1.0
"""Seconds between two blinks that something caused."""
_TURN = 0.5
"""A change of gaze, of its range, that makes the eyes blink."""


class Animator:
    """The state of one living face; feed it at any rate."""

    def __init__(self, model: FaceModel, seed: int = 0) -> None:
        self.model = model
        self.seed = seed
        self._mixer = Mixer(model)
        rest = np.zeros(len(model.channels))
        self._label = ""
        self._expression, self._expression_spring = rest, Spring(_stiffness(model))
        self._visemes, self._lip_spring = rest, Spring(np.full(len(rest), _LIPS))
        self._talking, self._talking_spring = 0.0, Spring(_TALKING)
        self._gaze, self._gaze_spring = np.zeros(2), Spring(np.full(2, _EYES))
        self._arousal, self._arousal_spring = 0.0, Spring(_AROUSAL)
        self._speech: Speech | None = None
        self._track: LipTrack | None = None
        self._followed: LipTrack | None = None
        self._blinked_at = -math.inf
        self.express(Expression())
        self._wants_blink = False

    def express(self, expression: Expression) -> None:
        """Show an expression from now on. Raises HriError for an unknown label."""
        weights = self.model.vector(self.model.expression(expression.label))
        intensity = min(max(expression.intensity, 0.0), 1.0)
        goal = weights.astype(float) * intensity
        self._expression_spring.jump(self._expression, goal)
        self._expression = goal
        if expression.label != self._label:
            self._label = expression.label
            self._wants_blink = True

    def look(self, gaze: Gaze) -> None:
        """Look somewhere from now on."""
        goal = np.clip([gaze.x, gaze.y], -1, 1)
        if np.abs(goal - self._gaze).max() > _TURN:
            self._wants_blink = True
        self._gaze_spring.jump(self._gaze, goal)
        self._gaze = goal

    def feel(self, arousal: float) -> None:
        """How excited the face is, -1 to 1: pupils and blinks follow."""
        goal = min(max(arousal, -1.0), 1.0)
        self._arousal_spring.jump(self._arousal, goal)
        self._arousal = goal

    def speak(self, speech: Speech | None) -> None:
        """Move the lips to this speech from now on; None when nothing is said."""
        if speech is self._speech:
            return
        self._speech = speech
        self._track = None if speech is None else lip_track(speech)
        talking = 0.0 if speech is None else 1.0
        self._talking_spring.jump(self._talking, talking)
        self._talking = talking
        self._wants_blink = self._wants_blink or speech is None

    def step(self, now: float, dt: float, position: float | None = None) -> FaceWeights:
        """The weights of now; `position` is how many seconds of the speech have been heard."""
        arousal = float(self._arousal_spring.follow(self._arousal, dt))
        is_talking = self._speech is not None
        gaze = self._gaze_spring.follow(self._gaze, dt)
        drift = idle.wandering(self.model.settings.idle, self.seed, now, is_talking)
        layers = Layers(
            expression=self._expression_spring.follow(self._expression, dt).astype(np.float32),
            viseme=self._lips(position, dt).astype(np.float32),
            talking=float(self._talking_spring.follow(self._talking, dt)),
            blink=self._lids(now, arousal),
            gaze=Gaze(_in_range(gaze[0] + drift.x), _in_range(gaze[1] + drift.y)),
            idle=self._idle(now, arousal),
        )
        return FaceWeights(self.model.weights(self._mixer.mix(layers)))

    def _lips(self, position: float | None, dt: float) -> Values:
        """The track at what is heard now; a track that begins or is cut short glides."""
        track = None if position is None else self._track
        goal = np.zeros(len(self.model.channels))
        if track is not None and position is not None:
            goal = self._shape(track.weights(position + PICTURE_LEAD))
        if track is not self._followed:
            self._lip_spring.jump(self._visemes, goal)
        self._followed, self._visemes = track, goal
        return self._lip_spring.follow(goal, dt)

    def _shape(self, visemes: dict[str, float]) -> Values:
        shape = np.zeros(len(self.model.channels))
        for viseme, weight in visemes.items():
            shape += weight * self.model.vector(self.model.viseme(viseme))
        return shape

    def _lids(self, now: float, arousal: float) -> float:
        """Blinks of idle life, and those that a change causes."""
        blink = self.model.settings.blink
        if self._wants_blink and now - self._blinked_at > _BLINK_GAP:
            self._blinked_at = now
        self._wants_blink = False
        rate = blink.rate * (1 + 0.5 * arousal)
        caused = idle.lid_closure(blink, now - self._blinked_at)
        return max(caused, idle.blink_closure(blink, self.seed, now, rate))

    def _idle(self, now: float, arousal: float) -> dict[str, float]:
        moves = idle.sway(self.model.settings.idle, self.seed, now)
        for name, weight in self.model.settings.pupils.items():
            moves[name] = moves.get(name, 0.0) + weight * arousal
        return moves


def _in_range(value: float) -> float:
    return float(min(max(value, -1.0), 1.0))


def _stiffness(model: FaceModel) -> Values:
    def of(channel: str) -> float:
        if channel.startswith("head"):
            return _HEAD
        return _MOUTH if channel.startswith(("mouth", "jaw", "tongue")) else _BROWS

    return np.array([of(channel) for channel in model.channels])
