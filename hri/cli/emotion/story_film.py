"""A story as a film: the face that the robot makes at each event, and its answer to "why?"."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from hri.core.errors import HriError
from hri.core.signals import Prosody, Speech
from hri.emotion.display import felt_now
from hri.emotion.model_spec import EmotionModelSpec
from hri.emotion.story import Expected, Moment
from hri.face.scene import ENDING, LONGEST, Cue, Scene

LOOKS_S = 2.0
"""Seconds for which the face is seen before it answers."""
STEP_S = 0.25
"""Seconds between two looks at the feelings."""

Voice = Callable[[str, Prosody], Speech]
"""Synthesizes a text."""


def scene_of_story(model: EmotionModelSpec, moments: Sequence[Moment], voice: Voice) -> Scene:
    """The events of a story right after each other; what comes between them is left out.

    Raises HriError for a story that gives more than LONGEST seconds.
    """
    cues: list[Cue] = []
    at = 0.0
    for moment in moments:
        if isinstance(moment.line.what, Expected):
            continue
        prosody = replace(
            model.display.prosody(felt_now(moment.state)), voice=model.personality.voice
        )
        speech = voice(moment.because, prosody)
        end = at + LOOKS_S + speech.duration + ENDING
        cues += _looks(model, moment, at, end)
        cues.append(Cue(at + LOOKS_S, speech=speech))
        at = end
        if at > LONGEST:
            raise HriError(f"the film is longer than {LONGEST:g} s - make a shorter story")
    return Scene(tuple(sorted(cues, key=lambda cue: cue.at)), at)


def _looks(model: EmotionModelSpec, moment: Moment, begin: float, end: float) -> Iterator[Cue]:
    """The face from one time to another, as the feelings fade after an event."""
    dynamics = model.dynamics()
    for step in range(int((end - begin) / STEP_S)):
        passed = step * STEP_S
        state = dynamics.read(dynamics.advance(moment.affect, moment.affect.time + passed))
        expression = model.display.expression(state, model.personality.expressiveness)
        mood = (expression.valence or 0.0, expression.arousal or 0.0)
        yield Cue(begin + passed, expression=expression, mood=mood)
