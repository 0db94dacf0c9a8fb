"""How a feeling shows on the face, in the voice, the eyes and the driving: `emotions/display.toml`.

Shown and felt emotions may differ. Display rules (P. Ekman and W. V. Friesen, "The repertoire
of nonverbal behavior", Semiotica 1, 1969) weaken, exaggerate, hide or mask single emotions; what
has not been hidden goes on to face, voice, eyes and driving.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import EmotionState, Expression, Gaze, Prosody
from hri.core.toml import Table, load_toml
from hri.emotion.emotion_voice import EmotionVoice, blended, read_voice
from hri.emotion.emotions import EMOTIONS, INDEX, NAMES, emotions_in
from hri.emotion.expressive_motion import ExpressiveMotion, read_motion
from hri.emotion.label import CALM, LEAD, MOODS, STANDS_OUT, known_as

Felt = tuple[float, float, float]
"""Pleasure, arousal, dominance, each -1 to 1."""

EXPRESSIONS = (
    "neutral", "angry", "sad", "happy", "surprised", "disgusted", "scared", "pleading",
    "vulnerable", "despaired", "guilty", "disappointed", "embarrassed", "horrified", "skeptical",
    "annoyed", "furious", "suspicious", "rejected", "bored", "tired", "asleep", "confused",
    "amazed", "excited",
)  # fmt: skip
"""What faces can show: the labels of ROS4HRI's hri_msgs/Expression."""

LABELS = (*NAMES, *MOODS)
"""Every label that a state can have."""

FAINT = 0.3
"""A feeling of less intensity is faint."""
STRONG_EMOTION, STRONG_MOOD = 0.8, 0.6
"""An emotion, or a mood, of more is strong."""

HONEST = ""
"""The name for no display rules: feelings are shown as they are."""

_ALMOST = 1 - 1e-12
"""A mood this close to the end of an axis is taken for less, so that its inverse is finite."""


@dataclass(frozen=True, slots=True)
class EmotionLook:
    """What a label looks like and is called."""

    expression: str
    gain: float
    """Intensity of the expression for intensity 1 of the feeling."""
    words: str
    """What the robot is, after "I am": "happy"."""
    faintly: str = ""
    """The same while it is faint: "fine"; empty: no other words."""
    strongly: str = ""
    """The same while it is strong: "in high spirits"."""
    strong: float = STRONG_EMOTION
    """Intensity above which it is strong."""

    def said(self, intensity: float) -> str:
        """What the robot is, for an intensity from 0 to 1."""
        is_strong = intensity > self.strong
        degree = self.faintly if intensity < FAINT else self.strongly if is_strong else ""
        return degree or self.words


@dataclass(frozen=True, slots=True)
class Rule:
    """A linear function of the mood, within limits."""

    pleasure: float
    arousal: float
    dominance: float
    minimum: float
    maximum: float
    rest: float = 1.0
    """Where nothing is felt; 1 for a factor."""

    def value(self, felt: Felt) -> float:
        """The value for pleasure, arousal and dominance, each -1 to 1."""
        pleasure, arousal, dominance = felt
        moved = self.pleasure * pleasure + self.arousal * arousal + self.dominance * dominance
        return self.within(self.rest + float(moved))

    def within(self, value: float) -> float:
        """The nearest value within the limits."""
        return min(max(value, self.minimum), self.maximum)


STEADY = Rule(0.0, 0.0, 0.0, 1.0, 1.0)
"""A factor that does not follow the feelings."""
STRAIGHT = Rule(0.0, 0.0, 0.0, 0.0, 0.0, rest=0.0)
"""Eyes that do not."""


@dataclass(frozen=True, slots=True)
class DisplayRule:
    """How a felt emotion is shown."""

    show: str
    """The emotion that is shown in its place; the same one when it is not masked."""
    gain: float
    """Factor on its charge: 0 hides it, below 1 weakens, above 1 exaggerates it."""


