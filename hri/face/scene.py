"""Scenes: what a face shows, says and looks at over time, as a script in a file or in code.

    [[step]]
    express = "happy"
    gaze = [0.4, 0.1]

    [[step]]
    at = 0.8
    say = "Hello! I am glad to see you."

    [[step]]
    wait = 0.3
    gesture = "nod"

Every step does one or more things. `at` is in seconds from the start. A step with `wait` comes that
many seconds after the step above it, or after its speech. A step with neither comes together with
the step above. What a step at 0 asks for is there from the first picture on; only speech and
gestures begin then.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.core.reading import parse_json, read_text
from hri.core.signals import Expression, Gaze, Phoneme, Samples, Speech
from hri.core.toml import Table, load_toml
from hri.face.animator import Animator
from hri.face.drawing.baking import Vector
from hri.face.lips.phonemes import Alphabet, mnemonics
from hri.face.live_link import read_weights
from hri.face.model import FaceModel
from hri.face.motion import idle
from hri.face.motion.gesture_tracks import (
    LONGEST as LONGEST_GESTURE,
    STRONGEST,
    Track,
    load_gestures,
)
from hri.hal.drivers.wav_file import load_sound

LONGEST = 600.0
"""Seconds of a scene."""
MOST_STEPS = 2000
MOST_LETTERS = 2000
MOST_PHONEMES = 50_000
ENDING = 1.0
"""Seconds that a scene goes on after its last step when nothing is said of it."""

SETTLING = 3.0
"""Seconds before the first picture in which the face gets to where it begins."""

TIMES = ("at", "wait")
KEYS = (
    *TIMES, "express", "intensity", "duration", "say", "sound", "phonemes", "gaze", "look_at",
    "gesture", "play", "strength", "seconds", "state", "valence", "arousal", "weights",
)  # fmt: skip
"""What a step may say."""

Voice = Callable[[str], Speech]
"""Synthesizes a text."""


@dataclass(frozen=True, slots=True)
class Cue:
    """The changes at one time; None leaves a field as it was."""

    at: float
    """Seconds."""
    expression: Expression | None = None
    speech: Speech | None = None
    gaze: Gaze | None = None
    gesture: tuple[str, float, float] | None = None
    """Name, strength, and seconds, 0 for its own."""
    recording: tuple[Track, float, float] | None = None
    """Weights over time, likewise."""
    state: str | None = None
    mood: tuple[float, float] | None = None
    """Valence and arousal."""
    weights: Mapping[str, float] | None = None
    """Override by target; none at all ends it."""

    @property
    def begin(self) -> float:
        """Seconds: what the face looks like at 0 is there by then, unless it is to pass."""
        passes = self.expression is not None and self.expression.duration is not None
        is_look = not (self.speech or self.gesture or self.recording or passes)
        return -SETTLING if self.at <= 0 and is_look else self.at

    @property
    def end(self) -> float:
        """Seconds: when what it says has been said."""
        return self.at + (self.speech.duration if self.speech is not None else 0.0)

    def give(self, animator: Animator) -> None:
        """Ask it of a face; speech is for who knows how much of it has been heard."""
        if self.expression is not None:
            animator.express(self.expression)
        if self.mood is not None:
            valence, arousal = self.mood
            animator.feel(arousal, valence)
        if self.state is not None:
            animator.be(self.state)
        if self.gaze is not None:
            animator.look(self.gaze)
        if self.gesture is not None:
            animator.gesture(*self.gesture)
        if self.recording is not None:
            animator.play(*self.recording)
        if self.weights is not None:
            animator.override(self.weights)


@dataclass(frozen=True, slots=True)
class Moment:
    """One picture of a scene."""

    time: float
    """Seconds."""
    vector: Vector = field(repr=False)
    """Weights of all channels."""
    caption: str
    """What is being said."""


@dataclass(frozen=True)
class Scene:
    """Cues by their time."""

    cues: tuple[Cue, ...]
    duration: float
    """Seconds."""

    def moments(self, model: FaceModel, rate: float, seed: int = 0) -> Iterator[Moment]:
        """What the face does, `rate` times a second. The same arguments give the same weights."""
        # A picture is seen for 1 / rate seconds from its time: lips are right in the middle.
        animator = Animator(model, seed, latency=0.5 / rate)
        waiting = sorted(self.cues, key=lambda cue: cue.begin)
        talk: Cue | None = None
        for number in range(-math.ceil(SETTLING * rate), round(self.duration * rate)):
            now = number / rate
            while waiting and waiting[0].begin <= now + 1e-9:
                cue = waiting.pop(0)
                cue.give(animator)
                talk = cue if cue.speech is not None else talk
            speech = talk.speech if talk is not None and now < talk.end else None
            animator.speak(speech)
            position = None if speech is None or talk is None else now - talk.at
            vector = animator.vector(now, 1 / rate, position)
            if number >= 0:
                yield Moment(now, vector, "" if speech is None else speech.caption(position or 0.0))

    def sound(self) -> tuple[Samples, int] | None:
        """All that is said, at its times, and samples a second; None for a silent scene.

        Raises HriError for voices of different rates.
        """
        said = [(cue.at, cue.speech) for cue in self.cues if cue.speech is not None]
        rates = {speech.rate for _, speech in said}
        if not said:
            return None
        if len(rates) > 1:
            listed = " and ".join(f"{rate} Hz" for rate in sorted(rates))
            raise HriError(f"sounds of {listed} in one scene - bring all files to one rate")
        rate = rates.pop()
        mixed = np.zeros(round(self.duration * rate), np.int16)
        for at, speech in said:
            heard = speech.samples[: max(len(mixed) - round(at * rate), 0)]
            mixed[round(at * rate) : round(at * rate) + len(heard)] = heard
        return mixed, rate


def load_scene(path: Path, model: FaceModel, voice: Voice) -> Scene:
    """A scene for a face; `voice` speaks its texts. Raises AuthoringError with the place."""
    table = load_toml(path, "scene")
    steps = table.array("step")
    if not steps:
        raise table.error(None, "nothing happens in this scene", "add [[step]] with what it does")
    if len(steps) > MOST_STEPS:
        raise table.error("step", f"{len(steps)} steps", f"keep to {MOST_STEPS}")
    cues: list[Cue] = []
    for step in steps:
        cues.append(_cue(step, _time(step, cues), model, voice))
        step.finish()
        if cues[-1].end > LONGEST:
            what = f"this ends {cues[-1].end:.0f} s after the start"
            raise step.error(None, what, f"keep to {LONGEST:g} s")
    ending = max(cue.end for cue in cues) + ENDING
    duration = table.number("duration", ending, minimum=0.05, maximum=LONGEST)
    table.finish()
    cues.sort(key=lambda cue: cue.at)
    _check_turns(table, cues)
    return Scene(tuple(cues), duration)


def _check_turns(table: Table, cues: Sequence[Cue]) -> None:
    """Nobody says two things at once."""
    said = [cue for cue in cues if cue.speech is not None]
    for one, other in pairwise(said):
        if other.at < one.end - 1e-6:
            what = f"two things are said at {other.at:.2f} s, one of them until {one.end:.2f} s"
            raise table.error("step", what, "give the later one a wait instead of at")


def _time(step: Table, cues: Sequence[Cue]) -> float:
    """When a step comes."""
    if "at" in step and "wait" in step:
        raise step.error("wait", "both at and wait", "write one of them")
    before = cues[-1] if cues else Cue(0.0)
    if "wait" in step:
        return before.end + step.number("wait", minimum=0, maximum=LONGEST)
    return step.number("at", before.at, minimum=0, maximum=LONGEST)


def _cue(step: Table, at: float, model: FaceModel, voice: Voice) -> Cue:
    for key in step.data:
        if key not in KEYS:
            raise step.error(key, f'unknown key "{key}"', did_you_mean(key, KEYS))
    if set(step.data) <= set(TIMES):
        raise step.error(None, "this step does nothing", 'add such as express = "happy"')
    return Cue(
        at,
        expression=_expression(step, model),
        speech=_speech(step, voice),
        gaze=_gaze(step),
        gesture=_gesture(step, model),
        recording=_recording(step, model),
        state=_state(step),
        mood=_mood(step),
        weights=_weights(step, model),
    )


def _expression(step: Table, model: FaceModel) -> Expression | None:
    if "express" not in step:
        return None
    return Expression(
        step.string("express", among=sorted(model.expressions)),
        step.number("intensity", 1.0, minimum=0, maximum=1),
        step.number("duration", None, minimum=0, maximum=LONGEST),
    )


def _speech(step: Table, voice: Voice) -> Speech | None:
    if "sound" in step:
        return _recorded(step)
    if "say" not in step:
        return None
    text = step.string("say")
    if not 0 < len(text.strip()) <= MOST_LETTERS:
        raise step.error("say", f"{len(text)} letters", f"write 1 to {MOST_LETTERS}")
    return voice(text)


def _recorded(step: Table) -> Speech:
    """A sound file, with the phoneme times beside it, if any."""
    text = step.string("say", "")
    file = step.path.parent / step.string("sound")
    try:
        samples, rate = load_sound(file)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise step.error("sound", what, remedy or "check the file") from error
    phonemes = _phonemes(step) if "phonemes" in step else ()
    return Speech(text, samples, rate, phonemes)


def _phonemes(step: Table) -> tuple[Phoneme, ...]:
    """Times as `hri say --phonemes` writes them."""
    text = read_text(step.path.parent / step.string("phonemes"), "file of phoneme times")
    try:
        times: Any = parse_json(text)
        if not 0 < len(rows := times["phonemes"]) <= MOST_PHONEMES:
            raise ValueError("too many, or none")
        named = times.get("alphabet")
        names = mnemonics([str(row["name"]) for row in rows], Alphabet(named) if named else None)
        return tuple(map(_phoneme, rows, names))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        what = f"{step.string('phonemes')} holds no phoneme times"
        raise step.error("phonemes", what, "write it by `hri say --phonemes`") from error


def _phoneme(row: Mapping[str, Any], name: str) -> Phoneme:
    start, duration = float(row["start"]), float(row["duration"])
    if not (0 <= start <= LONGEST and 0 <= duration <= LONGEST):
        raise ValueError("out of range")
    return Phoneme(name, start, duration, bool(row.get("stressed", False)))


def _gaze(step: Table) -> Gaze | None:
    if "look_at" in step:
        if "gaze" in step:
            raise step.error("gaze", "both gaze and look_at", "write one of them")
        x, y, z = step.numbers("look_at", count=3)
        return Gaze(point=(x, y, z))
    if "gaze" not in step:
        return None
    x, y = step.numbers("gaze", count=2)
    if not (abs(x) <= 1 and abs(y) <= 1):
        raise step.error("gaze", f"a gaze of {x:g}, {y:g}", "write numbers from -1 to 1")
    return Gaze(x, y)


def _gesture(step: Table, model: FaceModel) -> tuple[str, float, float] | None:
    if "gesture" not in step:
        return None
    return (step.string("gesture", among=sorted(load_gestures(model))), *_force(step))


def _recording(step: Table, model: FaceModel) -> tuple[Track, float, float] | None:
    if "play" not in step:
        return None
    if "gesture" in step:
        raise step.error("play", "both gesture and play", "write one of them")
    return (read_weights(step.path.parent / step.string("play"), model), *_force(step))


def _force(step: Table) -> tuple[float, float]:
    """Strength and seconds of a gesture or recording."""
    strength = step.number("strength", 1.0, minimum=0, maximum=STRONGEST)
    return strength, step.number("seconds", 0.0, minimum=0, maximum=LONGEST_GESTURE)


def _state(step: Table) -> str | None:
    return step.string("state", among=("", *idle.STATES)) if "state" in step else None


def _mood(step: Table) -> tuple[float, float] | None:
    if "valence" not in step and "arousal" not in step:
        return None
    valence = step.number("valence", 0.0, minimum=-1, maximum=1)
    return valence, step.number("arousal", 0.0, minimum=-1, maximum=1)


def _weights(step: Table, model: FaceModel) -> Mapping[str, float] | None:
    if "weights" not in step:
        return None
    table = step.table("weights")
    for name in table.data:
        if name not in model.names:
            what = f'the face {model.name} has no target "{name}"'
            raise table.error(name, what, did_you_mean(name, model.names))
    return table.weights(-1.5, 1.5)


def scene_of(speech: Speech, expression: Expression) -> Scene:
    """A face that shows an expression and says one thing, from the first moment on."""
    if speech.duration > LONGEST:
        raise HriError(f"a speech of {speech.duration:.0f} s - keep to {LONGEST:g} s")
    cues = (Cue(0.0, expression=expression), Cue(0.0, speech=speech))
    return Scene(cues, speech.duration + ENDING)
