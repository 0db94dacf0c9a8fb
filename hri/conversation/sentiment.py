"""How someone feels who says a sentence, by its words: for sentences that no rule allows.

Words count as in a lexicon of sentiment, and a word of denial shortly before turns them around
(Hutto and Gilbert, "VADER: A Parsimonious Rule-based Model for Sentiment Analysis of Social Media
Text", ICWSM 2014). The lexicon, sentiment.toml, is ours.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from enum import StrEnum
from functools import cache
from itertools import pairwise
from pathlib import Path

from hri.conversation.dialog_act import ROBOT, opened
from hri.core.toml import load_toml
from hri.speech.grammar.words import normalize

LEXICON = Path(__file__).with_name("sentiment.toml")
DENIED_WITHIN = 3
"""Words before one that is denied, at most (Hutto and Gilbert)."""
CLOSELY = 2
"""The same of praise: who denies more than that speaks of something else."""
# fmt: off
DENIALS = frozenset((
    "ain't", "aren't", "can't", "cannot", "couldn't", "didn't", "doesn't", "don't", "hardly",
    "haven't", "isn't", "never", "no", "not", "wasn't", "weren't", "without", "won't", "wouldn't",
))
# fmt: on
MEANT = frozenset((("this", "thing"), ("this", "thing's"), ("this", "robot"), ("the", "robot")))
"""Words that speak of the robot without a "you"."""


class Sentiment(StrEnum):
    """What a sentence says of a feeling. Each is a list of the lexicon."""

    SAD = "sad"
    GLAD = "glad"
    ANGRY = "angry"
    AFRAID = "afraid"
    WEARY = "weary"
    KIND = "kind"
    """To the robot."""
    UNKIND = "unkind"
    """To the robot."""


Phrase = tuple[str, ...]
OPPOSITE = {Sentiment.GLAD: Sentiment.SAD, Sentiment.KIND: Sentiment.UNKIND}
"""What it becomes when it is denied; who is not sad may feel anything."""


def sentiment_of(text: str) -> Sentiment | None:
    """What most words of a sentence say, the first of those that say as much; None without any."""
    words = opened(normalize(text))
    is_of_robot = not ROBOT.isdisjoint(words) or any(pair in MEANT for pair in pairwise(words))
    found = Counter(_said(words, lexicon()["robot" if is_of_robot else "speaker"]))
    return found.most_common(1)[0][0] if found else None


@cache
def lexicon() -> Mapping[str, Mapping[Phrase, Sentiment]]:
    """The sentiments of phrases, of the speaker and of the robot. Raises AuthoringError."""
    root = load_toml(LEXICON)
    return {
        whose: {
            tuple(phrase.split()): Sentiment(name)
            for name in table.data
            for phrase in table.string(name).replace("\n", " ").split(",")
        }
        for whose, table in (("speaker", root.table("speaker")), ("robot", root.table("robot")))
    }


def _said(words: Sequence[str], known: Mapping[Phrase, Sentiment]) -> Iterator[Sentiment]:
    """The sentiments of the phrases of a sentence, from left to right, the longest first."""
    longest, at = max(map(len, known)), 0
    while at < len(words):
        sizes = range(min(longest, len(words) - at), 0, -1)
        size = next((size for size in sizes if tuple(words[at : at + size]) in known), 0)
        if size:
            one = known[tuple(words[at : at + size])]
            within = CLOSELY if one is Sentiment.KIND else DENIED_WITHIN
            is_denied = not DENIALS.isdisjoint(words[max(at - within, 0) : at])
            if not is_denied:
                yield one
            elif one in OPPOSITE:
                yield OPPOSITE[one]
        at += size or 1
