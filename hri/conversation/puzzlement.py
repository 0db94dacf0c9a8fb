"""What the robot answers to a sentence that it does not understand.

Which kind of answer it is depends on what is known of the sentence: what it seems to be about,
which of its words are strange, whether it was hard to hear, and how many before it were not
understood either. The same arguments give the same answer. How each kind is worded is another
matter, see [unasked] of a companion's replies.
"""

from __future__ import annotations

import math
import re
from collections import deque
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from hri.conversation.dialog_act import DialogAct
from hri.conversation.sentiment import Sentiment

UNCLEAR_REASONS = ("low confidence", "unlike the sound")
OFFER_AT = 3
"""How many sentences in a row were not understood when it offers what can be said."""
MOST_TO_STRANGERS = 3
"""Answers in a row to a voice that may be meant for others: a radio must not be talked to."""
ROW_SECONDS = 60.0
"""Sentences that are further apart are not in a row."""
MOST_OF_TOPIC = 6
"""Words of a typed sentence whose topic one of them may show."""
MANY_WORDS = 5
"""A typed sentence of so many that shows no act is rather told than asked for."""
FEW_WORDS = 4
"""A sentence of more words does not hang on the one that it does not know."""
MOST_REMEMBERED = 200
"""Commands that were offered that are remembered."""


class Kind(StrEnum):
    """How it answers. Each is a key of [unasked] in replies.toml."""

    ANSWERS = "answers"
    """A question is open, and it says what would answer it: {one} or {other}.

    Of several, {one} is all but the last, with `", "` between: the text has its quotes around it.
    """
    CAUGHT = "caught"
    """It got the subject: {topic}."""
    NEAR = "near"
    """It knows a sentence that is like it: {nearest}."""
    TOLD = "told"
    """Someone says something, in words that it does not follow."""
    NOTED = "noted"
    """The same in a few words, that go on with what was said."""
    CORRECTED = "corrected"
    """Someone sets right what was said or done before."""
    TOLD_OF = "told_of"
    """The same, of themselves or of others; it says it again: {echo}."""
    TOLD_OF_ME = "told_of_me"
    """Someone says something of the robot."""
    TOLD_SAD = "told_sad"
    """What they say is sad, or went wrong."""
    TOLD_GLAD = "told_glad"
    TOLD_ANGRY = "told_angry"
    TOLD_AFRAID = "told_afraid"
    TOLD_WEARY = "told_weary"
    PRAISED = "praised"
    INSULTED = "insulted"
    INTRODUCED = "introduced"
    """Someone says who they are, or who another one is: {person}."""
    ASKED = "asked"
    """Someone asks what it does not know."""
    ASKED_OF_ME = "asked_of_me"
    """They ask about the robot."""
    ASKED_OF_YOU = "asked_of_you"
    """They ask what to do, or about themselves."""
    ASKED_WHERE = "asked_where"
    ASKED_WHY = "asked_why"
    ASKED_FOR = "asked_for"
    """Someone wants what it cannot do."""
    FORBIDDEN = "forbidden"
    """Someone says not to do something."""
    ASKED_FOR_DEED = "asked_for_deed"
    """The same, and it knows what: {deed}."""
    STRANGE_WORD = "strange_word"
    """It does not know {word}."""
    STRANGE = "strange"
    """It heard words, and knows none of them."""
    REPHRASE = "not_understood"
    """It knows the words, and not the sentence."""
    UNCLEAR = "unclear"
    """It did not hear well."""
    TOO_QUIET = "too_quiet"
    """The voice was too quiet."""
    NO_QUESTION = "no_question"
    """An answer, and nothing was asked."""
    OFFER = "offer"
    """It says what can be said: {one} or {other}."""


