"""Feelings in a network: stimuli in, the state out, and what the state shows."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.errors import HriError
from hri.core.signals import EmotionState, Expression, Gaze, People, Prosody, Stimulus
from hri.emotion.acted_emotion import NOTHING_ACTED, whole_vector
from hri.emotion.affect import Affect
from hri.emotion.announcer import Announcer
from hri.emotion.appraisal import OccEvent, name_of, people_of
from hri.emotion.display import HONEST, felt_now, load_display
from hri.emotion.explanation import explained
from hri.emotion.expressive_motion import ExpressiveMotion
from hri.emotion.files import Reloading
from hri.emotion.keeper import Keeper
from hri.emotion.label import CALM
from hri.emotion.ledger import Cause
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import traces
from hri.emotion.personality import load_personality
from hri.emotion.relations import is_unnamed
from hri.emotion.triggers import Triggers

LOOK_EVERY_S = 1.0
"""Seconds between looks for ports to watch."""
BATTERY_STEP = 0.01
"""A change of the battery's level that counts, of 1."""

log = logging.getLogger("hri.emotion")


class EmotionModel(Behavior):
    """What the robot feels: moved by stimuli, colored by a personality.

    Raises `emotion.changed` (label, valence, arousal, dominance: the mood's) when the label changes
    or the valence has moved, `mood.changed` when the name of the mood changes, and `person.named`
    (person, name) when someone with a name first does something: it says who took part.
    """

    keeps_inputs = False
    category = "emotion"

    personality = Param("neutral", "name of a file in emotions/personalities, or a path")
    memory = Param("", "file that keeps mood, relations and drives between runs; empty: none")
    memory_after_yes = Param(
        "", "the same, but not before someone allows it: `begin_keeping`; empty: nobody is asked"
    )
    stimulus = Input[Stimulus](
        "stimulus", "felt at every tick in which it is sent", is_optional=True
    )
    battery = Input[float](
        "double", "how full it is, 0 to 1: the drive for energy", is_optional=True
    )
    people = Input[People](
        "people", "who is seen: what comes by the id of someone with a name is theirs",
        is_optional=True,
    )  # fmt: skip
    state = Output[EmotionState]("emotion", "current feelings")
    label = Output[str]("string", "the emotion that stands out, else the name of the mood")
    mood = Output[tuple[float, ...]]("doublearray", "pleasure, arousal, dominance, -1 to 1 each")

    def check(self) -> None:
        load_emotions(self.personality)

    def start(self, context: Context) -> None:
        """Load the emotions and listen to `stimulus.felt` and to what stimuli have as a trigger.

        `stimulus.felt` has a `stimulus`, and if need be an `intensity` (1) and a `person`.
        """
        self._context = context
        self._clock = context.clock
        self._people = People(context.clock.now())
        self._files = Reloading(self.personality, context.clock)
        self._dynamics = self._files.model.dynamics()
        self._looked = now = context.clock.now()
        # The state at the last event: the current feelings follow from it.
        self._affect = self._dynamics.rest(now)
        self._keeper: Keeper | None = None
        if self.memory:
            self._keeper = Keeper(paths.expanded(self.memory), self.personality, context)
            self._affect = self._keeper.recall(self._dynamics)
        self._announcer = Announcer(context.events)
        self._involved: set[str] = set()
        self._said_names: dict[str, str] = {}
        stimuli = self._files.model.stimuli.values()
        self._triggers = Triggers(stimuli, context, self.feel)

    def compute(self, now: float, dt: float) -> None:
        self._meet(self.people.value or self._people)
        for stimulus in self.stimulus.values:
            self._triggers.feel(stimulus.name, stimulus.intensity)
        self._feel_battery(now)
        state = self._dynamics.read(self._dynamics.advance(self._affect, now))
        self._announcer.announce(state, now)
        self.state.send(state)
        self.label.send(state.label)
        self.mood.send((state.valence, state.arousal, state.dominance))
        self._reload(now)
        if now - self._looked >= LOOK_EVERY_S:
            self._looked = now
            self._triggers.connect()
            if self._keeper is not None:
                self._affect = self._keeper.forgotten(self._dynamics) or self._affect
        if self._keeper is not None:
            self._keeper.keep(self._affect, now)

    def stop(self) -> None:
        self._triggers.close()
        self._files.close()
        if self._keeper is not None:
            self._keeper.close(self._affect)
            self._keeper = None

    @property
    def may_ask_to_keep(self) -> bool:
        """Whether someone may be asked to let it keep what it feels.

        Not when it is kept already, nor when feelings of an earlier run would be overwritten.
        """
        named = self.memory_after_yes
        return bool(named) and self._keeper is None and not traces(paths.expanded(named))

    def begin_keeping(self) -> None:
        """Save feelings from now on, since a person has allowed it. Raises `memory.begun`."""
        if self.may_ask_to_keep:
            path = paths.expanded(self.memory_after_yes)
            self._keeper = Keeper(path, self.personality, self._context)
            self._context.events.raise_event("memory.begun", file=str(path))

    def feel(self, name: str, intensity: float = 1.0, person: str | None = None) -> None:
        """Something happened just now, perhaps by a person: a name, or the id of one who is seen.

        A name is cut to 100 letters. Raises HriError for an unknown stimulus, ValueError for an
        intensity outside 0 to 1.
        """
        now, doer = self._clock.now(), self._name_of(person)
        self._affect = self._dynamics.feel(self._affect, name, intensity, now, doer)
        self._involve(person, doer)

    def know(self, names: Mapping[str, str]) -> None:
        """Who said their names, by the ids of who is seen: what they did and do is theirs.

        "" is the id of who is not seen. Whoever is left out is known by the id alone from now on.
        """
        if fresh := {id: name for id, name in names.items() if id and id not in self._said_names}:
            self._affect = self._dynamics.rename(self._current(), fresh)
        self._said_names = dict(names)

    def forget(self, name: str) -> None:
        """Feel nothing about someone any more; what they did has no author then."""
        self._said_names = {id: one for id, one in self._said_names.items() if one != name}
        self._affect = self._dynamics.rename(self._current(), {name: None})

    def appraise(self, event: OccEvent) -> None:
        """Something happened just now to a goal, by a deed, or with an object."""
        self._affect = self._dynamics.appraise(self._affect, event, self._clock.now())
        for person in people_of(event):
            self._involve(person, name_of(person))

    def feeling(self) -> EmotionState:
        """The current feelings."""
        return self._dynamics.read(self._current())

    def feeling_words(self) -> str:
        """What the robot is, after "I am": "happy"."""
        state = self.feeling()
        return self._files.model.words(state.label, state.intensity)

    def wear(self, name: str, person: str | None = None) -> float:
        """How much of a stimulus is lost because it came so often: 0 (nothing) to 1.

        Raises HriError for an unknown stimulus.
        """
        return self._dynamics.wear(self._current(), name, self._name_of(person))

    def why(self) -> tuple[Cause, ...]:
        """The causes of the feelings with their shares and ages, the largest first."""
        return self._dynamics.why(self._current())

    def why_words(self, about: str = "") -> str:
        """The same as a sentence: "I am sad because you scolded me.".

        `about` is the feeling in the question, such as "sad". People with names are named, except
        the attended person, who hears "you".
        """
        asking = self._name_of(self._people.attended)
        return explained(self._files.model, self._dynamics, self._current(), about, asking)

    def _meet(self, people: People) -> None:
        """Attribute feelings about a track id to a name, once it is known."""
        if people is self._people:
            return
        names = {
            person.id: name
            for person in people.persons
            if (name := name_of(person.name)) is not None
        }
        known = {person.id for person in self._people.persons if person.name}
        self._people = people
        if fresh := {id: name for id, name in names.items() if id not in known}:
            self._affect = self._dynamics.rename(self._affect, fresh)

    def _involve(self, person: str | None, name: str | None) -> None:
        """Report, once per run, that a person with a name takes part."""
        if name is not None and not is_unnamed(name) and name not in self._involved:
            self._involved.add(name)
            self._context.events.raise_event("person.named", person=person, name=name)

    def _name_of(self, person: str | None) -> str | None:
        """The name of someone who is seen, if it is known; else what they are called already."""
        seen = self._people.person(person) if person else None
        said = None if person is None else self._said_names.get(person)
        return name_of(said or (seen.name if seen is not None and seen.name else person))

    def _current(self) -> Affect:
        return self._dynamics.advance(self._affect, self._clock.now())

    def _feel_battery(self, now: float) -> None:
        """The battery runs down slowly: only what can be felt counts as something that happened."""
        level = self.battery.value
        if level is None or not math.isfinite(level):
            return
        need = min(max(1.0 - level, 0.0), 1.0)
        felt = self._dynamics.drives(self._affect)["energy"]
        if abs(need - felt) >= BATTERY_STEP:
            self._affect = self._dynamics.report(self._affect, "energy", need, now)

    def _reload(self, now: float) -> None:
        """Load saved files; a faulty one is reported, and the previous version stays."""
        try:
            if not self._files.look(now):
                return
        except HriError as error:
            log.error("%s", error)
            self._context.events.raise_event("emotions.refused", reason=str(error))
            return
        settled = self._dynamics.settle(self._current())
        self._dynamics = self._files.model.dynamics()
        self._affect = self._dynamics.resume(settled.imprint, now)
        self._triggers.close()
        stimuli = self._files.model.stimuli.values()
        self._triggers = Triggers(stimuli, self._context, self.feel, self._triggers.levels)
        self._context.events.raise_event("emotions.reloaded", personality=self.personality)


