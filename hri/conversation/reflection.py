"""A sentence turned around: what "my" is to who speaks is "your" to who answers.

The oldest trick of a machine that listens (Weizenbaum, "ELIZA", 1966), and what people do who want
to show that they did: they say again what they heard.
"""

from __future__ import annotations

from collections.abc import Sequence

from hri.conversation.dialog_act import DIRECTIVES, ORDERS, ROBOT, TOLD_VERBS, opened
from hri.conversation.sentiment import DENIALS
from hri.speech.grammar.words import normalize

FEWEST_WORDS, MOST_WORDS = 3, 9
"""Words of a statement that is said again: of a longer one nobody repeats every word."""
MOST_OF_DEED = 7
"""Words of what is to be done."""
# fmt: off
TURNED = {
    "am": "are", "i": "you", "i'd": "you'd", "i'll": "you'll", "i'm": "you're",
    "i've": "you've", "me": "you", "mine": "yours", "my": "your", "myself": "yourself",
    "our": "your", "ours": "yours", "ourselves": "yourselves", "us": "you", "we": "you",
    "we'd": "you'd", "we'll": "you'll", "we're": "you're", "we've": "you've", "you": "me",
    "you'd": "I'd", "you'll": "I'll", "you're": "I'm", "you've": "I've", "your": "my",
    "yours": "mine", "yourself": "myself",
}
TOLD_OF = frozenset((
    "everybody", "everyone", "he", "he's", "her", "his", "i", "i'd", "i'll", "i'm", "i've",
    "mine", "my", "nobody", "our", "she", "she's", "somebody", "someone", "their", "they",
    "they're", "today", "tomorrow", "tonight", "we", "we'll", "we're", "we've", "yesterday",
))
"""What begins so is about people; the rest is mostly a remark about what is at hand."""
CLAUSES = frozenset((
    "and", "because", "but", "don't", "he", "i", "i'm", "if", "it's", "or", "see", "she", "so",
    "that's", "then", "they", "until", "when",
))
"""What is to be done ends before these."""
SECOND_CLAUSES = frozenset((
    "bye", "do", "he", "he's", "i", "i'll", "i'm", "it's", "look", "remember", "she", "she's",
    "they", "they're", "we", "we're", "what",
))
"""Behind the first words these begin something new."""
NO_DEEDS = frozenset((
    "be", "don't", "go", "hold", "keep", "lemme", "let", "look", "mind", "quit", "wait",
))
"""First words of orders of which "I don't know how to" is odd."""
AT_HAND = frozenset(("a", "all", "it", "one", "that", "the", "there", "these", "this", "those"))
"""What begins so is a remark about something that both see."""
FILLERS = frozenset((
    "basically", "just", "kinda", "like", "literally", "please", "really",
))
ASKING = (
    *((word, "you") for word in sorted(DIRECTIVES)),
    ("i", "want", "you", "to"), ("i", "need", "you", "to"),
    ("you", "have", "to"), ("you", "need", "to"), ("you", "gotta"), ("you", "should"),
)
"""What people begin with who want something done."""
UNTURNED = ROBOT - {"your"} | {"how", "what", "where"}
"""In the middle "you" may be who acts, whom the turned word would not fit."""
SOUNDS = frozenset(("hm", "hmm", "huh", "phew", "ugh", "uh", "um", "wow"))
# fmt: on


def echo_of(text: str, name: str = "") -> str:
    """What someone says of themselves or of others, turned around: "your dog ate my shoe".

    Empty where that would be odd: it is too long, too short, about the robot, or denies something.
    """
    words = opened(normalize(text), name)
    if words[:1] == ["because"]:
        words = words[1:]
    is_named = name.lower() in normalize(text)[1:-1]
    if (
        is_named
        or not FEWEST_WORDS <= len(words) <= MOST_WORDS
        or not (ROBOT | DENIALS).isdisjoint(words)
    ):
        return ""
    start = 3 if words[1] in ("said", "says") else 2
    if not SECOND_CLAUSES.isdisjoint(words[start:]):
        return ""  # "He's laughing, do it again" says two things.
    tells = words[0] in TOLD_OF or (words[0] not in AT_HAND and words[1] in TOLD_VERBS)
    return turned([word for word in words if word not in SOUNDS]) if tells else ""


def deed_of(text: str, name: str = "") -> str:
    """What is to be done, turned around: of "can you close your eyes" it is "close my eyes".

    Empty where no order shows it.
    """
    words = opened(normalize(text), name)
    begun = next((start for start in ASKING if tuple(words[: len(start)]) == start), ())
    deed = words[len(begun) :]
    end = next((n for n, word in enumerate(deed) if word in CLAUSES), len(deed))
    deed = [word for word in deed[:end] if word not in FILLERS]
    is_fit = 0 < len(deed) <= MOST_OF_DEED and deed[0] not in NO_DEEDS
    if not is_fit or not (begun or deed[0] in ORDERS):
        return ""
    return "" if UNTURNED & set(deed[:-1]) else turned(deed)


def turned(words: Sequence[str]) -> str:
    """The same words, from the other side."""
    found = []
    for number, word in enumerate(words):
        before = words[number - 1] if number else ""
        is_was = word == "was" and before in ("i", "we")
        found.append("were" if is_was else TURNED.get(word, word))
    return " ".join(found)
