"""The face in a network: feelings, speech and gaze become weights, and those a picture."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeVar

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.event_bus import EventBus, Subscription
from hri.core.signals import Event, Expression, FaceWeights, Gaze, Image, Speech
from hri.face.animator import Animator
from hri.face.drawing.baking import Vector
from hri.face.lips.lip_player import PICTURE_LEAD
from hri.face.live_link import WeightWriter, read_weights
from hri.face.model import FaceModel, load_face
from hri.face.motion import idle
from hri.face.motion.gesture_player import Playing
from hri.face.motion.gesture_tracks import load_gestures
from hri.hal.screen import Screen

T = TypeVar("T")

Mood = tuple[float | None, float | None]
"""Arousal and valence that came in; None for what did not."""

RENDER_LATENCY = 0.02
"""Seconds that a picture takes on the fake clock: less than a tick at 30 Hz."""


class Refusals:
    """Reports impossible requests to a face by the event `face.refused`, once per reason."""

    def __init__(self, events: EventBus) -> None:
        self._events = events
        self._told = ""

    def tell(self, reason: str) -> None:
        if reason != self._told:
            self._told = reason
            self._events.raise_event("face.refused", reason=reason)


class Face(Behavior):
    """Animates a face: mood, expression, lips, blinks, gaze and gestures become weights.

    Impossible requests, such as an unknown expression, raise the event `face.refused`; the face
    stays as it was. Raises `face.changed`, `gesture.started` and `gesture.ended`, and makes the
    gesture of an event `gesture.asked` (`name`, `strength`, `seconds`).
    """

    category = "face"

    may_do = NOTHING
    face = Param("robot", "name of a folder in faces/, or a path")
    latency = Param(
        PICTURE_LEAD, "seconds until weights are seen on the screen", minimum=0, maximum=1
    )
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
    valence = Input[float](
        "double", "-1 to 1: with it, valence and arousal are a mood that shows", is_optional=True
    )
    state = Input[str](
        "string", f"what it does: {', '.join(idle.STATES)}; else as it looks", is_optional=True
    )
    is_listening = Input[bool](
        "boolean", "whether someone speaks to it: then it listens", is_optional=True
    )
    gesture = Input[str](
        "string", "makes this gesture, whenever another name comes or the first", is_optional=True
    )
    override = Input[FaceWeights](
        "weights", "win over all else, as long as they are sent", is_optional=True
    )
    weights = Output[FaceWeights]("weights", "weights of all channels that are not at rest")
    caption = Output[str]("string", "the sentence that is being said")

    def check(self) -> None:
        load_gestures(load_face(self.face))

    def start(self, context: Context) -> None:
        """Raises HriError when the face or its gestures cannot be read."""
        self._seed = context.seed_for("face")
        self._events = context.events
        self._refusals = Refusals(context.events)
        self._speech: Speech | None = None
        self._gesture: str | None = None
        self._playing: Playing | None = None
        self._animate(load_face(self.face))
        self._subscription: Subscription = context.events.subscribe("gesture.asked", self._on_asked)

    def _animate(self, model: FaceModel) -> None:
        self._animator = Animator(model, self._seed, self.latency)
        self._expression = Expression()
        self._mood: Mood = None, None

    def compute(self, now: float, dt: float) -> None:
        animator = self._animator
        expression = self.expression.value
        if expression is not None and expression != self._expression:
            self._expression = expression
            self._ask(animator.express, expression)
        self._ask(animator.look, self.gaze.value or Gaze())
        mood = self.arousal.value, self.valence.value
        if mood != self._mood:
            self._mood = mood
            self._ask(self._feel, mood)
        self._ask(animator.override, (self.override.value or FaceWeights()).values)
        if self.gesture.value != self._gesture:
            self._gesture = self.gesture.value
            if self._gesture:
                self._ask(self.make, self._gesture)
        speech = self._current_speech()
        animator.speak(speech)
        listening = "listening" if self.is_listening.value and speech is None else ""
        self._ask(animator.be, self.state.value or listening)
        self.weights.send(animator.step(now, dt, self.position.value))
        self._tell_end()
        if speech is not None:
            self.caption.send(speech.caption(self.position.value or 0.0))

    def stop(self) -> None:
        self._subscription.cancel()

    def change(self, name: str, model: FaceModel) -> None:
        """Be another face from the next tick on; a gesture that is being made ends.

        Raises HriError for gestures that cannot be read; the face stays as it was.
        """
        self._animate(model)
        if self._playing is not None:
            self._playing.cancel()
            self._tell_end()
        self.set_parameter("face", name)
        self._events.raise_event("face.changed", face=name)

    def make(self, gesture: str, strength: float = 1.0, seconds: float = 0.0) -> Playing:
        """Make a gesture from the next tick on, instead of one that is being made.

        `strength` is 0 to 1.5; `seconds` 0 is its own duration. Raises HriError for an unknown one.
        """
        return self._begin(self._animator.gesture(gesture, strength, seconds))

    def replay(self, path: Path | str) -> Playing:
        """Play recorded weights, instead of all else; see `hri.face.live_link`.

        Raises AuthoringError or HriError for a file that cannot be used.
        """
        track = read_weights(Path(path), self._animator.model)
        return self._begin(self._animator.play(track, name=Path(path).name))

    def _begin(self, playing: Playing) -> Playing:
        self._tell_end()
        self._playing = playing
        self._events.raise_event("gesture.started", name=playing.name)
        return playing

    def _tell_end(self) -> None:
        if self._playing is not None and self._playing.is_over:
            self._events.raise_event("gesture.ended", name=self._playing.name)
            self._playing = None

    def _on_asked(self, event: Event) -> None:
        properties = event.properties
        try:
            numbers = (
                float(properties.get(name, d)) for name, d in (("strength", 1), ("seconds", 0))
            )
            self.make(str(properties.get("name", "")), *numbers)
        except (HriError, TypeError, ValueError) as error:
            self._refusals.tell(str(error))

    def _feel(self, mood: Mood) -> None:
        arousal, valence = mood
        self._animator.feel(arousal or 0.0, valence)

    def _ask(self, request: Callable[[T], object], value: T) -> None:
        try:
            request(value)
        except HriError as error:
            self._refusals.tell(str(error))

    def _current_speech(self) -> Speech | None:
        """The speech that plays: it may be sent at every tick or only at the first."""
        if self.speech.value is not None:
            self._speech = self.speech.value
        is_heard = self.is_speaking.value
        if is_heard is None:
            is_heard = self.position.value is not None
        return self._speech if is_heard else None


class FaceRecorder(Behavior):
    """Records weights of a face to a CSV file with the columns of Live Link Face."""

    category = "face"

    may_do = NOTHING
    face = Param("robot", "name of a folder in faces/, or a path")
    file = Param("face.csv", "file to write; an existing one is overwritten")
    weights = Input[FaceWeights]("weights", "what to record")

    def check(self) -> None:
        load_face(self.face)

    def start(self, context: Context) -> None:
        """Raises HriError when the file cannot be written."""
        self._model = load_face(self.face)
        self._refusals = Refusals(context.events)
        self._writer = WeightWriter(Path(self.file), self._model)

    def compute(self, now: float, dt: float) -> None:
        if self.weights.value is None:
            return
        try:
            vector = self._model.vector(self.weights.value.values)
        except HriError as error:
            self._refusals.tell(str(error))
            return
        self._writer.write(now, vector)

    def stop(self) -> None:
        self._writer.close()


class Brush(NamedTuple):
    """A face as a screen has it."""

    model: FaceModel
    render: Callable[[Vector], Image]


class FaceRenderer(Behavior):
    """Draws the newest weights and shows them on a screen, one picture a tick at most."""

    category = "face"

    may_do = NOTHING
    screen_id = Param("screen", "id of the screen")
    face = Param("robot", "name of a folder in faces/, or a path")
    captions = Param(False, "show captions below the face")
    weights = Input[FaceWeights]("weights", "what to draw")
    caption = Input[str]("string", "what to write, when captions are on", is_optional=True)
    is_watching = Input[bool](
        "boolean", "true while a camera watches: lights a lamp in the corner", is_optional=True
    )

    captions_on = False
    """Whether captions are written; may be switched at any time."""
    frames = 0
    """Pictures shown."""

    def check(self) -> None:
        load_face(self.face)

    def start(self, context: Context) -> None:
        """Raises HriError when the face cannot be read or the screen is too large or small."""
        from hri.face.renderers.painter import load_compiler

        load_compiler()
        self.captions_on = self.captions
        self.frames = 0
        self._refusals = Refusals(context.events)
        self._screen = context.resources.obtain(self.screen_id, Screen)
        self._brush = self.brush_of(load_face(self.face))
        self._worker: Worker[Image | HriError] = context.clock.worker(RENDER_LATENCY)

    def brush_of(self, model: FaceModel) -> Brush:
        """What draws a face on this screen; takes a second or two, and may be made in any thread.

        Raises HriError for a screen that is too large or small.
        """
        from hri.face.renderers.bits import BitRenderer
        from hri.face.renderers.renderer import Renderer

        size = (self._screen.width, self._screen.height)
        is_one_bit = self._screen.is_one_bit
        render = BitRenderer(model, size).picture if is_one_bit else Renderer(model, size).render
        return Brush(model, render)

    def change(self, name: str, brush: Brush) -> None:
        """Draw another face from the next picture on."""
        self._brush = brush
        self.set_parameter("face", name)

    def compute(self, now: float, dt: float) -> None:
        for picture in self._worker.poll():
            if isinstance(picture, HriError):
                self._refusals.tell(str(picture))
            else:
                self._screen.show(picture, now)
                self.frames += 1
        weights = self.weights.value
        if weights is not None and self._screen.is_seen and not self._worker.is_busy:
            text = (self.caption.value or "") if self.captions_on else ""
            is_watching = any(self.is_watching.values)
            self._worker.submit(partial(_drawn, self._brush, weights, text, is_watching))

    def stop(self) -> None:
        self._worker.close()


def _drawn(brush: Brush, weights: FaceWeights, text: str, is_watching: bool) -> Image | HriError:
    from hri.face.renderers.captions import add_caption
    from hri.face.renderers.lamp import add_lamp

    try:
        picture = brush.render(brush.model.vector(weights.values))
    except HriError as error:
        return error
    return add_caption(add_lamp(picture) if is_watching else picture, text)
