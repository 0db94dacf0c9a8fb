"""The verbs of a robot; each is a coroutine that may be cancelled."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from types import MappingProxyType
from typing import Any, TypeVar

from hri.behavior.behavior import Behavior
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Event, Expression, Utterance
from hri.drive.tasks import move, stop, turn
from hri.emotion.appraisal import OccEvent
from hri.emotion.behaviors import EmotionModel
from hri.face.behaviors import Brush, Face, FaceRenderer
from hri.face.model import FaceModel, load_face
from hri.speech.answering import AGAIN, REFUSING, UNSURE, answering
from hri.speech.behaviors import Listener
from hri.speech.grammar import Grammar, parse
from hri.speech.grammar.slot_values import values_of
from hri.speech.tasks import answers_of, listener_of, next_heard, play, say, wait_for_speech
from hri.speech.turn import QUESTION
from hri.task.context import TaskContext
from hri.vision.behaviors import PersonTracker

__all__ = [
    "appraise",
    "ask",
    "change_face",
    "feel",
    "gesture",
    "listen",
    "move",
    "play",
    "say",
    "show",
    "stop",
    "turn",
    "wait_for_speech",
    "why",
]

T = TypeVar("T")


class Ending(Enum):
    """Why a question has no answer."""

    REFUSED = "refused"
    """The person wants no more of it."""
    UNANSWERED = "unanswered"
    """The time was over."""
    OTHER = "other"
    """The person said something else."""


ANSWERS = {"yes": True, "no": False, "head.nodded": True, "head.shaken": False}
"""What counts as an answer: rules of the grammar and head gestures."""
THUMB = "hand.thumb"
"""So does a thumb, up or down."""

ROBOT_SPEAKS = ("speech.said", "speech.finished")
ANSWERING = ("speech.heard", "speech.rejected", "head.*", THUMB, *ROBOT_SPEAKS)
"""Events that matter while a question is open."""

SHOWN = "expression.override"
"""Slot of the board with the expression that is shown instead of the felt one."""
LOOK_EVERY = 0.02
"""Seconds between looks at whether a gesture has been made, or a grammar is in force."""
MOMENT = 2.0
"""Seconds after which the grammar of a question has surely given way to the one below it."""


async def show(context: TaskContext, label: str, seconds: float = 4.0) -> None:
    """Show an expression for a while, whatever is felt; 0 seconds is as long as the face holds it.

    Raises HriError for one the face does not know.
    """
    face = load_face(context.behavior(Face).face)
    known = face.expressions
    if label not in known:
        raise HriError(f'the face has no expression "{label}" - {did_you_mean(label, known)}')
    timing = face.settings.timing[label]
    seconds = seconds or timing.onset_s + timing.apex_s
    slot = context.board.slot(SHOWN)
    async with context.claim("face"):
        slot.set(Expression(label), context.clock.now())
        try:
            await context.clock.sleep(seconds)
        finally:
            slot.clear()


async def change_face(context: TaskContext, name: str) -> None:
    """Look otherwise from now on: a folder in faces/, or a path. Takes a second or two.

    Raises HriError for a face that cannot be read; the robot looks as before then.
    """
    face = context.behavior(Face)
    screens = [one for one in context.behaviors.values() if isinstance(one, FaceRenderer)]

    def load() -> tuple[FaceModel, list[Brush]]:
        model = load_face(name)
        return model, [screen.brush_of(model) for screen in screens]

    model, brushes = await context.blocking(load)
    face.change(name, model)
    for screen, brush in zip(screens, brushes, strict=True):
        screen.change(name, brush)


async def gesture(
    context: TaskContext, name: str, strength: float = 1.0, seconds: float = 0.0
) -> None:
    """Make a gesture with the face, such as "nod", and wait until it is made.

    `strength` is 0 to 1.5; `seconds` 0 is the gesture's own duration. When cancelled, or when
    another one takes its place, the face glides on from where it is. Raises HriError for a gesture
    the face does not know.
    """
    playing = context.behavior(Face).make(name, strength, seconds)
    try:
        while not playing.is_over:
            await context.clock.sleep(LOOK_EVERY)
    finally:
        playing.cancel()


async def feel(
    context: TaskContext, stimulus: str, intensity: float = 1.0, person: str | None = None
) -> None:
    """Let a stimulus of `emotions/stimuli`, perhaps by a person, move the emotions.

    Raises HriError for an unknown stimulus, ValueError for an intensity outside 0 to 1.
    """
    context.behavior(EmotionModel).feel(stimulus, intensity, person)


async def appraise(context: TaskContext, event: OccEvent) -> None:
    """Let a goal that became likelier, a deed or a thing move the emotions, as OCC has it."""
    context.behavior(EmotionModel).appraise(event)


async def why(context: TaskContext, about: str = "") -> str:
    """What the robot feels and why, in a sentence: "I am sad because you scolded me."."""
    return context.behavior(EmotionModel).why_words(about)


async def listen(
    context: TaskContext, timeout: float = float("inf"), grammar: str = ""
) -> Utterance | None:
    """The next thing heard; None when nothing is heard in time.

    With the name or path of a `grammar`, that one is in force meanwhile; raises HriError for one
    that cannot be used.
    """
    return await wait_for_speech(context, "", timeout, grammar)


async def ask(
    context: TaskContext,
    question: str,
    timeout: float = 6.0,
    grammar: str = "",
    retries: int = 0,
) -> bool | Utterance | None:
    """Ask a question; the answer, or None without one.

    Without a grammar it is a yes/no question: a nod, a shake, a thumb up or down, "yes" and "no"
    are answers, and anything else that is heard changes the subject. Of several people, only the
    one attended to answers with the head or a hand. With the name or path of a `grammar`, which is
    looked for in the app's own folder first, that one is in force while the question is open, and
    the first thing heard is the answer, also among other words (see `hri.speech.answering`). "Never
    mind" ends the question without an answer, "what did you say" has it said again; rules marked
    @interrupts of the grammars below, such as "stop", still count, and change the subject.
    `timeout` seconds count from the end of what the robot said last, and who speaks by then is
    heard out; it is asked again up to `retries` times. When only a part of an answer was unclear,
    the next question is for that ("Which milk?"), and the tags that were clear are kept.
    Raises `question.asked` when it has been spoken, and then `question.answered` with the answer,
    `question.refused` after a "never mind", or `question.unanswered` when the time is over. Raises
    HriError for a grammar that cannot be used.
    """
    if grammar:
        async with answers_of(context, grammar, answering) as allowed:
            answer_of = _HeardAnswer(allowed, question)
            return _answer(await _ask(context, question, timeout, retries, answer_of))
    if not context.behaviors:
        await listener_of(context)
    return _answer(await _ask(context, question, timeout, retries, _plain_answer))


async def ask_in_force(
    context: TaskContext,
    question: str,
    timeout: float = 6.0,
    retries: int = 1,
    questions: Mapping[str, str] = MappingProxyType({}),
    is_yes_or_no: bool = False,
    hint: Callable[[], str] | None = None,
) -> bool | Utterance | Ending:
    """Ask a question that the grammar in force answers; the answer, or why there is none.

    A nod, a shake or a thumb answers one that `is_yes_or_no`. `questions` are what is asked, by
    tag, where only that tag was unclear; who does not know is asked again, after what `hint` gives
    in a worker. Otherwise as `ask`.
    """
    grammar = context.behavior(Listener).loaded_grammar
    answer_of = _HeardAnswer(grammar, question, questions=questions, hint=hint)
    if not is_yes_or_no:
        return await _ask(context, question, timeout, retries, answer_of)

    def nodded_or_heard(
        context: TaskContext, event: Event
    ) -> tuple[bool | Utterance | None] | _Refusal | _Again | None:
        shown = _shown_answer(event)
        if shown is not None and _is_asked(context, event.properties.get("person", "")):
            return (shown,)
        return answer_of(context, event)

    return await _ask(context, question, timeout, retries, nodded_or_heard)


def _answer(found: T | Ending) -> T | None:
    return None if isinstance(found, Ending) else found


async def ask_value(
    context: TaskContext,
    rule: str,
    tag: str,
    timeout: float = 6.0,
    question: str = "",
    doubted: Mapping[str, Any] = MappingProxyType({}),
) -> Utterance | None:
    """Ask for one value of a command in force; the answer with its tags, or None.

    Without a `question` it asks by the name of the tag, "Which size?". Meanwhile the grammar is
    what gives that tag of the rule its value (`values_of`), also among other words; else as `ask`.
    `doubted` are tags that were heard before and are not sure. Raises HriError for a rule that is
    not in force.
    """
    asked = question or f"Which {in_words(tag)}?"

    def prepared(grammar: Grammar) -> Grammar:
        return answering(values_of(grammar, rule, tag))

    path = str((await _grammar_with(context, rule)).path)
    async with answers_of(context, path, prepared) as whole:
        answer_of = _HeardAnswer(values_of(whole, rule, tag), asked, doubted=doubted)
        return _answer(await _ask(context, asked, timeout, 0, answer_of))


async def _grammar_with(context: TaskContext, rule: str) -> Grammar:
    """The grammar in force; that of a question which was just answered is not in a moment."""
    listener, end = context.behavior(Listener), context.clock.now() + MOMENT
    while rule not in (grammar := listener.loaded_grammar).rules:
        if context.clock.now() >= end:
            known = grammar.public_rules
            raise HriError(f"no command <{rule}> is heard - {did_you_mean(rule, known)}")
        await context.clock.sleep(LOOK_EVERY)
    return grammar


@dataclass(frozen=True, slots=True)
class _Again:
    """Something is left to be asked, or was not understood by the person."""

    question: str
    answer_of: Callable[[TaskContext, Event], Any]
    """What an event answers then."""
    retries: int = 1
    """How many of them it takes."""
    hint: Callable[[], str] | None = None
    """Gives what is said before the question."""


@dataclass(frozen=True, slots=True)
class _Refusal:
    """The person wants no more of the question."""


async def _ask(
    context: TaskContext,
    question: str,
    timeout: float,
    retries: int,
    answer_of: Callable[[TaskContext, Event], tuple[T | None] | _Refusal | _Again | None],
) -> T | Ending:
    """Ask until something is an answer; why not without one.

    `answer_of` says of an event what it answers: (None,) when it changes the subject, None when it
    is nothing to the question.
    """
    asked, left = question, retries
    while left >= 0:
        found = await _first_answer(context, asked, timeout, left, answer_of)
        if found is None:
            left -= 1
            continue
        event, answer = found
        if isinstance(answer, _Again):
            asked, answer_of, left = answer.question, answer.answer_of, left - answer.retries
            if answer.hint is not None and (hint := await context.blocking(answer.hint)):
                asked = f"{hint} {asked}"
            continue
        if isinstance(answer, _Refusal):
            context.events.raise_event("question.refused", text=question)
            return Ending.REFUSED
        if answer[0] is None:
            return Ending.OTHER
        _tell_answer(context, question, answer[0], event)
        return answer[0]
    context.events.raise_event("question.unanswered", text=question)
    return Ending.UNANSWERED


async def _first_answer(
    context: TaskContext,
    asked: str,
    timeout: float,
    left: int,
    answer_of: Callable[[TaskContext, Event], tuple[T | None] | _Refusal | _Again | None],
) -> tuple[Event, tuple[T | None] | _Refusal | _Again] | None:
    """Ask; the first event that answers, and its answer; None when none does in time.

    `left` is how many retries are left for what is to be asked again. Where the question has a
    grammar, an answer to a question that is not over yet counts.
    """
    slot = context.board.slot(QUESTION)
    early = ("speech.heard",) if isinstance(answer_of, _HeardAnswer) else ()
    try:
        with context.queue(*ANSWERING) as queue:
            await say(context, asked)
            queue.keep(*early)
            slot.set(True, context.clock.now())
            context.events.raise_event("question.asked", text=asked)
            end = context.clock.now() + timeout
            while (event := await next_heard(context, queue, end)) is not None:
                if event.name in ROBOT_SPEAKS:  # a hint, say, over which nobody can answer
                    end = math.inf if event.name == "speech.said" else event.time + timeout
                    continue
                answer = answer_of(context, event)
                if isinstance(answer, _Again) and answer.retries > left:
                    continue
                if answer is not None:
                    return event, answer
    finally:
        slot.clear()
    return None


def _tell_answer(context: TaskContext, question: str, answer: object, event: Event) -> None:
    by = {"speech.heard": "speech", THUMB: "hand"}.get(event.name, "head")
    told = answer.text if isinstance(answer, Utterance) else answer
    # Of a nod or a shake it is known whose it was, and they are thanked for it.
    who = {"person": person} if (person := event.properties.get("person")) else {}
    context.events.raise_event("question.answered", text=question, answer=told, by=by, **who)


def _plain_answer(context: TaskContext, event: Event) -> tuple[bool | None] | None:
    key = event.properties.get("rule", event.name)
    if not _is_asked(context, event.properties.get("person", "")):
        return None
    if key in ANSWERS:
        return (ANSWERS[key],)
    if (shown := _shown_answer(event)) is not None:
        return (shown,)
    return (None,) if event.name == "speech.heard" else None


def _shown_answer(event: Event) -> bool | None:
    """What a gesture of head or hand answers; None for what is no such gesture."""
    if event.name == THUMB:
        return {"up": True, "down": False}.get(event.properties.get("direction", ""))
    return ANSWERS.get(event.name)


def _is_asked(context: TaskContext, person: str) -> bool:
    """Whether it is the attended person; True for anyone while people are not distinguished."""
    tracker = context.find_behavior(PersonTracker)
    attended = tracker.last.attended if tracker is not None else ""
    return not person or not attended or person == attended


class _HeardAnswer:
    """Takes the first thing heard for the answer, with what was clear of those before it.

    A value that was in doubt and is heard a second time is clear, except where the robot moves.
    """

    def __init__(
        self,
        grammar: Grammar,
        asked: str,
        sure: Mapping[str, Any] = MappingProxyType({}),
        doubted: Mapping[str, Any] = MappingProxyType({}),
        questions: Mapping[str, str] = MappingProxyType({}),
        hint: Callable[[], str] | None = None,
    ) -> None:
        self._grammar, self._asked, self._hint = grammar, asked, hint
        self._sure, self._doubted, self._questions = sure, doubted, questions

    def __call__(
        self, context: TaskContext, event: Event
    ) -> tuple[Utterance | None] | _Refusal | _Again | None:
        listener = context.behavior(Listener)
        if event.name == "speech.rejected" and event.properties.get("unsure"):
            return self._doubtful(listener.loaded_grammar, event.properties)
        heard = listener.last_utterance
        if event.name != "speech.heard" or heard is None:
            return None
        if heard.rule == UNSURE and self._hint is not None:
            return _Again(self._asked, self, retries=0, hint=self._hint)
        if heard.rule in REFUSING:
            return _Refusal()
        if heard.rule == AGAIN:
            return _Again(self._asked, self, retries=0)
        if heard.rule not in self._grammar.public_rules:  # it interrupts; it may answer as well
            meant = parse(self._grammar, heard.text)
            if meant is None or meant.slots:  # a free slot takes the words of anything
                return (None,)
            heard = replace(heard, rule=meant.rule, tags=meant.tags)
        return (replace(heard, tags={**self._sure, **heard.tags}),)

    def _doubtful(
        self, grammar: Grammar, heard: Mapping[str, Any]
    ) -> tuple[Utterance | None] | _Again:
        """The answer where all that is in doubt was heard before, else the next question."""
        sure = {**self._sure, **(heard.get("sure") or {})}
        doubted = doubted_of(grammar, heard)
        found = parse(grammar, str(heard.get("text", "")))
        same = {tag: value for tag, value in doubted.items() if self._doubted.get(tag) == value}
        left = [tag for tag in heard["unsure"] if tag not in same]
        if not left and found is not None and found.rule not in grammar.marked("careful"):
            return (Utterance(heard["text"], found.rule, {**sure, **same}),)
        tag = (left or heard["unsure"])[0]
        asked = self._questions.get(tag) or f"Which {in_words(tag)}?"
        kept = {**sure, **same}
        return _Again(asked, _HeardAnswer(self._grammar, asked, kept, doubted, self._questions))


def doubted_of(grammar: Grammar, heard: Mapping[str, Any]) -> dict[str, Any]:
    """The tags of a sentence that is not sure which are in doubt; of `speech.rejected`."""
    found = parse(grammar, str(heard.get("text", "")))
    tags = {} if found is None else found.tags
    return {tag: tags[tag] for tag in heard.get("unsure", ()) if tag in tags}


def in_words(tag: str) -> str:
    """The name of a tag as it is said: milkAmount, milk_amount: "milk amount"."""
    return " ".join(re.findall(r"[A-Z]?[a-z]+|[A-Z]+|\d+", tag)).lower()


def is_quiet(behaviors: dict[str, Behavior]) -> bool:
    """Whether nothing heard is still being worked on."""
    listeners = [behavior for behavior in behaviors.values() if isinstance(behavior, Listener)]
    return all(listener.is_idle for listener in listeners)
