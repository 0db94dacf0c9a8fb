"""Which words are said, out of several that could be said.

Of the texts that fit the moment, one that was not said yet comes first, in the order of writing,
then the one that was said longest ago. A text that was said within RECENT_SECONDS is left out while
another one fits. Nothing is left to chance: the same visit gives the same words.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from hri.emotion.everyday_words import fitting

RECENT_SECONDS = 300.0
"""How long people remember that something was said, or asked."""
MOST_REMEMBERED = 1000
"""Texts of which it is remembered when they were said; beyond it the oldest are forgotten."""

Texts = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Wording:
    """All that may be said in reply to a rule."""

    say: Texts = ()
    again: Texts = ()
    """Said when the robot has answered the same a short time ago."""
    feeling: Mapping[str, Texts] = field(default_factory=dict)
    """By a word or label of `hri.emotion.everyday_words.KNOWN_FEELINGS`."""
    hour: Mapping[str, Texts] = field(default_factory=dict)
    """By the part of the day, see `hri.conversation.day`."""
    personality: Mapping[str, Texts] = field(default_factory=dict)
    """By the name of a personality."""
    worn: Texts = ()
    """Said when what it feels by the reply has come so often that it means little."""

    def texts(self) -> list[str]:
        """All of them."""
        by_name = (self.feeling, self.hour, self.personality)
        lists = [self.say, self.again, self.worn]
        lists += [texts for names in by_name for texts in names.values()]
        return [text for texts in lists for text in texts]


@dataclass(frozen=True, slots=True)
class Moment:
    """What the choice depends on."""

    feeling: str = "calm"
    """The label of what the robot feels."""
    part_of_day: str = "morning"
    personality: str = "neutral"
    is_again: bool = False
    """Whether it has answered the same within RECENT_SECONDS."""
    is_worn: bool = False
    """Whether the stimulus of the reply has come so often that it is hardly felt."""


@dataclass(frozen=True, slots=True)
class Pool:
    """Texts that fit for the same reason."""

    texts: Texts = ()
    is_felt: bool = False
    """Whether the reply has texts for what the robot feels; then its face shows that, too."""


def pools(wording: Wording, moment: Moment) -> list[Pool]:
    """The texts that fit a moment, those that should be said first in the first pool.

    `worn` comes before all others, and `again` before the rest. `feeling` replaces the rest;
    without one for this feeling, the texts for this hour, those for this personality, and `say`
    count together, in this order.
    """
    felt = wording.feeling.get(fitting(moment.feeling, wording.feeling), ())
    found = [Pool(wording.worn)] if moment.is_worn else []
    if moment.is_again:
        found.append(Pool(wording.again, bool(felt)))
    if felt:
        found.append(Pool(felt, is_felt=True))
    else:
        hour = wording.hour.get(moment.part_of_day, ())
        own = wording.personality.get(moment.personality, ())
        found.append(Pool((*hour, *own, *wording.say)))
    return [pool for pool in found if pool.texts]


class Spoken:
    """Remembers when which text was said, and when which rule was answered."""

    def __init__(self, most: int = MOST_REMEMBERED) -> None:
        """`most` is the number of texts, and of rules, that are remembered."""
        self._most = most
        self._said: OrderedDict[str, float] = OrderedDict()
        self._answered: OrderedDict[str, float] = OrderedDict()

    def answer(self, rule: str, now: float) -> bool:
        """Note that a rule is answered; whether it was, too, within RECENT_SECONDS before."""
        before = self._answered.get(rule, -math.inf)
        self._note(self._answered, rule, now)
        return now - before < RECENT_SECONDS

    def choose(self, found: Sequence[Pool], now: float) -> tuple[str, Pool]:
        """The text to say and the pool that it is from; `now` in seconds. Notes nothing.

        An empty text when there is none.
        """
        for pool in found:
            if fresh := [text for text in pool.texts if self._age(text, now) >= RECENT_SECONDS]:
                return self._oldest(fresh, now), pool
        texts = [text for pool in found for text in pool.texts]
        if not texts:
            return "", Pool()
        oldest = self._oldest(texts, now)
        return oldest, next(pool for pool in found if oldest in pool.texts)

    def note(self, text: str, now: float) -> None:
        """Remember that a text is said."""
        self._note(self._said, text, now)

    def _age(self, text: str, now: float) -> float:
        return now - self._said.get(text, -math.inf)

    def _oldest(self, texts: Sequence[str], now: float) -> str:
        return max(texts, key=lambda text: self._age(text, now))

    def _note(self, memory: OrderedDict[str, float], key: str, now: float) -> None:
        memory[key] = now
        memory.move_to_end(key)
        if len(memory) > self._most:
            memory.popitem(last=False)
