"""The face in a network: what is felt, said and looked at becomes weights, and those a picture."""

from __future__ import annotations

from functools import partial

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.signals import Expression, FaceWeights, Gaze, Image, Speech
from hri.face.animator import Animator
from hri.face.model import load_face
from hri.hal.screen import Screen

RENDER_LATENCY = 0.02
"""Seconds that a picture takes on the fake clock: less than a tick at 30 Hz."""


class Face(Behavior):
    """Animates a face: expression, lips, blinks and gaze, mixed into weights of morph targets."""

    category = "face"

    face = Param("robot", "name of a folder in faces/, or a path")
    expression = Input[Expression](
        "expression", "what the face shows; the last one stays", is_optional=True
    )
    speech = Input[Speech]("speech", "what is being said", is_optional=True)
    position = Input[float](
        "double", "seconds of the speech that have been heard", is_optional=True
    )
    is_speaking = Input[bool]("boolean", "whether the speech plays", is_optional=True)
    gaze = Input[Gaze]("gaze", "where to look; straight ahead when nothing comes", is_optional=True)
    arousal = Input[float]("double", "-1 to 1: pupils and blinks follow", is_optional=True)
    weights = Output[FaceWeights]("weights", "weights of all channels that are not at rest")
    caption = Output[str]("string", "the text that is being said")

    def check(self) -> None:
        load_face(self.face)

    def start(self, context: Context) -> None:
        self._animator = Animator(load_face(self.face), context.seed_for("face"))
        self._expression = Expression()
        self._speech: Speech | None = None

    def compute(self, now: float, dt: float) -> None:
        animator = self._animator
        expression = self.expression.value
        if expression is not None and expression != self._expression:
            self._expression = expression
            animator.express(expression)
        animator.look(self.gaze.value or Gaze())
        animator.feel(self.arousal.value or 0.0)
        speech = self._current_speech()
        animator.speak(speech)
        self.weights.send(animator.step(now, dt, self.position.value))
        if speech is not None:
            self.caption.send(speech.text)

    def _current_speech(self) -> Speech | None:
        """The speech that plays: it may be sent at every tick or only at the first."""
        if self.speech.value is not None:
            self._speech = self.speech.value
        is_heard = self.is_speaking.value
        if is_heard is None:
            is_heard = self.position.value is not None
        return self._speech if is_heard else None


class FaceRenderer(Behavior):
    """Draws the newest weights and shows them on a screen, one picture a tick at most."""

    category = "face"

    screen_id = Param("screen", "id of the screen")
    face = Param("robot", "name of a folder in faces/, or a path")
    captions = Param(False, "write what is said below the face")
    weights = Input[FaceWeights]("weights", "what to draw")
    caption = Input[str]("string", "what to write, when captions are on", is_optional=True)

    captions_on = False
    """Whether captions are written; may be switched at any time."""
    frames = 0
    """Pictures shown."""

    def check(self) -> None:
        load_face(self.face)

    def start(self, context: Context) -> None:
        """Raises HriError when the face cannot be read or the screen is too large or small."""
        from hri.face.renderers.opencv import OpenCvRenderer

        self.captions_on = self.captions
        self.frames = 0
        self._events = context.events
        self._refused = ""
        self._screen = context.resources.obtain(self.screen_id, Screen)
        size = (self._screen.width, self._screen.height)
        self._renderer = OpenCvRenderer(load_face(self.face), size)
        self._worker: Worker[Image | HriError] = context.clock.worker(RENDER_LATENCY)

    def compute(self, now: float, dt: float) -> None:
        for picture in self._worker.poll():
            if isinstance(picture, HriError):
                self._refuse(str(picture))
            else:
                self._screen.show(picture, now)
                self.frames += 1
        weights = self.weights.value
        if weights is not None and not self._worker.is_busy:
            text = (self.caption.value or "") if self.captions_on else ""
            self._worker.submit(partial(self._draw, weights, text))

    def stop(self) -> None:
        self._worker.close()

    def _draw(self, weights: FaceWeights, text: str) -> Image | HriError:
        from hri.face.renderers.captions import add_caption

        try:
            picture = self._renderer.render(self._renderer.model.vector(weights.values))
        except HriError as error:
            return error
        return add_caption(picture, text)

    def _refuse(self, reason: str) -> None:
        """Weights that cannot be drawn leave the picture as it was; they are told about once."""
        if reason != self._refused:
            self._refused = reason
            self._events.raise_event("face.refused", reason=reason)
