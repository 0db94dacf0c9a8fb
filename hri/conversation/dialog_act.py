"""What a sentence does that no rule allows: it states something, asks, or wants something done.

These are the coarse dialog acts of Jurafsky, Shriberg and Biasca, "Switchboard SWBD-DAMSL
Shallow-Discourse-Function Annotation" (1997): statement, question and action directive. The first
words show which it is; that is enough for an answer that is honest about not knowing more.
"""

from __future__ import annotations

from enum import Enum, auto

from hri.speech.grammar.words import normalize

LEAST_WORDS = 3
"""Of fewer, what they tell is rather a name, or half a sentence."""
OPENERS = frozenset(
    ("and", "but", "huh", "hey", "like", "oh", "okay", "so", "ugh", "well", "yeah", "yo")
)
"""Words before those that count."""
QUESTION_WORDS = frozenset(
    ("how", "what", "what's", "where", "which", "who", "who's", "whose", "why")
)
# fmt: off
AUXILIARIES = frozenset((
    "am", "are", "aren't", "can", "could", "did", "didn't", "do", "does", "doesn't", "don't",
    "has", "have", "is", "isn't", "may", "might", "must", "shall", "should", "was", "were", "will",
    "won't", "would",
))
PEOPLE = frozenset(("he", "i", "people", "she", "they", "we", "you"))
"""Behind "do", "don't" or "have" they make a question of an order."""
TELLERS = frozenset((
    "because", "everybody", "everyone", "he", "her", "he's", "his", "i", "i'm", "i've", "if", "it",
    "it's", "last", "mine", "my", "nobody", "our", "people", "she", "she's", "some", "somebody",
    "someone", "that", "that's", "the", "their", "there", "they", "this", "today", "tomorrow", "we",
    "we're", "when", "yesterday",
))
# fmt: on
"""First words of a statement."""
DIRECTIVES = frozenset(("can", "could", "will", "would"))
"""Before "you", "I" or "we" they ask for something."""


class DialogAct(Enum):
    """What a sentence does."""

    STATEMENT = auto()
    QUESTION = auto()
    DIRECTIVE = auto()


def dialog_act(text: str) -> DialogAct | None:
    """What a sentence does; None where its first words do not show it."""
    words = normalize(text)
    while words and words[0] in OPENERS:
        words = words[1:]
    if len(words) < 2:
        return None
    first, second = words[0], words[1]
    if first in DIRECTIVES and second in ("i", "we", "you"):
        return DialogAct.DIRECTIVE
    if first == "let's" or words[:3] in (["i", "want", "you"], ["i", "need", "you"]):
        return DialogAct.DIRECTIVE
    if first in QUESTION_WORDS or (first in AUXILIARIES and _may_ask(first, second)):
        return DialogAct.QUESTION
    if first == "when" and second in AUXILIARIES:
        return DialogAct.QUESTION
    return DialogAct.STATEMENT if first in TELLERS and len(words) >= LEAST_WORDS else None


def _may_ask(first: str, second: str) -> bool:
    """Whether two words begin a question: "do you", not "do it", which is an order."""
    return first not in ("do", "don't", "have") or second in PEOPLE
