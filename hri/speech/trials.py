"""Recognition results of recordings with a grammar, at any strictness."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from hri.core.signals import Samples
from hri.hal.recognizer import Recognizer
from hri.speech.acceptance import needed
from hri.speech.grammar import Grammar
from hri.speech.grammar.lint.expectations import Meaning
from hri.speech.grammar.matching import Parse, parse
from hri.speech.hearing import hear
from hri.speech.turn import Turn

QUESTION = Turn(is_question_open=True)
"""A robot that has asked something and is silent: all rules count."""


@dataclass(frozen=True, eq=False)
class RecordedClip:
    """A recording with one thing said in it."""

    name: str
    samples: Samples
    rate: int
    """Samples a second."""
    said: str
    """The words, as far as they are known; for people."""
    meaning: Meaning | None
    """What should be understood; None when nothing should."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """What was made of a clip. Holds no sound."""

    name: str
    said: str
    meaning: Meaning | None
    pieces: tuple[tuple[Parse, float], ...]
    """For each piece of speech that fits the grammar, its best reading and its confidence."""

    def accepted(self, grammar: Grammar, strictness: float) -> list[Parse]:
        """What counts as heard."""
        return [
            reading
            for reading, confidence in self.pieces
            if confidence >= needed(grammar, reading, strictness, QUESTION)
        ]

    def is_right(self, grammar: Grammar, strictness: float) -> bool:
        """Whether the words were recognized exactly; speech outside the grammar must be
        rejected.
        """
        accepted = self.accepted(grammar, strictness)
        if self.meaning is None:
            return not accepted
        return len(accepted) == 1 and self.meaning.fits(accepted[0])


def attempt(clip: RecordedClip, engine: Recognizer, grammar: Grammar) -> Attempt:
    """Hear a clip as `hri grammar listen --wav` does; `engine` was started with the grammar."""
    heard = hear(clip.samples, clip.rate, engine, grammar, strictness=0.0, turn=QUESTION)
    found = ((parse(grammar, one.text), one.confidence) for one in heard)
    pieces = tuple((reading, confidence) for reading, confidence in found if reading is not None)
    return Attempt(clip.name, clip.said, clip.meaning, pieces)


Confusion = tuple[str, str]
"""The spoken sentence, and the sentence it was taken for."""


def confusions(
    attempts: Iterable[Attempt], grammar: Grammar, strictness: float
) -> Counter[Confusion]:
    """What was accepted with another meaning than it had, and how often."""
    found: Counter[Confusion] = Counter()
    for tried in attempts:
        accepted = tried.accepted(grammar, strictness)
        if accepted and not tried.is_right(grammar, strictness):
            found[tried.said, " / ".join(reading.text for reading in accepted)] += 1
    return found


@dataclass(frozen=True, slots=True)
class Score:
    """Counts over attempts at one strictness."""

    strictness: float
    commands: int
    right: int
    """Commands that were accepted with their meaning."""
    wrong: int
    """Commands that were accepted with another meaning."""
    foreign: int
    """Clips outside of the grammar."""
    foreign_accepted: int


def score(attempts: Sequence[Attempt], grammar: Grammar, strictness: float) -> Score:
    """How many clips were taken for what they are."""
    commands = [tried for tried in attempts if tried.meaning is not None]
    foreign = [tried for tried in attempts if tried.meaning is None]
    accepted = sum(bool(tried.accepted(grammar, strictness)) for tried in commands)
    right = sum(tried.is_right(grammar, strictness) for tried in commands)
    return Score(
        strictness,
        commands=len(commands),
        right=right,
        wrong=accepted - right,
        foreign=len(foreign),
        foreign_accepted=sum(bool(tried.accepted(grammar, strictness)) for tried in foreign),
    )


NEARLY = 0.02
"""Share of the commands that a stricter setting may lose and still be the better one."""


def recommended(scores: Sequence[Score], most_foreign: float) -> Score:
    """The strictest score that is nearly as good as the best one.

    Good is a score with many commands right and few wrong, among those where at most the share
    `most_foreign`, 0 to 1, of the foreign clips was accepted; where there is none, the one that
    accepts the fewest is taken.
    """
    fitting = [one for one in scores if one.foreign_accepted <= most_foreign * one.foreign]
    if not fitting:
        return min(scores, key=lambda one: (one.foreign_accepted, -one.strictness))
    least = max(one.right - one.wrong for one in fitting) - NEARLY * fitting[0].commands
    good = [one for one in fitting if one.right - one.wrong >= least]
    return max(good, key=lambda one: one.strictness)