@dataclass(frozen=True, slots=True)
class Display:
    """The whole file: a look for every label, a rule for each thing that follows the feelings."""

    looks: Mapping[str, EmotionLook]
    rate: Rule
    pitch: Rule
    volume: Rule
    range: Rule
    speed: Rule
    gaze: Rule
    """Height of the eyes, -1 (down) to 1 (up)."""
    rules: Mapping[str, Mapping[str, DisplayRule]]
    """Display rules by the name of the set and the emotion."""
    motions: Mapping[str, ExpressiveMotion]
    """What the base does as an emotion begins to show."""
    voices: Mapping[str, EmotionVoice]
    """What the voice does for an emotion, beside pleasure, arousal and dominance."""

    def shown(self, state: EmotionState, rules: str = HONEST) -> EmotionState:
        """What others get to see of a state under a set of display rules.

        The mood is left as it is: it leaks through. Raises HriError for an unknown set.
        """
        if rules == HONEST:
            return state
        if rules not in self.rules:
            raise HriError(f'no display rules "{rules}" - {did_you_mean(rules, self.rules)}')
        return _shown(state, self.rules[rules])

    def expression(self, state: EmotionState, expressiveness: float = 1.0) -> Expression:
        """The face for a state: the look of its label, above the valence and arousal of its mood.

        `expressiveness` is a factor on all that the face shows, 0 or more.
        """
        look = self.looks[state.label]
        intensity = min(1.0, look.gain * state.intensity * expressiveness)
        valence, arousal = (
            min(max(axis * expressiveness, -1.0), 1.0) for axis in (state.valence, state.arousal)
        )
        return Expression(look.expression, intensity, valence=valence, arousal=arousal)

    def motion(self, state: EmotionState, expressiveness: float = 1.0) -> ExpressiveMotion | None:
        """What the base does for a state; None where it is not felt strongly enough."""
        motion = self.motions.get(state.label)
        is_shown = motion is not None and state.intensity * expressiveness >= motion.above
        return motion if is_shown else None

    def prosody(self, state: EmotionState) -> Prosody:
        """The voice for a state."""
        felt, voice = felt_now(state), blended(self.voices, state.emotions)
        return Prosody(
            rate=self.rate.within(self.rate.value(felt) * voice.rate),
            pitch=self.pitch.within(self.pitch.value(felt) * voice.pitch),
            volume=self.volume.within(self.volume.value(felt) * voice.volume),
            range=self.range.within(self.range.value(felt) * voice.range),
            quality=voice.quality,
        )

    def eyes(self, felt: Felt) -> Gaze:
        """Where the eyes rest: down when ashamed or sad, up when proud."""
        return Gaze(0.0, self.gaze.value(felt))


def felt_now(state: EmotionState) -> Felt:
    """Pleasure, arousal and dominance of mood and emotions together, each -1 to 1.

    The mood alone is too slow for voice and motion: praise must be audible at once.
    """
    pleasure, arousal, dominance = map(
        _straightened, (state.valence, state.arousal, state.dominance)
    )
    for name, intensity in state.emotions.items():
        if intensity:
            emotion = EMOTIONS[INDEX[name]]
            pleasure += intensity * emotion.pleasure
            arousal += intensity * emotion.arousal
            dominance += intensity * emotion.dominance
    return math.tanh(pleasure), math.tanh(arousal), math.tanh(dominance)


def _straightened(axis: float) -> float:
    """What the mood sums up before it saturates."""
    return math.atanh(min(max(axis, -_ALMOST), _ALMOST))


def _shown(state: EmotionState, rules: Mapping[str, DisplayRule]) -> EmotionState:
    hidden = dict.fromkeys(state.emotions, 1.0)
    """1 - intensity by emotion: charges add where these multiply."""
    for name, intensity in state.emotions.items():
        rule = rules.get(name, DisplayRule(name, 1.0))
        hidden[rule.show] = hidden.get(rule.show, 1.0) * (1.0 - intensity) ** rule.gain
    emotions = {name: 1.0 - rest for name, rest in hidden.items()}
    label = rules[state.label].show if state.label in rules else state.label
    strongest = max(emotions, key=lambda name: emotions[name], default=label)
    if _outshines(emotions.get(strongest, 0.0), emotions.get(label, 0.0)):
        label = strongest
    if label in MOODS:
        return replace(state, emotions=emotions)
    if emotions.get(label, 0.0) > 0.0:
        return replace(state, label=label, intensity=emotions[label], emotions=emotions)
    return replace(state, label=CALM, intensity=0.0, emotions=emotions)


