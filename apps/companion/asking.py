"""The companion's own questions: their time, their choice, and the deed after a yes."""

from __future__ import annotations

from hri.conversation import GIVES_WAY_SECONDS, gives_way
from hri.robot import verbs
from hri.speech import hears_people
from hri.task import TaskContext

from .companion import Companion
from .replies import Question

NOTICED_AFTER = 0.3
"""Seconds after which the ears know that someone has begun to speak."""
LOOK_EVERY = 0.02


def next_question(companion: Companion) -> Question | None:
    """The question that it asks next; None when none fits the hour and what was said."""
    questions = _questions(companion)
    at, feeling = companion.context.clock.wall(), companion.emotion.feeling().label
    place = companion.curiosity.choose(questions, companion.heard, feeling, at)
    return None if place is None else questions[place]


def _questions(companion: Companion) -> list[Question]:
    """What it may ask now: first whether it may keep what it feels, only once, and only people.

    Then a question that fits its devices: without a base, it offers no ride.
    """
    may_ask = companion.emotion.may_ask_to_keep and hears_people(companion.context)
    may_ask = may_ask and not companion.has_asked_to_keep
    questions = companion.replies.questions
    keeping = [question for question in questions if question.action == "keep" and may_ask]
    return keeping or [question for question in questions if question.action != "keep"]


def ask(companion: Companion, question: Question) -> None:
    """Ask one of its questions; it gives way to who begins to speak at the same time."""
    companion.talk.start(_ask, companion, question)
    companion.floor.start(_give_way, companion, question.ask)


async def _ask(context: TaskContext, companion: Companion, question: Question) -> None:
    companion.has_asked_to_keep |= question.action == "keep"
    answer = await verbs.ask(context, question.ask)
    companion.curiosity.note(question.ask, context.clock.wall())
    if answer is None:
        return
    companion.last_contact = context.clock.now()
    words = (_agree(companion, question) or question.yes) if answer else question.no
    if words:
        await verbs.say(context, words)


def _agree(companion: Companion, question: Question) -> str | None:
    """Do what a yes to a question asks for; what is said then instead of its words, if any."""
    if question.show:
        companion.show(question.show)
    if question.action == "keep":
        companion.emotion.begin_keeping()
        return None
    return companion.perform(question.task, {})


async def _give_way(context: TaskContext, companion: Companion, words: str) -> None:
    """Fall silent when someone began to speak about when these words of the robot began."""
    begun = await _begun(context, words)
    while context.clock.now() < begun + GIVES_WAY_SECONDS + NOTICED_AFTER:
        voice = companion.listener.other_voice(begun)
        if voice is not None and gives_way(begun, voice):
            companion.listener.let_speak()
            companion.talk.stop()
            return
        await context.clock.sleep(LOOK_EVERY)


async def _begun(context: TaskContext, words: str) -> float:
    """When the robot's words begin to be heard, in seconds; does not come back without them."""
    with context.queue("speech.said") as queue:
        while (event := await queue.get()).properties["text"] != words:
            pass
    return event.time
