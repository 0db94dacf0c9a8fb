"""Animates a face: turns requests over time into weights that never jump."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hri.core.signals import Expression, FaceWeights, Gaze, Speech
from hri.face.drawing.baking import Vector
from hri.face.lips.lip_player import PICTURE_LEAD, LipPlayer
from hri.face.model import FaceModel
from hri.face.motion import idle
from hri.face.motion.expression_blender import ExpressionBlender, bounded
from hri.face.motion.gaze import GazeAngles, GazeController
from hri.face.motion.gesture_player import Gestured, GesturePlayer, Playing
from hri.face.motion.gesture_tracks import Gesture, Track
from hri.face.motion.idle_state import IdlePose, IdleState, check_state
from hri.face.motion.lids import Lids
from hri.face.motion.mixer import Layers, Mixer
from hri.face.motion.spring import Follower
from hri.face.motion.turn_gaze import TurnGaze
from hri.face.vocabulary import TURNS

LARGE_SHIFT = 20.0
"""Degrees of a look elsewhere that makes the eyes blink."""
NEARLY_SHUT = 0.6
"""How far eyes are shut that need no blink."""
SMILES = ("mouthSmile", "mouthDimple")
"""Beginnings of the names of the channels that smile."""
_OVERRIDE = 20.0
"""Stiffness, radians a second."""


class Animator:
    """The state of one living face; feed it at any rate."""

    def __init__(self, model: FaceModel, seed: int = 0, latency: float = PICTURE_LEAD) -> None:
        """`latency` is how many seconds pass until a picture of these weights is seen.

        Raises AuthoringError for gestures that cannot be read.
        """
        self.model = model
        self._now = 0.0
        self._state = ""
        self._expressing = ExpressionBlender(model)
        self._speaking = LipPlayer(model, latency)
        self._gesturing = GesturePlayer(model)
        self._looking = GazeController(model.settings)
        self._turning = TurnGaze(model.settings.idle.aversion, seed)
        self._living = IdleState(model, seed)
        self._mixer = Mixer(model)
        # An override is its weights times how much they win, then how much they win.
        self._override = Follower(np.zeros(2 * len(model.channels)))
        self._override_goal = self._override.value
        self._overridden: Mapping[str, float] = {}
        self._lids, self._shut = Lids(model), 0.0
        # A gesture does not smile while the face shows that it is sad, angry or afraid.
        self._smiles = np.array([name.startswith(SMILES) for name in model.channels], float)
        self._turns = TURNS if set(TURNS) <= set(model.channels) else ()

    @property
    def gestures(self) -> Mapping[str, Gesture]:
        """What the face can do, by name."""
        return self._gesturing.known

    # --- requests ---

    def express(self, expression: Expression | None) -> None:
        """Show an expression from now on; None falls back to the mood.

        Raises HriError for an unknown label or what is not finite.
        """
        if expression is None:
            self._expressing.fall()
            return
        before = self._expressing.label
        for name, value in (("valence", expression.valence), ("arousal", expression.arousal)):
            bounded(name, value or 0.0, -1.0, 1.0)
        self._expressing.show(expression)
        if expression.valence is not None or expression.arousal is not None:
            self.feel(expression.arousal or 0.0, expression.valence or 0.0)
        if expression.label != before:
            self._cause("expression changed")

    def feel(self, arousal: float, valence: float | None = None) -> None:
        """How excited the face is, -1 to 1: pupils and blinks follow.

        With a valence, -1 to 1, both are a mood that shows wherever no expression does. Raises
        HriError for what is not finite.
        """
        arousal = bounded("arousal", arousal, -1.0, 1.0)
        mood = None if valence is None else (bounded("valence", valence, -1.0, 1.0), arousal)
        self._living.feel(arousal)
        self._expressing.feel(mood)

    def be(self, state: str) -> None:
        """Be in a state of `idle.STATES` from now on; "" leaves it to expression and speech.

        A state that the face has an expression for also looks like it. Raises HriError.
        """
        if state != self._state:
            check_state(state)
            self._state = state
            self._expressing.be(state)

    def look(self, gaze: Gaze) -> None:
        """Look somewhere from now on. Raises HriError for what is not finite."""
        if self._looking.look(gaze) > LARGE_SHIFT:
            self._cause("gaze shifted")

    def speak(self, speech: Speech | None) -> None:
        """Move the lips to this speech from now on; None when nothing is said."""
        before = self._speaking.speech
        if speech is before:
            return
        self._speaking.say(speech)
        if speech is None or not speech.continues(before):
            self._cause("speech ended" if speech is None else "speech began")

    def gesture(self, name: str, strength: float = 1.0, seconds: float = 0.0) -> Playing:
        """Make a gesture from now on, instead of one that is being made.

        `strength` is 0 to 1.5; `seconds` 0 is its own duration. Raises HriError for an unknown name
        or what is out of range.
        """
        return self._gesturing.make(name, strength, seconds)

    def play(
        self, track: Track, strength: float = 1.0, seconds: float = 0.0, name: str = ""
    ) -> Playing:
        """The same for any track, such as a recording. Raises HriError."""
        return self._gesturing.play(name, track, strength, seconds)

    def override(self, weights: Mapping[str, float]) -> None:
        """Let these weights win from now on, until there are others; none ends it.

        Raises HriError for an unknown name or a weight that is not finite.
        """
        if weights != self._overridden:
            values = self.model.vector(weights).astype(float)
            named = self.model.vector(dict.fromkeys(weights, 1.0)) != 0
            self._override_goal = np.concatenate([values, named])
            self._overridden = dict(weights)

    def _cause(self, why: str) -> None:
        """Perhaps blink, unless the eyes are nearly shut or about to be."""
        if max(self._shut, self._expressing.shuts) < NEARLY_SHUT:
            self._living.cause(why, self._now)

    # --- results ---

    def step(self, now: float, dt: float, position: float | None = None) -> FaceWeights:
        """The weights of now, `dt` seconds after the last ones.

        `position` is how many seconds of the speech have been heard.
        """
        return FaceWeights(self.model.weights(self.vector(now, dt, position)))

    def vector(self, now: float, dt: float, position: float | None = None) -> Vector:
        """The same, a number for each channel of the model."""
        self._now = now
        expression = self._expressing.follow(now, dt)
        viseme, talking = self._speaking.follow(position, dt)
        self._living.be(self._life())
        alive = self._living.follow(
            now,
            dt,
            shutting=self._expressing.shuts >= NEARLY_SHUT,
            shown=self._expressing.arousal,
        )
        look = self._looking.follow(now, dt)
        drift = self._drift(alive, position, dt)
        gesture = self._gesturing.follow(now, dt)
        override = self._override.follow(self._override_goal, dt, _OVERRIDE)
        size = len(self.model.channels)
        left = self._mixer.gaze_left(gesture.owned)
        vector = self._mixer.mix(
            Layers(
                expression=expression,
                viseme=viseme,
                talking=talking,
                blink=alive.blink,
                gaze=_gaze(look, drift, gesture, left),
                inward=left * look.inward,
                idle=self._moves(look, alive),
                gesture=gesture.weights * (1 - self._expressing.displeasure * self._smiles),
                owned=gesture.owned,
                override=override[:size],
                overridden=override[size:],
            )
        )
        self._shut = self._lids.shut(vector.astype(float))
        return vector

    def _life(self) -> str:
        """The state of idle life: of the expression, else as requested, else talking or resting."""
        if self._expressing.label in idle.STATES:
            return self._expressing.label
        return self._state or ("resting" if self._speaking.speech is None else "talking")

    def _drift(self, alive: IdlePose, position: float | None, dt: float) -> Gaze:
        """How far the eyes are from what they look at, by themselves or for the turn."""
        turn = self._turning.follow(self._speaking.speech, position, dt)
        x, y = alive.drift.x, alive.drift.y
        return Gaze((1 - turn.kept) * x + turn.away.x, (1 - turn.kept) * y + turn.away.y)

    def _moves(self, look: GazeAngles, alive: IdlePose) -> dict[str, float]:
        """What moves by itself, and the head that follows the eyes."""
        moves = alive.moves
        for name, weight in zip(self._turns, (look.yaw, look.pitch), strict=False):
            moves[name] += weight
        return moves


def _gaze(look: GazeAngles, drift: Gaze, gesture: Gestured, left: float) -> Gaze:
    """Of the eyes; `left` is what a gesture leaves of where they look without it."""
    x = left * (look.eyes.x + drift.x) + float(gesture.gaze[0])
    y = left * (look.eyes.y + drift.y) + float(gesture.gaze[1])
    return Gaze(min(max(x, -1.0), 1.0), min(max(y, -1.0), 1.0))
