"""A story as a film: the face that the robot makes at each event, and its answer to "why?"."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from hri.core.errors import HriError
from hri.core.signals import Prosody, Speech
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.explanation import explained
from hri.emotion.model_spec import EmotionModelSpec
from hri.emotion.story import Expected, Felt, Moment
from hri.face.scene import ENDING, LONGEST, Cue, Scene

LOOKS_S = 2.0
"""Seconds for which the face is seen before it answers."""
RISES = 3.0
"""Times the rise of a state after which it is fully felt."""
STEP_S = 0.25
"""Seconds between two looks at the feelings."""

Voice = Callable[[str, Prosody], Speech]
"""Synthesizes a text."""


def scene_of_story(model: EmotionModelSpec, moments: Sequence[Moment], voice: Voice) -> Scene:
    """The events of a story right after each other; the time between them is left out.

    Raises HriError for a film of more than LONGEST seconds.
    """
    dynamics = model.dynamics()
    events = [moment for moment in moments if not isinstance(moment.line.what, Expected)]
    cues: list[Cue] = []
    at = 0.0
    for number, moment in enumerate(events):
        later = events[number + 1].line.time if number + 1 < len(events) else math.inf
        answers = moment.line.time + min(_settles(model, moment), later - moment.line.time)
        affect = dynamics.advance(moment.affect, answers)
        prosody = model.display.prosody(dynamics.read(affect))
        speech = voice(
            explained(model, dynamics, affect), replace(prosody, voice=model.personality.voice)
        )
        end = at + LOOKS_S + speech.duration + ENDING
        begins = max(answers - LOOKS_S, moment.line.time)
        cues += _looks(model, dynamics, dynamics.advance(moment.affect, begins), at, end)
        cues.append(Cue(at + LOOKS_S, speech=speech))
        at = end
        if at > LONGEST:
            raise HriError(f"the film is longer than {LONGEST:g} s - make a shorter story")
    return Scene(tuple(sorted(cues, key=lambda cue: cue.at)), at)


def _settles(model: EmotionModelSpec, moment: Moment) -> float:
    """Seconds after which an event is fully felt: at once, but for a state that begins."""
    match moment.line.what:
        case Felt(stimulus=name, intensity=intensity) if intensity:
            held = model.stimuli[name].held
            return LOOKS_S if held is None else max(LOOKS_S, RISES * held.rise_s)
    return LOOKS_S


def _looks(
    model: EmotionModelSpec, dynamics: Dynamics, affect: Affect, begin: float, end: float
) -> Iterator[Cue]:
    """The face from one time of the film to another, as the feelings fade from then on."""
    for step in range(int((end - begin) / STEP_S)):
        passed = step * STEP_S
        state = dynamics.read(dynamics.advance(affect, affect.time + passed))
        expression = model.display.expression(state, model.personality.expressiveness)
        mood = (expression.valence or 0.0, expression.arousal or 0.0)
        yield Cue(begin + passed, expression=expression, mood=mood)