def _outshines(intensity: float, other: float) -> bool:
    """Whether an emotion is shown before the one that has the label, as it would take the label."""
    return intensity >= STANDS_OUT and _charge(intensity) >= LEAD * _charge(other)


def _charge(intensity: float) -> float:
    return -math.log1p(-intensity) if intensity < 1.0 else math.inf


def display_path() -> Path:
    """The file that is in use."""
    return paths.find("emotions", "display")


def load_display(path: Path | None = None) -> Display:
    """The display rules. Raises HriError, or AuthoringError with the place."""
    table = load_toml(path or display_path(), "display file")
    table.number("schema", 1, minimum=1, maximum=1)
    looks = table.table("label")
    voice = table.table("voice")
    voices = voice.table("of", optional=True)
    drive = table.table("drive")
    eyes = table.table("eyes", optional=True)
    motions = table.table("motion", optional=True)
    display = Display(
        looks=_looks(looks),
        rate=_factor(voice.table("rate")),
        pitch=_factor(voice.table("pitch")),
        volume=_factor(voice.table("volume")),
        range=_factor(voice.table("range")) if "range" in voice else STEADY,
        speed=_factor(drive.table("speed")),
        gaze=_height(eyes.table("height")) if "height" in eyes else STRAIGHT,
        rules={name: _rules(below) for name, below in table.tables("rules")},
        motions={name: read_motion(motions.table(name)) for name in emotions_in(motions)},
        voices={name: read_voice(voices.table(name)) for name in emotions_in(voices)},
    )
    for part in (voice, voices, drive, eyes, motions, table):
        part.finish()
    return display


def _looks(table: Table) -> dict[str, EmotionLook]:
    """A look for every label; one that the file leaves out shows as the mood alone."""
    for name in table.data:
        if known_as(name) not in LABELS:
            raise table.error(name, f'no label "{name}"', did_you_mean(name, LABELS))
    written = {known_as(name): _look(known_as(name), table.table(name)) for name in table.data}
    return {
        label: written.get(label, EmotionLook("neutral", 1.0, label.replace("_", " ")))
        for label in LABELS
    }


def _look(label: str, table: Table) -> EmotionLook:
    look = EmotionLook(
        expression=table.string("expression", among=EXPRESSIONS),
        gain=table.number("gain", 1.0, minimum=0.0, maximum=5.0),
        words=table.string("words"),
        faintly=table.string("faintly", ""),
        strongly=table.string("strongly", ""),
        strong=STRONG_MOOD if label in MOODS else STRONG_EMOTION,
    )
    table.finish()
    return look


def _rule(table: Table, least: float, rest: float, most: float) -> Rule:
    """A rule with limits on both sides of its value at rest."""
    pleasure, arousal, dominance = (
        table.number(axis, 0.0, minimum=-2, maximum=2)
        for axis in ("pleasure", "arousal", "dominance")
    )
    minimum = table.number("minimum", minimum=least, maximum=rest)
    maximum = table.number("maximum", minimum=rest, maximum=most)
    table.finish()
    return Rule(pleasure, arousal, dominance, minimum, maximum, rest)


_factor = partial(_rule, least=0.1, rest=1.0, most=3.0)
_height = partial(_rule, least=-1.0, rest=0.0, most=1.0)


def _rules(table: Table) -> dict[str, DisplayRule]:
    return {name: _display_rule(name, table.table(name)) for name in emotions_in(table)}


def _display_rule(emotion: str, table: Table) -> DisplayRule:
    rule = DisplayRule(
        show=table.string("show", emotion, among=NAMES),
        gain=table.number("gain", 1.0, minimum=0.0, maximum=5.0),
    )
    table.finish()
    return rule
