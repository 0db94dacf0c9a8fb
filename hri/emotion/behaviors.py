"""Feelings in a network: stimuli in, the state out, and what the state shows."""

from __future__ import annotations

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.events import EventBus, Subscription
from hri.core.signals import EmotionState, Event, Expression, Prosody, Stimulus
from hri.emotion.display import felt_now, load_display
from hri.emotion.dynamics import Affect
from hri.emotion.model import load_emotions
from hri.emotion.personality import load_personality

_NOTABLE = 0.1
"""A change of valence worth an event when the label stays the same."""
_INTERVAL_S = 1.0
"""Seconds between two such events."""


class EmotionModel(Behavior):
    """What the robot feels: moved by stimuli, colored by a personality."""

    category = "emotion"

    personality = Param("neutral", "name of a file in emotions/personalities, or a path")
    stimulus = Input[Stimulus](
        "stimulus", "felt at every tick in which it is sent", is_optional=True
    )
    state = Output[EmotionState]("emotion", "what is felt now")

    def check(self) -> None:
        load_emotions(self.personality)

    def start(self, context: Context) -> None:
        """Load the emotions and listen to `stimulus.felt`, with `stimulus` and `intensity` (1)."""
        self._clock = context.clock
        self._model = load_emotions(self.personality)
        self._dynamics = self._model.dynamics()
        self._affect = self._dynamics.rest(context.clock.now())
        self._announcer = Announcer(context.events)
        self._subscription: Subscription = context.events.subscribe("stimulus.felt", self._on_felt)

    def compute(self, now: float, dt: float) -> None:
        for stimulus in self.stimulus.values:
            self.feel(stimulus.name, stimulus.intensity)
        self._affect = self._dynamics.advance(self._affect, now)
        state = self._dynamics.read(self._affect)
        self._announcer.announce(state, now)
        self.state.send(state)

    def stop(self) -> None:
        self._subscription.cancel()

    def feel(self, name: str, intensity: float = 1.0) -> None:
        """Something happened just now.

        Raises HriError for an unknown stimulus, ValueError for an intensity outside 0 to 1.
        """
        now = self._clock.now()
        self._affect = self._dynamics.feel(self._affect, name, intensity, now)

    def feeling(self) -> EmotionState:
        """What is felt now."""
        return self._dynamics.read(self._current())

    def feeling_words(self) -> str:
        """What the robot is, after "I am": "happy"."""
        return self._model.words(self.feeling().label)

    def why(self) -> list[tuple[str, float]]:
        """The causes of what is felt with their shares, the largest first; see Dynamics.why."""
        return self._dynamics.why(self._current())

    def why_words(self) -> str:
        """The same as a sentence: "I am sad because you scolded me."."""
        return self._model.why_words(self._dynamics, self._current())

    def _current(self) -> Affect:
        return self._dynamics.advance(self._affect, self._clock.now())

    def _on_felt(self, event: Event) -> None:
        properties = event.properties
        self.feel(str(properties.get("stimulus", "")), float(properties.get("intensity", 1.0)))


class Announcer:
    """Raises `emotion.changed` when the label changes, or when the valence has moved."""

    def __init__(self, events: EventBus) -> None:
        self._events = events
        self._label = ""
        self._valence = 0.0
        self._time = 0.0

    def announce(self, state: EmotionState, now: float) -> None:
        moved = abs(state.valence - self._valence) > _NOTABLE and now - self._time >= _INTERVAL_S
        if state.label == self._label and not moved:
            return
        self._label, self._valence, self._time = state.label, state.valence, now
        self._events.raise_event(
            "emotion.changed",
            label=state.label,
            valence=round(state.valence, 4),
            arousal=round(state.arousal, 4),
            dominance=round(state.dominance, 4),
        )


class EmotionDisplay(Behavior):
    """What a feeling shows: the face's expression, how the voice sounds, how fast it drives."""

    category = "emotion"

    personality = Param("neutral", "whose expressiveness to use; the same as the EmotionModel's")
    state = Input[EmotionState]("emotion", "what is felt")
    override = Input[Expression]("expression", "shown instead, as long as it is sent")
    expression = Output[Expression]("expression", "for the face")
    prosody = Output[Prosody]("prosody", "for the voice")
    speed = Output[float]("double", "factor on the driving speed, 0.6 to 1.2")
    arousal = Output[float]("double", "-1 (sleepy) to 1 (excited), for idle motion")

    def check(self) -> None:
        load_display()
        load_personality(self.personality)

    def start(self, context: Context) -> None:
        self._display = load_display()
        self._expressiveness = load_personality(self.personality).expressiveness

    def compute(self, now: float, dt: float) -> None:
        override = self.override.value
        if override is not None:
            self.expression.send(override)
        state = self.state.value
        if state is None:
            return
        if override is None:
            self.expression.send(self._display.expression(state, self._expressiveness))
        felt = felt_now(state)
        self.prosody.send(self._display.prosody(felt))
        self.speed.send(self._display.speed.factor(felt))
        self.arousal.send(float(felt[1]))