FEELINGS: Mapping[Sentiment, Kind] = {
    Sentiment.SAD: Kind.TOLD_SAD,
    Sentiment.GLAD: Kind.TOLD_GLAD,
    Sentiment.ANGRY: Kind.TOLD_ANGRY,
    Sentiment.AFRAID: Kind.TOLD_AFRAID,
    Sentiment.WEARY: Kind.TOLD_WEARY,
    Sentiment.KIND: Kind.PRAISED,
    Sentiment.UNKIND: Kind.INSULTED,
}
REMARKS: Mapping[Sentiment | None, Kind] = {
    Sentiment.SAD: Kind.TOLD_OF_ME,
    Sentiment.ANGRY: Kind.TOLD_OF_ME,
    Sentiment.AFRAID: Kind.TOLD_OF_ME,
    Sentiment.GLAD: Kind.PRAISED,
    Sentiment.KIND: Kind.PRAISED,
    Sentiment.UNKIND: Kind.TOLD_OF_ME,
}
"""A positive or negative remark is mostly about the robot's last action."""
TELLING = frozenset(
    (
        Kind.CORRECTED,
        Kind.INTRODUCED,
        Kind.NOTED,
        Kind.TOLD,
        Kind.TOLD_OF,
        Kind.TOLD_OF_ME,
        *FEELINGS.values(),
    )
)
QUESTIONS: Mapping[DialogAct | None, Kind] = {
    DialogAct.QUESTION: Kind.ASKED,
    DialogAct.QUESTION_OF_ROBOT: Kind.ASKED_OF_ME,
    DialogAct.QUESTION_OF_SPEAKER: Kind.ASKED_OF_YOU,
    DialogAct.QUESTION_WHERE: Kind.ASKED_WHERE,
    DialogAct.QUESTION_WHY: Kind.ASKED_WHY,
}


@dataclass(frozen=True, slots=True)
class Puzzle:
    """A sentence that was not understood, and what is known of it."""

    reason: str
    """As `Rejection` has it."""
    is_typed: bool = False
    is_addressed: bool = True
    """Whether it was said to the robot: with its name, with a look, or in an open talk."""
    goes_on: bool = False
    """Whether it was typed a short while after something that was answered."""
    is_turned_to: bool = False
    """Whether there is no doubt about that: it was typed, or whoever said it looks at the robot."""
    is_quiet: bool = False
    """Whether the voice was very quiet."""
    topic: str = ""
    """What it seems to be about, as it is said: "turning"."""
    nearest: str = ""
    """A sentence that is like it."""
    meant: str = ""
    """A sentence that it most likely says in other words; it must be said in these."""
    act: DialogAct | None = None
    """What it does; known only of a typed sentence, as the next four are."""
    sentiment: Sentiment | None = None
    """What it says of a feeling."""
    person: str = ""
    """Who is introduced by it."""
    echo: str = ""
    """What it states, from the robot's side."""
    deed: str = ""
    """What it asks for, from the robot's side."""
    words: int = 0
    """How many it has."""
    strange: Sequence[str] = ()
    """Its words that are not in the grammar; known only of a typed sentence."""
    answers: Sequence[str] = ()
    """What would answer the question that is open."""
    is_answer: bool = False
    """Whether it would answer a question, and none is open."""


@dataclass(frozen=True, slots=True)
class Answer:
    """How it answers, and what fills in the words."""

    kind: Kind
    facts: Mapping[str, str] = field(default_factory=dict)
    offered: tuple[str, ...] = ()
    """The commands that it names."""


def is_meant(puzzle: Puzzle, row: int) -> bool:
    """Whether a sentence deserves an answer; `row` counts it and those before it, from 1."""
    if puzzle.act is DialogAct.CALL:
        return False
    if not puzzle.is_addressed or puzzle.reason in ("no speech", "robot speaking"):
        return False
    if puzzle.reason == "not now" and not puzzle.is_typed:
        return False  # People also say "yes" and "sure" to others.
    return puzzle.is_turned_to or row <= MOST_TO_STRANGERS


def decide(
    puzzle: Puzzle, row: int, commands: Sequence[str], offered: Collection[str] = ()
) -> Answer | None:
    """The answer to a sentence; None when it was hardly said to the robot.

    `row` counts this sentence and those before it that were not understood, from 1; `commands` are
    examples of what can be said, and `offered` those that were named before.
    """
    if not is_meant(puzzle, row):
        return None
    if puzzle.answers:
        *first, last = puzzle.answers
        return Answer(Kind.ANSWERS, {"one": '", "'.join(first) or last, "other": last})
    if puzzle.meant:
        return Answer(Kind.NEAR, {"nearest": puzzle.meant})
    if puzzle.act is not DialogAct.DIRECTIVE and (of_act := _of_act(puzzle)) is not None:
        return of_act
    if row % OFFER_AT == 0 and not puzzle.deed and len(named := _unheard(commands, offered)) > 1:
        return Answer(Kind.OFFER, {"one": named[0], "other": named[-1]}, named)
    if puzzle.is_answer:
        return Answer(Kind.NO_QUESTION)
    if puzzle.is_quiet:
        return Answer(Kind.TOO_QUIET)
    if _is_short(puzzle) and puzzle.topic:
        return Answer(Kind.CAUGHT, {"topic": puzzle.topic})
    if _is_short(puzzle) and puzzle.nearest:
        return Answer(Kind.NEAR, {"nearest": puzzle.nearest})
    if puzzle.is_typed:
        return _of_typed(puzzle)
    # Of a voice it cannot be known which it was: bad to hear, or of words that it does not know.
    return Answer(Kind.UNCLEAR if puzzle.reason in UNCLEAR_REASONS and row == 1 else Kind.STRANGE)


