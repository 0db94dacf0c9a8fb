"""Whose turn it is: which rules of a grammar may be heard at a moment.

Rules are marked in their comments (see `hri.speech.grammar.doc_comments`): while the robot speaks
only those with `@interrupts` count; `@answer` counts while a question is open; and where any rule
is marked `@wake`, the others count after one of those, as long as the talk goes on. A rule marked
`@after` counts soon after one of the commands that it names, one marked `@anywhere` among other
words only when they are said to the robot.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hri.hal.recognizer import Segment
from hri.speech.grammar import Grammar
from hri.speech.grammar.follow_ups import Followed, out_of_place

QUESTION = "question.open"
"""Slot of the board that is true while an answer is awaited."""
FOLLOW_UP = 8.0
"""Seconds after something was heard or said in which no wake word is needed."""

DOUBTED_FOR = 20.0
"""Seconds in which the same answer, said again, is believed more."""
NEARLY = 0.5
"""Share of the strictness that an answer must reach to count when it is said again."""


@dataclass(frozen=True, slots=True)
class Doubt:
    """An answer that was nearly taken."""

    text: str
    confidence: float
    time: float
    """When it ended, in seconds."""

    def and_again(self, text: str, confidence: float, strictness: float) -> float:
        """The confidence in what is said after it; who says the same again is believed more.

        Both are taken as independent witnesses (noisy or; Pearl, Probabilistic Reasoning in
        Intelligent Systems, 1988, section 4.3), unless one of them says next to nothing.
        """
        if text != self.text or min(confidence, self.confidence) < NEARLY * strictness:
            return confidence
        return 1.0 - (1.0 - self.confidence) * (1.0 - confidence)


@dataclass(frozen=True, slots=True)
class Turn:
    """How things stand between the robot and the person."""

    is_speaking: bool = False
    """Whether the robot speaks."""
    is_question_open: bool = False
    """Whether the robot has asked something."""
    is_awake: bool = True
    """Whether no wake word is needed."""
    is_addressed: bool = True
    """Whether what is said is meant for the robot, also without its name."""
    is_typed: bool = False
    """Whether it comes from a keyboard."""
    last: Followed | None = None
    """The command that was understood a while ago at most, if others may follow it."""
    doubt: Doubt | None = None
    """What was said last to the question that is open, and was not sure."""

    def of(self, segment: Segment) -> Turn:
        """The turn of a piece of speech: what is typed is meant for the robot."""
        return replace(self, is_typed=True, is_addressed=True) if segment.text else self

    def rules(self, grammar: Grammar) -> frozenset[str]:
        """The public rules that may be heard."""
        unheard = frozenset() if self.is_typed else grammar.marked("typed")
        interrupting = grammar.marked("interrupts") - unheard
        if self.is_speaking:
            return interrupting
        rules = frozenset(grammar.public_rules) - out_of_place(grammar, self.last) - unheard
        if not self.is_question_open:
            rules -= grammar.marked("answer")
        waking = grammar.marked("wake")
        if waking and not self.is_awake and not self.is_question_open:
            rules &= waking | interrupting
        return rules


class Wakefulness:
    """How long the robot is addressed without a wake word."""

    def __init__(self, follow_up: float = FOLLOW_UP) -> None:
        """`follow_up` seconds after the last word of either side a wake word is needed again."""
        self.follow_up = follow_up
        self._until = -math.inf

    def extend(self, now: float) -> None:
        """Something was said, by the person to the robot or by the robot."""
        self._until = now + self.follow_up

    def is_awake(self, now: float) -> bool:
        """Whether someone who speaks now speaks to the robot."""
        return now <= self._until
