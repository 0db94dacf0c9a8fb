"""Says what nobody asked for just now, when the robot may: the most important thing first."""

from __future__ import annotations

from typing import Protocol

from hri.conversation.floor import Importance, Scene, may_begin
from hri.core.latest import Latest
from hri.robot.verbs import say
from hri.speech.behaviors import Listener, Voice
from hri.speech.turn import QUESTION
from hri.task.context import TaskContext

LOOK_EVERY = 0.1
"""Seconds between looks at whether it may."""
MOST_PATIENCE = 30.0
"""Seconds after which an alarm is said into whatever goes on."""
SPEAKER, WAITING = "floor.speaker", "floor.waiting"
"""Slots of the board: whose floor it is, and what waits to be said."""


class Speaker(Protocol):
    """An app that knows how things stand, and how it speaks."""

    def scene(self) -> Scene:
        """How things stand."""

    async def say_unasked(self, context: TaskContext, words: str, importance: Importance) -> None:
        """Say it now."""


class _Waiting:
    """Something that is to be said."""

    def __init__(self, importance: Importance) -> None:
        self.importance = importance


async def speak_up(
    context: TaskContext, words: str, importance: Importance = Importance.NEWS
) -> None:
    """Say something when nobody is disturbed by it, and wait until it has been said.

    Of several that wait, the most important is said first. An alarm does not wait for long, and
    wakes a robot that sleeps; see `hri.conversation.floor` for what the others wait for.
    """
    slot: Latest[list[_Waiting]] = context.board.slot(WAITING)
    waiting = slot.value if slot.value is not None else []
    slot.set(waiting, context.clock.now())
    own = _Waiting(importance)
    waiting.append(own)
    end = context.clock.now() + MOST_PATIENCE
    try:
        while not _may_say(context, own, waiting):
            if importance is Importance.ALARM and context.clock.now() >= end:
                break
            await context.clock.sleep(LOOK_EVERY)
        if (speaker := _speaker(context)) is not None:
            await speaker.say_unasked(context, words, importance)
        else:
            await say(context, words)
    finally:
        waiting.remove(own)


def _may_say(context: TaskContext, own: _Waiting, waiting: list[_Waiting]) -> bool:
    """Whether it is its turn, and the floor is free."""
    first = max(waiting, key=lambda one: one.importance)
    return first is own and may_begin(_scene(context), own.importance)


def _speaker(context: TaskContext) -> Speaker | None:
    speaker: Speaker | None = context.board.slot(SPEAKER).value
    return speaker


def _scene(context: TaskContext) -> Scene:
    if (speaker := _speaker(context)) is not None:
        return speaker.scene()
    listener, voice = context.find_behavior(Listener), context.find_behavior(Voice)
    return Scene(
        now=context.clock.now(),
        hour=context.clock.wall().hour,
        is_voice_heard=listener is not None and bool(listener.is_hearing.value),
        is_speaking=voice is not None and not voice.is_idle,
        is_question_open=bool(context.board.slot(QUESTION).value),
    )