class EmotionDisplay(Behavior):
    """What a feeling shows: face, voice, eyes, how fast it drives; and feelings that are put on."""

    keeps_inputs = False
    category = "emotion"

    personality = Param("neutral", "whose expressiveness to use; the same as the EmotionModel's")
    rules = Param(
        HONEST, "display rules of emotions/display.toml; empty: feelings are shown as they are"
    )
    state = Input[EmotionState]("emotion", "feelings")
    override = Input[Expression]("expression", "shown instead, as long as it is sent")
    expression = Output[Expression]("expression", "for the face")
    prosody = Output[Prosody]("prosody", "for the voice")
    speed = Output[float]("double", "factor on the driving speed, 0.6 to 1.2")
    arousal = Output[float]("double", "-1 (sleepy) to 1 (excited), for idle motion")
    gaze = Output[Gaze]("gaze", "where the eyes rest when there is nothing to look at")

    def check(self) -> None:
        load_display().shown(_CALM, self.rules)
        load_personality(self.personality)

    def start(self, context: Context) -> None:
        self._clock = context.clock
        self._files = Reloading(self.personality, context.clock)
        self._model = self._files.model
        self._state = _CALM
        self._acting = NOTHING_ACTED

    def compute(self, now: float, dt: float) -> None:
        self._reload(now)
        display, personality = self._model.display, self._model.personality
        override = self.override.value
        if override is not None:
            self.expression.send(override)
        state = self.state.value
        if state is None:
            return
        self._state = display.shown(state, self.rules)
        shown = self._acting.shown(self._state, now)
        if override is None:
            self.expression.send(display.expression(shown, personality.expressiveness))
        felt = felt_now(shown)
        self.prosody.send(replace(display.prosody(shown), voice=personality.voice))
        self.speed.send(display.speed.value(felt))
        self.arousal.send(felt[1])
        self.gaze.send(display.eyes(felt))

    def stop(self) -> None:
        self._files.close()

    def _reload(self, now: float) -> None:
        """Load saved files; the EmotionModel reports their errors."""
        with suppress(HriError):
            if self._files.look(now):
                self._files.model.display.shown(_CALM, self.rules)  # they may have gone
                self._model = self._files.model

    def act(self, values: Mapping[str, float], duration: float) -> None:
        """Show these emotions, 0 to 1, for some seconds instead of the felt ones. Raises
        HriError.
        """
        self._acting = self._acting.set(values, duration, self._clock.now())

    def act_more(self, emotion: str, increment: float, duration: float) -> None:
        """Show an emotion more strongly than now by a value, -1 to 1, for some seconds. Raises
        HriError.
        """
        now = self._clock.now()
        self._acting = self._acting.raised(emotion, increment, self._state, duration, now)

    def act_all(self, values: Mapping[str, float] | Sequence[float], duration: float) -> None:
        """Show these and no other emotions for some seconds. Raises HriError."""
        self.act(whole_vector(values), duration)

    @property
    def shown(self) -> EmotionState:
        """What others get to see under its display rules."""
        return self._state

    @property
    def motion(self) -> ExpressiveMotion | None:
        """What the base does for the feeling that shows; None where that is not strong enough."""
        return self._model.display.motion(self._state, self._model.personality.expressiveness)

    @property
    def is_acting(self) -> bool:
        """Whether something is put on."""
        now = self._clock.now()
        return self._acting.ends(now) > now


_CALM = EmotionState(CALM, 0.0, 0.0, 0.0, 0.0)
"""The look before the first feeling."""
