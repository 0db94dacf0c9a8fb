"""How a feeling shows on the face, in the voice and in the driving: `emotions/display.toml`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hri.core import paths
from hri.core.errors import did_you_mean
from hri.core.signals import EmotionState, Expression, Prosody
from hri.core.toml import Table, load_toml
from hri.emotion.emotions import NAMES, PAD, Vector
from hri.emotion.label import MOODS

EXPRESSIONS = (
    "neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted", "asleep",
)  # fmt: skip
"""What every face can show."""

LABELS = (*NAMES, *MOODS)
"""Every label that a state can have."""

_ALMOST = 1 - 1e-12
"""A mood this close to the end of an axis is taken for less, so that its inverse is finite."""


@dataclass(frozen=True, slots=True)
class Look:
    """What a label looks like and is called."""

    expression: str
    gain: float
    """Intensity of the expression for intensity 1 of the feeling."""
    words: str
    """What the robot is, after "I am": "happy"."""


@dataclass(frozen=True, slots=True)
class Rule:
    """A factor that is linear in what is felt, within limits; 1 where nothing is felt."""

    pleasure: float
    arousal: float
    dominance: float
    minimum: float
    maximum: float

    def factor(self, felt: Vector) -> float:
        """The factor for pleasure, arousal and dominance, each -1 to 1."""
        weights = np.array([self.pleasure, self.arousal, self.dominance])
        return min(max(1.0 + float(weights @ felt), self.minimum), self.maximum)


STEADY = Rule(0.0, 0.0, 0.0, 1.0, 1.0)
"""What does not follow the feelings."""


@dataclass(frozen=True, slots=True)
class Display:
    """The whole file: a look for every label, a rule for each thing that follows the feelings."""

    looks: Mapping[str, Look]
    rate: Rule
    pitch: Rule
    volume: Rule
    range: Rule
    speed: Rule

    def expression(self, state: EmotionState, expressiveness: float = 1.0) -> Expression:
        """The face for a state."""
        look = self.looks[state.label]
        intensity = min(1.0, look.gain * state.intensity * expressiveness)
        return Expression(look.expression, intensity)

    def prosody(self, felt: Vector) -> Prosody:
        """The voice for pleasure, arousal and dominance, each -1 to 1."""
        return Prosody(
            rate=self.rate.factor(felt),
            pitch=self.pitch.factor(felt),
            volume=self.volume.factor(felt),
            range=self.range.factor(felt),
        )


def felt_now(state: EmotionState) -> Vector:
    """Pleasure, arousal and dominance of mood and emotions together, each -1 to 1.

    The mood alone is too slow for voice and motion: who is praised sounds pleased at once.
    """
    mood = np.clip([state.valence, state.arousal, state.dominance], -_ALMOST, _ALMOST)
    pull = np.array([state.emotions.get(name, 0.0) for name in NAMES]) @ PAD
    felt: Vector = np.tanh(np.arctanh(mood) + pull)
    return felt


def display_path() -> Path:
    """The file that is in use."""
    return paths.find("emotions", "display")


def load_display(path: Path | None = None) -> Display:
    """The display rules. Raises HriError, or AuthoringError with the place."""
    table = load_toml(path or display_path(), "display file")
    looks = table.table("label")
    voice = table.table("voice")
    drive = table.table("drive")
    display = Display(
        looks=_looks(looks),
        rate=_rule(voice.table("rate")),
        pitch=_rule(voice.table("pitch")),
        volume=_rule(voice.table("volume")),
        range=_rule(voice.table("range")) if "range" in voice else STEADY,
        speed=_rule(drive.table("speed")),
    )
    for part in (voice, drive, table):
        part.finish()
    return display


def _looks(table: Table) -> dict[str, Look]:
    for name in table.data:
        if name not in LABELS:
            raise table.error(name, f'no label "{name}"', did_you_mean(name, LABELS))
    return {label: _look(table.table(label)) for label in LABELS}


def _look(table: Table) -> Look:
    look = Look(
        expression=table.string("expression", among=EXPRESSIONS),
        gain=table.number("gain", 1.0, minimum=0.0, maximum=5.0),
        words=table.string("words"),
    )
    table.finish()
    return look


def _rule(table: Table) -> Rule:
    pleasure, arousal, dominance = (
        table.number(axis, 0.0, minimum=-2, maximum=2)
        for axis in ("pleasure", "arousal", "dominance")
    )
    rule = Rule(
        pleasure,
        arousal,
        dominance,
        minimum=table.number("minimum", minimum=0.1, maximum=1),
        maximum=table.number("maximum", minimum=1, maximum=3),
    )
    table.finish()
    return rule
