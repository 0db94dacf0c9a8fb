"""Random lives: streams of events for the property tests, and how to play them."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

from hri.emotion.affect import Affect
from hri.emotion.appraisal import SELF, ActionEvent, GoalEvent, ObjectEvent, OccEvent
from hri.emotion.drives import DRIVES
from hri.emotion.dynamics import Dynamics
from hri.emotion.personality import load_personality
from hri.emotion.stimulus import StimulusSpec

STIMULI = (
    StimulusSpec("praise", "you praised me", {"joy": 0.65, "pride": 0.4}, 0.25, 60, relation=0.05),
    StimulusSpec("scold", "you scolded me", {"sadness": 0.7, "shame": 0.4, "anger": 0.25}, 0.2, 60),
    StimulusSpec("bump", "I bumped", {"surprise": 0.75, "fear": 0.45, "anger": 0.4}, 0.15, 60),
    StimulusSpec("petted", "you petted me", {"love": 0.5}, 0.3, 30, satisfies={"company": 0.4}),
    StimulusSpec("insulted", "you were rude", {"anger": 0.55, "disgust": 0.35}, relation=-0.2),
    StimulusSpec("played", "we played", {"joy": 0.3}, 0.5, satisfies={"play": 1.0, "rest": 0.1}),
)
"""A set of their own, so that the files may change."""
NAMES = [stimulus.name for stimulus in STIMULI]
DYNAMICS = {
    name: Dynamics(load_personality(name), STIMULI)
    for name in ("neutral", "optimist", "pessimist", "shy", "hot_tempered", "easy_going")
}
NEUTRAL = DYNAMICS["neutral"]


@dataclass(frozen=True)
class Felt:
    """A stimulus."""

    name: str
    intensity: float
    person: str | None


@dataclass(frozen=True)
class Reported:
    """A need that was measured."""

    drive: str
    level: float


Event = Felt | Reported | OccEvent
Stream = list[tuple[float, Event]]
"""Seconds since the one before, and what happens."""

people = st.sampled_from(["Anna", "Ben", None])
agents = st.sampled_from(["Anna", "Ben", SELF, None])
unit = st.floats(0, 1)
signed = st.floats(-1, 1)
felt = st.builds(Felt, st.sampled_from(NAMES), unit, people)
goals = st.builds(
    GoalEvent,
    goal=st.sampled_from(["charger", "game"]),
    utility=signed,
    likelihood_before=unit,
    likelihood_after=st.one_of(unit, st.sampled_from([0.0, 1.0])),
    owner=people,
    liking=st.one_of(st.none(), signed),
    agent=agents,
    praiseworthiness=st.one_of(st.none(), signed),
)
actions = st.builds(ActionEvent, st.just("deed"), signed, st.sampled_from(["Anna", SELF]))
objects = st.builds(ObjectEvent, st.sampled_from(["ball", "spider"]), signed)
impulses = st.one_of(felt, goals, actions, objects)
drives = st.sampled_from([drive.name for drive in DRIVES])
events = st.one_of(impulses, st.builds(Reported, drives, unit))
waits = st.floats(0, 120)
streams = st.lists(st.tuples(waits, events), min_size=1, max_size=12)
models = st.sampled_from(list(DYNAMICS.values()))


def happen(model: Dynamics, affect: Affect, event: Event, now: float) -> Affect:
    """The state after an event."""
    if isinstance(event, Felt):
        return model.feel(affect, event.name, event.intensity, now, event.person)
    if isinstance(event, Reported):
        return model.report(affect, event.drive, event.level, now)
    return model.appraise(affect, event, now)


def play(model: Dynamics, stream: Stream, until: float = 0.0) -> Affect:
    """The state `until` seconds after the last event."""
    affect = model.rest()
    for wait, event in stream:
        affect = happen(model, affect, event, affect.time + wait)
    return model.advance(affect, affect.time + until)


def numbers(model: Dynamics, affect: Affect) -> dict[str, float]:
    """Everything that a state says, by name."""
    state = model.read(affect)
    mood = {"pleasure": state.valence, "arousal": state.arousal, "dominance": state.dominance}
    return {**state.emotions, **state.drives, **mood, **model.relations(affect)}
