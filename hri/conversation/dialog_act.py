"""What a sentence does that no rule allows: it states something, asks, or wants something done.

These are the coarse dialog acts of Jurafsky, Shriberg and Biasca, "Switchboard SWBD-DAMSL
Shallow-Discourse-Function Annotation" (1997): statement, question and action directive; what a
statement or a question is about makes the finer ones. The first words show which it is; that is
enough for an answer that is honest about not knowing more.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, auto

from hri.conversation.first_names import first_names
from hri.speech.grammar.words import normalize

MOST_COMING = 3
"""Of more words, "come on" only opens the rest."""
LEAST_WORDS = 3
"""Of fewer, what they tell is rather a name, or half a sentence."""
# fmt: off
OPENERS = frozenset((
    "actually", "alright", "and", "anyway", "aw", "but", "dude", "ha", "haha", "hey", "hm",
    "hmm", "honestly", "huh", "just", "like", "look", "man", "no", "nope", "oh", "ok", "okay",
    "ooh", "please", "right", "robot", "so", "sorry", "then", "ugh", "uh", "um", "wait", "well",
    "whoa", "wow", "yeah", "yep", "yes", "yo",
))
"""Words before those that count."""
QUESTION_WORDS = frozenset((
    "how", "how's", "what", "what'd", "what's", "where", "where'd", "where's", "which", "who",
    "who's", "whose", "why", "why'd", "why's",
))
AUXILIARIES = frozenset((
    "am", "are", "aren't", "can", "can't", "could", "couldn't", "did", "didn't", "do", "does",
    "doesn't", "don't", "had", "has", "have", "haven't", "is", "isn't", "may", "might", "must",
    "shall", "should", "was", "wasn't", "were", "will", "won't", "would", "wouldn't",
))
PEOPLE = frozenset(("he", "i", "people", "she", "they", "we", "you"))
"""Behind "do", "don't" or "have" they make a question of an order."""
ROBOT = frozenset(("you", "you'd", "you'll", "you're", "you've", "your", "yours"))
TELLERS = frozenset((
    "a", "all", "because", "cause", "every", "everybody", "everyone", "he", "he's", "her",
    "his", "i", "i'd", "i'll", "i'm", "i've", "if", "it", "it'll", "it's", "last", "mine", "my",
    "nobody", "nothing", "one", "our", "people", "she", "she's", "some", "somebody", "someone",
    "something", "sometimes", "that", "that's", "the", "their", "there", "there's", "these",
    "they", "they're", "this", "those", "today", "tomorrow", "tonight", "we", "we'll", "we're",
    "we've", "when", "yesterday",
))
"""First words of a statement."""
TOLD_VERBS = frozenset((
    "asked", "broke", "called", "came", "cried", "did", "didn't", "died", "doesn't", "fell",
    "found", "gave", "got", "had", "has", "hates", "hit", "is", "isn't", "keeps", "left",
    "likes", "lost", "loves", "made", "moved", "put", "said", "says", "thinks", "told", "took",
    "wants", "was", "wasn't", "went", "will", "won", "won't",
))
"""Behind a name they make a statement: "tyler said"."""
ORDERS = frozenset((
    "act", "add", "answer", "ask", "back", "be", "beep", "bend", "blink", "breathe", "bring",
    "buy", "call", "carry", "catch", "change", "chase", "check", "clap", "clean", "climb",
    "close", "come", "cook", "cover", "crawl", "creep", "dance", "describe", "do", "don't",
    "draw", "drive", "drop", "entertain", "explain", "face", "fetch", "fight", "find", "fix",
    "flap", "fly", "follow", "get", "gimme", "give", "go", "grab", "guard", "guess", "hand",
    "help", "hide", "hold", "hug", "hum", "imagine", "jump", "keep", "kiss", "lay", "lead",
    "learn", "leave", "lemme", "let", "lie", "lift", "light", "listen", "lock", "make", "mind",
    "move", "name", "nod", "open", "order", "park", "pass", "pet", "pick", "play", "plug",
    "pretend", "promise", "pull", "push", "put", "quit", "race", "read", "record", "remember",
    "remind", "repeat", "ring", "roll", "run", "save", "say", "scare", "scoot", "search", "send",
    "set", "shake", "show", "sing", "sit", "skip", "slow", "smile", "spin", "stand", "start",
    "stay", "stick", "stomp", "swim", "switch", "take", "talk", "teach", "tell", "think", "throw",
    "touch", "translate", "try", "turn", "twirl", "wait", "wake", "walk", "wash", "watch", "wave",
    "wiggle", "wink", "work", "write",
))
"""First words of an order."""
ADVICE = frozenset(("should", "shall", "am", "do", "did", "was"))
"""Before "i" or "we" they ask what only who asks can know."""
WISHES = frozenset(("ever", "like", "mind", "rather", "wanna", "want"))
"""Behind "would you" they ask what it likes."""
NO_PLURALS = frozenset(("as", "his", "less", "ours", "this", "us", "yes", "yours"))
CALLED = frozenset((
    "babe", "dad", "daddy", "grandma", "grandpa", "guys", "mama", "miss", "mom", "mommy", "mum",
    "nana", "papa",
))
"""Whom people call by their first word; never the robot."""
KNOWING = frozenset((
    "about", "ask", "asked", "guess", "is", "know", "like", "remember", "said", "say", "see",
    "show", "tell", "that's", "think", "to", "told", "understand", "was", "wonder",
))
"""Behind these words a question is a part of what is said."""
INVERTED = frozenset((
    "are", "can", "could", "did", "do", "does", "have", "is", "may", "should", "will", "would",
))
"""Before a person they begin a question within a sentence."""
# fmt: on
MUSTS = frozenset(("gotta", "have", "need", "should"))
"""Behind "you" they make an order."""
CALLING = AUXILIARIES | QUESTION_WORDS | PEOPLE | {"i'm", "it", "look"}
"""What follows such a word where it calls: "mom, where's my cup"."""
WONDERS = frozenset(("ever", "got", "think", "remember", "wanna", "want"))
"""Behind "you" they ask."""
TAGS = frozenset(("huh", "right"))
"""At the end they make a question of a statement: "it's nothing, right"."""
TAG_VERBS = frozenset(("aren't", "didn't", "doesn't", "don't", "isn't", "wasn't", "won't"))
TAG_PEOPLE = frozenset(("he", "i", "it", "she", "they", "we"))
"""Behind one of TAG_VERBS they do the same: "it's red, isn't it"."""
AMOUNTS = frozenset(("far", "long", "many", "many's", "much", "old"))
"""Behind "how" they ask within a sentence."""
DENYING = frozenset(("can't", "couldn't", "didn't", "haven't", "won't", "wouldn't"))
"""Without a person behind them someone leaves out the "i": "can't sleep"."""
NAMED = ((ORDERS | QUESTION_WORDS) - TOLD_VERBS - AUXILIARIES).union(
    ("brush", "don't", "drink", "eat", "finish", "hurry", "i", "i'm", "shut", "stop", "we", "you")
)
"""What follows a first name where it calls."""
CORRECTING = (("actually",), ("i", "meant"), ("nah",), ("no",), ("nope",), ("not",), ("wait", "no"))
"""What a correction begins with."""
NO_CORRECTIONS = frozenset(("doubt", "idea", "one", "problem", "way", "wonder", "worries"))
"""Behind "no" they make something else of it."""
DIRECTIVES = frozenset(("can", "could", "will", "would"))
"""Before "you", "I" or "we" they ask for something."""


class DialogAct(Enum):
    """What a sentence does."""

    STATEMENT = auto()
    STATEMENT_OF_ROBOT = auto()
    REMARK = auto()
    """It says something of what is at hand: "that was funny"."""
    QUESTION = auto()
    QUESTION_OF_ROBOT = auto()
    QUESTION_OF_SPEAKER = auto()
    """It asks for advice, or for something only the speaker can know."""
    QUESTION_WHERE = auto()
    QUESTION_WHY = auto()
    DIRECTIVE = auto()
    PROHIBITION = auto()
    CORRECTION = auto()
    """It sets right what was said or done before: "no, the blue one"."""
    CALL = auto()
    """It is said to someone else, whom it names."""


UNSETTLED = (None, DialogAct.STATEMENT, DialogAct.STATEMENT_OF_ROBOT, DialogAct.REMARK)
"""What may end in a question."""


def act_of(text: str, name: str = "") -> DialogAct | None:
    """What a sentence does; None where its first words do not show it.

    `name` is that of the robot, which says nothing of it.
    """
    every = normalize(text)
    words = opened(every, name)
    if _is_call(words):
        return DialogAct.CALL
    act = _act(words)
    if act in UNSETTLED and (start := _last_question(words)):
        return _act(words[start:]) or act
    if act in UNSETTLED and _is_correction(every):
        return DialogAct.CORRECTION
    is_tagged = act is not DialogAct.STATEMENT_OF_ROBOT and _has_tag(words)
    return DialogAct.QUESTION if act in UNSETTLED and is_tagged else act


def _has_tag(words: Sequence[str]) -> bool:
    """Whether a statement ends in what asks for a yes: "isn't it"."""
    if len(words) <= LEAST_WORDS:
        return False
    verb, last = words[-2:]
    return last in TAGS or (verb in TAG_VERBS and last in TAG_PEOPLE)


def _is_correction(words: Sequence[str]) -> bool:
    """Whether the first words take something back: "wait no it's the thin kind"."""
    if len(words) < LEAST_WORDS or words[1] in NO_CORRECTIONS:
        return False
    return any(tuple(words[: len(first)]) == first for first in CORRECTING)


def _is_call(words: Sequence[str]) -> bool:
    """Whether someone else is called: "mom, can I have some juice", "leo stop kicking"."""
    if len(words) < LEAST_WORDS:
        return False
    if words[0] in CALLED:
        return words[1] in CALLING
    asks = words[1] in INVERTED and words[2] in PEOPLE
    return words[0] in first_names() and (asks or words[1] in NAMED)


def _act(words: Sequence[str]) -> DialogAct | None:
    """What a clause does, by its first words."""
    if len(words) < 2:
        return None
    first, second = words[0], words[1]
    is_wish = second == "you" and list(words[2:3]) and words[2] in WISHES
    asks = first in DIRECTIVES and second in ("i", "we", "you") and not is_wish
    is_kind = list(words[:2]) in (["don't", "mind"], ["don't", "worry"])
    is_dare = list(words[:3]) == ["don't", "you", "dare"]
    may_ask = _may_ask(first, second) and not is_dare
    if first in ("don't", "never", "quit") and not is_kind and not may_ask:
        return DialogAct.PROHIBITION
    if asks or _is_order(words):
        return DialogAct.DIRECTIVE
    if first in QUESTION_WORDS or (first in AUXILIARIES and _may_ask(first, second)):
        return _question(words)
    if first == "when" and second in AUXILIARIES:
        return DialogAct.QUESTION
    if len(words) < LEAST_WORDS:
        return None
    if first in ROBOT:
        asks = _is_elided(words) or words[-1] in TAGS
        return DialogAct.QUESTION_OF_ROBOT if asks else DialogAct.STATEMENT_OF_ROBOT
    if first in ("that", "that's"):
        return DialogAct.REMARK
    is_told = first in TELLERS or first in DENYING or second in TOLD_VERBS
    return DialogAct.STATEMENT if is_told else None


def _last_question(words: Sequence[str]) -> int:
    """Where the last clause begins if it asks: "last question, what do you like"; 0 for none.

    "I know what you did" asks nothing, and no more does the end of "you like it, don't you".
    """
    for start in range(len(words) - LEAST_WORDS, 0, -1):
        before, first, second = words[start - 1 : start + 2]
        is_short = first != "who's" and "'" in first
        is_amount = first == "how" and second in AMOUNTS
        asks = first in QUESTION_WORDS and (is_short or is_amount or second in AUXILIARIES)
        asks = asks or (first in INVERTED and second in PEOPLE)
        if asks and before not in KNOWING | QUESTION_WORDS:
            return start
    return 0


def opened(words: Sequence[str], name: str = "") -> list[str]:
    """The words of a sentence without those before the ones that count, and without the name."""
    own = name.lower()
    left = [word for word in words if word != own]
    while left and (left[0] in OPENERS or (left[:2] == ["come", "on"] and len(left) > MOST_COMING)):
        left = left[1 if left[0] in OPENERS else 2 :]
    return left


def _is_order(words: Sequence[str]) -> bool:
    """Whether something is to be done: "let's", "i want you to", or a verb first."""
    if words[0] == "let's" or words[:3] in (["i", "want", "you"], ["i", "need", "you"]):
        return True
    if words[0] == "you" and words[1] in MUSTS:
        return True
    return words[0] in ORDERS and not _may_ask(words[0], words[1])


def _is_elided(words: Sequence[str]) -> bool:
    """Whether "do" is left out: "you ever get bored", "you know any jokes"."""
    if words[0] != "you":
        return False
    return words[1] in WONDERS or (words[1] == "know" and words[2] in ("any", *QUESTION_WORDS))


def _may_ask(first: str, second: str) -> bool:
    """Whether two words begin a question: "do you", not "do it", which is an order."""
    if first in DENYING:
        return second in PEOPLE
    if first in AUXILIARIES:
        is_plural = second.endswith("s") and second not in NO_PLURALS
        return first not in ("do", "don't", "have") or second in PEOPLE or is_plural
    return False


def _question(words: Sequence[str]) -> DialogAct:
    first, second = words[0], words[1]
    if first.startswith("where"):
        return DialogAct.QUESTION_WHERE
    asks_advice = first in ADVICE and second in ("i", "we")
    if asks_advice or {"should", "i"} <= set(words[:4]) or {"do", "i"} <= set(words[1:3]):
        return DialogAct.QUESTION_OF_SPEAKER
    if not ROBOT.isdisjoint(words[1:3]):
        return DialogAct.QUESTION_OF_ROBOT
    return DialogAct.QUESTION_WHY if first.startswith("why") else DialogAct.QUESTION
