"""What makes one robot an optimist and another shy, read from `emotions/personalities/*.toml`.

An optimist differs from a pessimist by baseline, gains and persistence only. As long as the mood's
time constants and the habituation are shared, the same events then never leave the optimist less
pleased than the pessimist: all kernels of the dynamics are positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hri.core import paths
from hri.core.toml import Table, load_toml
from hri.emotion.emotions import Emotion, emotions_in

FOLDER = "emotions/personalities"
_STRONGEST = 5.0
"""Largest factor a personality may put on an emotion."""
_RETURN_S = 150.0
_FOLLOW_S = 40.0


@dataclass(frozen=True, slots=True)
class Temper:
    """How a personality differs on some emotions; 1 is as the neutral one."""

    gain: float = 1.0
    """How strongly they are felt."""
    persistence: float = 1.0
    """How long they last."""


@dataclass(frozen=True, slots=True)
class Personality:
    """Where the mood rests, and how strongly and how long emotions are felt."""

    name: str
    baseline: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Pleasure, arousal, dominance at rest, each -0.9 to 0.9."""
    positive: Temper = Temper()
    negative: Temper = Temper()
    emotions: Mapping[str, Temper] = field(default_factory=dict)
    """On top of these, for single emotions."""
    return_s: float = _RETURN_S
    """Seconds in which the mood's way back to the baseline falls to 1/e."""
    follow_s: float = _FOLLOW_S
    """Seconds in which an emotion of charge 1 would move the mood by its own coordinates."""
    expressiveness: float = 1.0
    """How much of what is felt the face shows."""

    def gain(self, emotion: Emotion) -> float:
        return self._general(emotion).gain * self._special(emotion).gain

    def tau_s(self, emotion: Emotion) -> float:
        """Seconds in which the emotion's charge falls to 1/e."""
        persistence = self._general(emotion).persistence * self._special(emotion).persistence
        return emotion.tau_s * persistence

    def _general(self, emotion: Emotion) -> Temper:
        return self.positive if emotion.pleasure >= 0 else self.negative

    def _special(self, emotion: Emotion) -> Temper:
        return self.emotions.get(emotion.name, Temper())


def personality_path(name: str) -> Path:
    """The file of a personality, by name or path. Raises HriError when there is none."""
    return paths.find(FOLDER, name)


def load_personality(name: str) -> Personality:
    """A personality by name or path. Raises HriError, or AuthoringError with the place."""
    path = personality_path(name)
    table = load_toml(path, "personality")
    mood = table.table("mood", optional=True)
    personality = Personality(
        name=path.stem,
        baseline=_baseline(table.table("baseline", optional=True)),
        positive=_temper(table.table("positive", optional=True)),
        negative=_temper(table.table("negative", optional=True)),
        emotions=_overrides(table.table("emotion", optional=True)),
        return_s=mood.number("return_s", _RETURN_S, minimum=1, maximum=86400),
        follow_s=mood.number("follow_s", _FOLLOW_S, minimum=1, maximum=86400),
        expressiveness=table.number("expressiveness", 1.0, minimum=0, maximum=2),
    )
    mood.finish()
    table.string("description", "")
    table.finish()
    return personality


def _baseline(table: Table) -> tuple[float, float, float]:
    axes = ("pleasure", "arousal", "dominance")
    pleasure, arousal, dominance = (
        table.number(axis, 0.0, minimum=-0.9, maximum=0.9) for axis in axes
    )
    table.finish()
    return pleasure, arousal, dominance


def _overrides(table: Table) -> dict[str, Temper]:
    return {name: _temper(table.table(name)) for name in emotions_in(table)}


def _temper(table: Table) -> Temper:
    gain = table.number("gain", 1.0, minimum=0.0, maximum=_STRONGEST)
    persistence = table.number("persistence", 1.0, minimum=0.1, maximum=_STRONGEST)
    table.finish()
    return Temper(gain, persistence)