def _of_act(puzzle: Puzzle) -> Answer | None:
    """The answer to the act of a typed sentence, regardless of its words."""
    if puzzle.person:
        return Answer(Kind.INTRODUCED, {"person": puzzle.person})
    if puzzle.act in QUESTIONS:
        return Answer(QUESTIONS[puzzle.act])
    if puzzle.act is DialogAct.PROHIBITION:
        return Answer(Kind.FORBIDDEN)
    if puzzle.act is DialogAct.REMARK:
        return Answer(REMARKS.get(puzzle.sentiment, Kind.TOLD))
    # "Great, now the opposite" is not good news.
    is_meant = puzzle.act is not None or puzzle.sentiment not in (Sentiment.GLAD, Sentiment.KIND)
    if puzzle.sentiment is not None and is_meant:
        return Answer(FEELINGS[puzzle.sentiment])
    if puzzle.act is DialogAct.CORRECTION:
        return Answer(Kind.CORRECTED)
    if puzzle.act is DialogAct.STATEMENT_OF_ROBOT:
        return Answer(Kind.TOLD_OF_ME)
    if puzzle.act is DialogAct.STATEMENT:
        return Answer(Kind.TOLD_OF, {"echo": puzzle.echo}) if puzzle.echo else Answer(Kind.TOLD)
    if puzzle.is_typed and not puzzle.topic and puzzle.words >= MANY_WORDS:
        return Answer(Kind.TOLD)
    return None


def _is_short(puzzle: Puzzle) -> bool:
    """Whether a word or two may show what a sentence is about: in a long one they do not."""
    return not puzzle.is_typed or puzzle.words <= MOST_OF_TOPIC


def _of_typed(puzzle: Puzzle) -> Answer:
    if puzzle.act is DialogAct.DIRECTIVE:
        facts = {"deed": puzzle.deed} if puzzle.deed else {}
        return Answer(Kind.ASKED_FOR_DEED if facts else Kind.ASKED_FOR, facts)
    if puzzle.goes_on and len(puzzle.strange) <= 1:
        return Answer(Kind.NOTED)
    if len(puzzle.strange) == 1 and puzzle.words <= FEW_WORDS:
        return Answer(Kind.STRANGE_WORD, {"word": puzzle.strange[0]})
    return Answer(Kind.STRANGE if puzzle.strange else Kind.REPHRASE)


def _unheard(commands: Sequence[str], offered: Collection[str]) -> tuple[str, ...]:
    """Two commands, or the only one: of those that were not named yet, else of all."""
    new = [command for command in commands if command not in offered]
    left = new if len(new) >= min(2, len(commands)) else list(commands)
    # Those that stand side by side are alike: forward and left.
    return tuple(dict.fromkeys((left[0], left[len(left) // 2]))) if left else ()


def as_said(sentence: str) -> str:
    """A sentence of a grammar, which has only small letters, as it is written for people."""
    return re.sub(r"\bi\b", "I", sentence)


class Puzzlement:
    """Counts sentences not understood, and remembers the commands it offered."""

    def __init__(self) -> None:
        self.row = 0
        """Sentences in a row that were not understood."""
        self.last = -math.inf
        """Seconds of the clock, of the last of them that it answered."""
        self._offered: deque[str] = deque(maxlen=MOST_REMEMBERED)

    def understand(self) -> None:
        """Something was understood: the row ends."""
        self.row = 0

    def answer(self, puzzle: Puzzle, commands: Sequence[str], now: float) -> Answer | None:
        """The answer to a sentence at a time, see `decide`; it counts for the row."""
        row = self.row + 1 if now - self.last < ROW_SECONDS else 1
        answer = decide(puzzle, row, commands, self._offered)
        if answer is None:
            return None
        if answer.kind not in TELLING:  # Who has something to say is not at a loss for words.
            self.row = row
        self.last = now
        self._offered.extend(answer.offered)
        return answer
