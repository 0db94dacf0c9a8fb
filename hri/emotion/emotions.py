"""The emotions the robot can have: what they feel like, how long they last, which are opposites.

The 22 of Ortony, Clore and Collins (OCC, "The Cognitive Structure of Emotions", 1988), and surprise
and disgust so that the six basic ones are all there. The words are those of everyday life:
"sadness" is the distress of OCC, and this is the only place where that matters.

Coordinates of the six basic emotions: Russell and Mehrabian 1977, "Evidence for a three-factor
theory of emotions", J. Research in Personality 11:273-294, scaled to -1..1. All others: Gebhard
2005, "ALMA: a layered model of affect", AAMAS, table 2. The time constants are ours, set by eye for
a visit of a few minutes (ALMA fades an emotion linearly within 20 s); what names a feeling more
exactly (relief rather than joy) lasts longer, so that it has the last word.

Sadness, anger, shame, remorse and gratitude last longer than the moment: a share of each charge
fades over minutes. It counts as a part, "sadness.slow", beside the quick one: the closed forms see
two feelings, whoever reads them sees one. That such episodes last minutes to hours is Verduyn and
Lavrijsen 2015, "Which emotions last longest and why", Motivation and Emotion 39:119-127.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from hri.core.errors import did_you_mean
from hri.core.toml import Table


@dataclass(frozen=True, slots=True)
class Emotion:
    """A row of the table."""

    name: str
    pleasure: float
    """-1 to 1; its sign makes the emotion a positive or a negative one."""
    arousal: float
    """-1 to 1."""
    dominance: float
    """-1 to 1."""
    tau_s: float
    """Seconds in which its charge falls to 1/e."""
    slow_share: float = 0.0
    """Share of a charge that lasts longer, 0 to 1."""
    slow_tau_s: float = 0.0
    """Seconds in which that share falls to 1/e; 0: there is none."""

    @property
    def is_positive(self) -> bool:
        """Whether it pleases."""
        return self.pleasure >= 0


EMOTIONS = (
    # the six basic ones
    Emotion("joy", 0.76, 0.48, 0.35, 12.0, 0.0, 150.0),
    Emotion("sadness", -0.63, -0.27, -0.33, 13.0, 0.35, 240.0),
    Emotion("anger", -0.51, 0.59, 0.25, 14.0, 0.25, 180.0),
    Emotion("fear", -0.64, 0.60, -0.43, 5.0),
    Emotion("disgust", -0.60, 0.35, 0.11, 8.0),
    Emotion("surprise", 0.40, 0.67, -0.13, 1.5),
    # prospects, and what became of them
    Emotion("hope", 0.20, 0.20, -0.10, 12.0),
    Emotion("satisfaction", 0.30, -0.20, 0.40, 18.0),
    Emotion("relief", 0.20, -0.30, 0.40, 16.0),
    Emotion("disappointment", -0.30, 0.10, -0.40, 18.0),
    Emotion("fears_confirmed", -0.50, -0.30, -0.70, 16.0),
    # the fortunes of others
    Emotion("happy_for", 0.40, 0.20, 0.20, 12.0),
    Emotion("gloating", 0.30, -0.30, -0.10, 10.0),
    Emotion("resentment", -0.20, -0.30, -0.20, 14.0),
    Emotion("pity", -0.40, -0.20, -0.50, 12.0),
    # own acts, acts of others
    Emotion("pride", 0.40, 0.30, 0.30, 12.0),
    Emotion("shame", -0.30, 0.10, -0.60, 12.0, 0.3, 240.0),
    Emotion("admiration", 0.50, 0.30, -0.20, 10.0),
    Emotion("reproach", -0.30, -0.10, 0.40, 12.0),
    # own acts, acts of others, and their outcome
    Emotion("gratification", 0.60, 0.50, 0.40, 14.0),
    Emotion("remorse", -0.30, 0.10, -0.60, 16.0, 0.4, 300.0),
    Emotion("gratitude", 0.40, 0.20, -0.30, 14.0, 0.3, 240.0),
    # things and persons in themselves
    Emotion("love", 0.30, 0.10, 0.20, 15.0),
    Emotion("hate", -0.60, 0.60, 0.30, 12.0),
)

NAMES = tuple(emotion.name for emotion in EMOTIONS)
INDEX = {name: index for index, name in enumerate(NAMES)}

SLOW = ".slow"
"""What the slow part of an emotion is called after its name."""
PART_OF = {name: name for name in NAMES} | {
    emotion.name + SLOW: emotion.name for emotion in EMOTIONS if emotion.slow_tau_s
}
"""The emotion of each part that a charge may have."""
SLOW_SHARES = {emotion.name: emotion.slow_share for emotion in EMOTIONS if emotion.slow_share}


def in_parts(charges: Mapping[str, float]) -> dict[str, float]:
    """Charges by emotion, divided into their quick and slow parts."""
    parts = dict(charges)
    for name, share in SLOW_SHARES.items():
        if charge := charges.get(name):
            parts[name] = charge * (1.0 - share)
            parts[name + SLOW] = charge * share
    return parts


def whole(parts: Mapping[str, float]) -> dict[str, float]:
    """Charges by part, added up by emotion."""
    charges: dict[str, float] = {}
    for part, charge in parts.items():
        name = PART_OF[part]
        charges[name] = charges.get(name, 0.0) + charge
    return charges


OPPOSITES = (
    ("joy", "sadness"),
    ("joy", "anger"),
    ("joy", "fear"),
    ("pride", "shame"),
    ("admiration", "reproach"),
    ("gratification", "remorse"),
    ("gratitude", "anger"),
    ("love", "hate"),
    ("love", "anger"),
    ("love", "disgust"),
)
"""Pairs of which a new one drives out the old one; always a positive and a negative emotion, so
that what pleases more can never leave the robot less pleased."""

OPPOSITES_ABOUT_ONE_THING = (
    ("hope", "fear"),
    ("hope", "disappointment"),
    ("relief", "fear"),
    ("satisfaction", "disappointment"),
    ("satisfaction", "fears_confirmed"),
    ("happy_for", "resentment"),
    ("happy_for", "pity"),
    ("gloating", "resentment"),
    ("gloating", "pity"),
)
"""The same, for one goal only: hope for one goal and fear for another can coexist."""


def _opposites_of(name: str, pairs: tuple[tuple[str, str], ...]) -> tuple[str, ...]:
    """The parts of the emotions that are paired with one."""
    others = {other for pair in pairs if name in pair for other in pair if other != name}
    return tuple(part for part, name in PART_OF.items() if name in others)


OPPOSITES_OF = {part: _opposites_of(name, OPPOSITES) for part, name in PART_OF.items()}
"""The parts of the opposites of the emotion of each part, whatever it is about."""
OPPOSITES_OF_THE_SAME = {
    part: _opposites_of(name, OPPOSITES_ABOUT_ONE_THING) for part, name in PART_OF.items()
}
"""The same when both are about one thing."""


def emotions_in(table: Table) -> list[str]:
    """The keys of a table of an authored file that is keyed by emotion.

    Raises AuthoringError for a name that is not an emotion.
    """
    for name in table.data:
        if name not in INDEX:
            raise table.error(name, f'no emotion "{name}"', did_you_mean(name, NAMES))
    return list(table.data)
