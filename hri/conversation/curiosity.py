"""Which question the robot asks next, of those that fit the hour, its feeling, and the talk."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date, datetime
from typing import Protocol

from hri.conversation.day import part_of_day
from hri.emotion.everyday_words import fitting

DAY = "day"


class Asking(Protocol):
    """A question, as far as the choice depends on it."""

    @property
    def ask(self) -> str:
        """Its words."""

    @property
    def hour(self) -> Sequence[str]:
        """Parts of the day at which it may be asked; any without one."""

    @property
    def once(self) -> str:
        """DAY for a question that is asked once a day."""

    @property
    def after(self) -> Sequence[str]:
        """Rules of which one must have been heard; none for a question that needs no occasion."""

    @property
    def feeling(self) -> Sequence[str]:
        """Words and labels of feelings in which it may be asked; any without one."""


@dataclass
class Curiosity:
    """Chooses questions, and remembers those that were asked."""

    seed: str
    """Decides on the order of equals; another one for each run."""
    _asked: dict[str, tuple[int, date]] = field(default_factory=dict)
    """By the words: its number among all that were asked, from 1, and the day."""
    _count: int = 0

    def choose(
        self, questions: Sequence[Asking], heard: Sequence[str], feeling: str, at: datetime
    ) -> int | None:
        """The place of the question to ask now in `questions`; None when none fits.

        `heard` are the rules that people said, the last one last, `feeling` is the label of what
        the robot feels. Of those that fit, one that was not asked yet comes first, then one that
        has an occasion, in the talk or in the feeling, then one for this part of the day.
        """
        fit = [n for n, one in enumerate(questions) if self._fits(one, heard, feeling, at)]
        return min(fit, key=lambda n: self._rank(questions[n]), default=None)

    def note(self, ask: str, at: datetime) -> None:
        """A question was asked."""
        self._count += 1
        self._asked[ask] = self._count, at.date()

    def _fits(self, one: Asking, heard: Sequence[str], feeling: str, at: datetime) -> bool:
        _, day = self._asked.get(one.ask, (0, None))
        is_early = bool(one.hour) and part_of_day(at.hour) not in one.hour
        is_repeated = one.once == DAY and day == at.date()
        is_occasion = not one.after or not set(one.after).isdisjoint(heard)
        is_felt = not one.feeling or bool(fitting(feeling, one.feeling))
        return is_occasion and is_felt and not is_early and not is_repeated

    def _rank(self, one: Asking) -> tuple[int, int, int, float]:
        number, _ = self._asked.get(one.ask, (0, None))
        # A text as a seed gives the same number on every machine.
        chance = random.Random(f"{self.seed}/{one.ask}").random()
        has_occasion = bool(one.after or one.feeling)
        return (number, -has_occasion, -bool(one.hour), chance)
