"""What makes one robot an optimist and another shy, read from `emotions/personalities/*.toml`.

An optimist differs from a pessimist by baseline, gains and persistence only. As long as the mood's
time constants, the drives and the habituation are shared, the same events then never leave the
optimist less pleased than the pessimist: all kernels of the dynamics are positive.

The baseline is given as it is, or by the five factors (OCEAN) with the coefficients of Mehrabian
1996, Australian J. Psychology 48:86-92. His fifth factor is emotional stability, which is minus
neuroticism; ALMA prints his equations with neuroticism and loses the sign.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from hri.core import paths
from hri.core.toml import Table, load_toml
from hri.emotion.drives import DRIVES, Drive, drives_in
from hri.emotion.emotions import Emotion, emotions_in
from hri.emotion.ledger import Axes

FOLDER = "emotions/personalities"
_STRONGEST = 5.0
"""Largest factor a personality may put on an emotion."""
_RETURN_S = 150.0
_FOLLOW_S = 55.0
FARTHEST = 0.9
"""A baseline lies within plus and minus this on each axis: the rest is left to what happens."""
FACTORS = ("openness", "conscientiousness", "extraversion", "agreeableness", "neuroticism")


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
    baseline: Axes = (0.0, 0.0, 0.0)
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
    """How much of its feelings the face shows."""
    voice: str = ""
    """Whose voice it speaks with: a name, a language or a character; empty for the robot's own."""
    drives: tuple[Drive, ...] = DRIVES
    """What it needs."""

    def gain(self, emotion: Emotion) -> float:
        """Factor on what the emotion is charged with."""
        return self._general(emotion).gain * self._special(emotion).gain

    def tau_s(self, emotion: Emotion, is_slow: bool = False) -> float:
        """Seconds in which the emotion's charge falls to 1/e, or its slow part."""
        persistence = self._general(emotion).persistence * self._special(emotion).persistence
        return (emotion.slow_tau_s if is_slow else emotion.tau_s) * persistence

    def _general(self, emotion: Emotion) -> Temper:
        return self.positive if emotion.is_positive else self.negative

    def _special(self, emotion: Emotion) -> Temper:
        return self.emotions.get(emotion.name, Temper())


def personality_path(name: str) -> Path:
    """The file of a personality, by name or path; "hot-tempered" is hot_tempered, too.

    Raises HriError when there is none.
    """
    known = personality_names()
    spelled = name.replace("-", "_")
    return paths.find(FOLDER, spelled if name not in known and spelled in known else name)


def personality_names() -> frozenset[str]:
    """Names of the personalities in the search folders."""
    return frozenset(Path(found).stem for found in paths.names(FOLDER))


def load_personality(name: str) -> Personality:
    """A personality by name or path. Raises HriError, or AuthoringError with the place."""
    path = personality_path(name)
    table = load_toml(path, "personality")
    mood = table.table("mood", optional=True)
    personality = Personality(
        name=path.stem,
        baseline=_baseline(table),
        positive=_temper(table.table("positive", optional=True)),
        negative=_temper(table.table("negative", optional=True)),
        emotions=_overrides(table.table("emotion", optional=True)),
        return_s=mood.number("return_s", _RETURN_S, minimum=1, maximum=86400),
        follow_s=mood.number("follow_s", _FOLLOW_S, minimum=1, maximum=86400),
        expressiveness=table.number("expressiveness", 1.0, minimum=0, maximum=2),
        voice=table.string("voice", ""),
        drives=_drives(table.table("drive", optional=True)),
    )
    mood.finish()
    table.string("description", "")
    table.number("schema", 1, minimum=1, maximum=1)
    table.finish()
    return personality


def baseline_of(
    openness: float,
    conscientiousness: float,
    extraversion: float,
    agreeableness: float,
    neuroticism: float,
) -> Axes:
    """Pleasure, arousal and dominance of the five factors, each -1 to 1.

    Mehrabian regressed the factors on pleasure, arousal and dominance; to read his coefficients the
    other way round is ALMA's convenience. Their sums reach 1.34, hence the limit of FARTHEST.
    """
    stability = -neuroticism
    pleasure = 0.21 * extraversion + 0.59 * agreeableness + 0.19 * stability
    arousal = 0.15 * openness + 0.30 * agreeableness - 0.57 * stability
    dominance = (
        0.25 * openness + 0.17 * conscientiousness + 0.60 * extraversion - 0.32 * agreeableness
    )
    return _within(pleasure), _within(arousal), _within(dominance)


def _within(axis: float) -> float:
    return min(max(axis, -FARTHEST), FARTHEST)


def _baseline(table: Table) -> Axes:
    if "ocean" in table and "baseline" in table:
        raise table.error("ocean", "both ocean and baseline are given", "leave one of them out")
    ocean, given = table.table("ocean", optional=True), table.table("baseline", optional=True)
    factors = [ocean.number(factor, 0.0, minimum=-1, maximum=1) for factor in FACTORS]
    axes = [
        given.number(axis, 0.0, minimum=-FARTHEST, maximum=FARTHEST)
        for axis in ("pleasure", "arousal", "dominance")
    ]
    ocean.finish()
    given.finish()
    return baseline_of(*factors) if "ocean" in table else (axes[0], axes[1], axes[2])


def _drives(table: Table) -> tuple[Drive, ...]:
    changed = {name: table.table(name) for name in drives_in(table)}
    return tuple(
        _drive(drive, changed[drive.name]) if drive.name in changed else drive for drive in DRIVES
    )


def _drive(drive: Drive, table: Table) -> Drive:
    rate = table.number("rate", 1.0, minimum=0.05, maximum=20.0)
    resting = table.number("resting", drive.resting, minimum=0.0, maximum=1.0)
    table.finish()
    return replace(drive, resting=resting, tau_s=drive.tau_s / rate)


def _overrides(table: Table) -> dict[str, Temper]:
    return {name: _temper(table.table(name)) for name in emotions_in(table)}


def _temper(table: Table) -> Temper:
    gain = table.number("gain", 1.0, minimum=0.0, maximum=_STRONGEST)
    persistence = table.number("persistence", 1.0, minimum=0.1, maximum=_STRONGEST)
    table.finish()
    return Temper(gain, persistence)
