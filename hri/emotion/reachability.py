"""What may be wrong with emotion files that load: unmet expectations, and what never happens."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping

from hri.core.errors import AuthoringError, HriError, did_you_mean
from hri.emotion.appraisal import SELF, ActionEvent, GoalEvent, ObjectEvent, OccEvent, appraise
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import NAMES
from hri.emotion.expectation import Expectation
from hri.emotion.personality import load_personality
from hri.emotion.stimulus import StimulusSpec


def unmet_expectations(stimuli: Mapping[str, StimulusSpec]) -> Iterator[AuthoringError]:
    """What the stimuli expect of themselves and do not keep, with the place of the expectation."""
    tempers: dict[str, Dynamics] = {}
    for spec in stimuli.values():
        for expectation in spec.expects:
            try:
                name = expectation.personality
                if name not in tempers:
                    tempers[name] = Dynamics(load_personality(name), list(stimuli.values()))
            except HriError as error:
                what, _, remedy = str(error).partition(" - ")
                yield AuthoringError(expectation.place, what, remedy)
                continue
            yield from _unmet(spec.name, expectation, tempers[name])


def _unmet(stimulus: str, expectation: Expectation, dynamics: Dynamics) -> Iterator[AuthoringError]:
    affect, now = dynamics.rest(), 0.0
    for count in range(expectation.times):
        now = count * expectation.every_s
        affect = dynamics.feel(affect, stimulus, expectation.intensity, now)
    affect = dynamics.advance(affect, now + expectation.after_s)
    for failure in expectation.failures(dynamics.read(affect)):
        what = f"{stimulus}, {expectation.personality}, after {expectation.after_s:g} s: {failure}"
        yield AuthoringError(expectation.place, what, "change the stimulus, or what is expected")


def unreachable_emotions(stimuli: Mapping[str, StimulusSpec]) -> list[str]:
    """Emotions that no stimulus causes and that no goal, deed or thing can cause either."""
    caused = {name for spec in stimuli.values() for name, weight in spec.emotions.items() if weight}
    caused |= {name for event in _events() for name in appraise(event).charges}
    return [name for name in NAMES if name not in caused]


def _events() -> Iterator[OccEvent]:
    """An event of each distinguishable kind."""
    good_or_bad, people = (1.0, -1.0), (None, SELF, "someone")
    before_and_after = itertools.product((0.25, 0.75), (0.0, 0.5, 1.0))
    for (before, after), utility, liking, owner, agent in itertools.product(
        before_and_after, good_or_bad, good_or_bad, (None, "someone"), people
    ):
        yield GoalEvent("x", utility, after, before, owner=owner, liking=liking, agent=agent)
    for value in good_or_bad:
        yield ActionEvent("x", value)
        yield ActionEvent("x", value, "someone")
        yield ObjectEvent("x", value)


def unreachable_stimuli(
    stimuli: Mapping[str, StimulusSpec], mentioned: Collection[str], behaviors: Collection[str]
) -> Iterator[str]:
    """Stimuli that can never be felt, or to no effect, a sentence each.

    `mentioned` are the names that programs mention in quotes, those of events among them;
    `behaviors` are the ids of behaviors in networks.
    """
    for spec in stimuli.values():
        behavior = spec.trigger.rpartition(".")[0].rpartition(".")[2]
        if spec.trigger and spec.trigger not in mentioned and behavior not in behaviors:
            near = did_you_mean(spec.trigger, mentioned, "raise it, or name another event or port")
            yield f'{spec.name}: nothing raises "{spec.trigger}" - {near}'
        if spec.held is not None and spec.held.ended_by and spec.held.ended_by not in mentioned:
            near = did_you_mean(spec.held.ended_by, mentioned, "raise it, or name another event")
            yield f'{spec.name}: nothing raises "{spec.held.ended_by}", which ends it - {near}'
        if not spec.formula.fields and spec.intensity({}) == 0.0:
            yield f"{spec.name}: its intensity is 0 - write more"
        if not (any(spec.charges()) or spec.satisfies or spec.relation):
            yield f"{spec.name}: it moves nothing - give it emotions"


def felt_by_name(stimuli: Mapping[str, StimulusSpec], mentioned: Collection[str]) -> list[str]:
    """Stimuli without a trigger that no app mentions: others may feel them by name."""
    return [
        spec.name for spec in stimuli.values() if not spec.trigger and spec.name not in mentioned
    ]
