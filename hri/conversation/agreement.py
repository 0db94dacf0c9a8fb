"""Whether words and gestures agree with the face: no joy in fear, no pity with a grin."""

from __future__ import annotations

import re
from collections.abc import Mapping

from hri.conversation.sentiment import Sentiment, sentiment_of

PLEASANT = frozenset(("happy", "excited", "amazed"))
UNPLEASANT = frozenset((
    "angry", "annoyed", "despaired", "disappointed", "disgusted", "furious", "guilty", "horrified",
    "pleading", "rejected", "sad", "scared", "vulnerable",
))  # fmt: skip
"""Expressions that glad words contradict, and those that words of sorrow contradict."""
MERRY = frozenset(("beam", "bounce", "glow", "laugh", "secretSmile", "wink"))
"""Gestures that an unpleasant expression contradicts."""
GLAD = (Sentiment.GLAD, Sentiment.KIND)
SORRY: Mapping[Sentiment | None, str] = {
    Sentiment.SAD: "sad",
    Sentiment.WEARY: "sad",
    Sentiment.UNKIND: "sad",
    Sentiment.AFRAID: "scared",
    Sentiment.ANGRY: "annoyed",
}
"""The expressions of words of sorrow."""
_SENTENCE = re.compile(r"[^.!?]+[.!?]*")


def face_for(words: str, shown: str) -> str:
    """The expression that words ask for; "" where the one that is shown agrees with them.

    Questions say nothing of a feeling. Of glad and sorry words together any face is right.
    """
    said = [sentiment_of(one) for one in _SENTENCE.findall(words) if not one.endswith("?")]
    sorry = [SORRY[one] for one in said if one in SORRY]
    is_glad = any(one in GLAD for one in said)
    if shown in PLEASANT and sorry and not is_glad:
        return sorry[0]
    return "happy" if shown in UNPLEASANT and is_glad and not sorry else ""


def suits(gesture: str, shown: str) -> bool:
    """Whether a gesture may be made while an expression is shown."""
    return not (gesture in MERRY and shown in UNPLEASANT)
