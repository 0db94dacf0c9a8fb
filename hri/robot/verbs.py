"""What a robot can be told in one word; each is a coroutine that may be cancelled."""

from __future__ import annotations

from hri.behavior.behavior import Behavior
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Expression, Utterance
from hri.drive.tasks import move, turn
from hri.emotion.behaviors import EmotionModel
from hri.face.behaviors import Face
from hri.face.model import load_face
from hri.speech.behaviors import Listener
from hri.speech.tasks import listener_of, say
from hri.task.context import TaskContext

__all__ = ["ask", "feel", "listen", "move", "say", "show", "turn"]

ANSWERS = {"yes": True, "no": False, "head.nodded": True, "head.shaken": False}
"""What counts as an answer: rules of the grammar and head gestures."""

SHOWN = "expression.override"
"""Slot of the board with the expression that is shown in place of the felt one."""
QUESTION = "question.open"
"""Slot of the board that is true while an answer is awaited."""


async def show(context: TaskContext, label: str, seconds: float = 4.0) -> None:
    """Show an expression for a while, whatever is felt.

    Raises HriError for one the face does not know.
    """
    known = load_face(context.behavior(Face).face).expressions
    if label not in known:
        raise HriError(f'the face has no expression "{label}" - {did_you_mean(label, known)}')
    slot = context.board.slot(SHOWN)
    async with context.claim("face"):
        slot.set(Expression(label), context.clock.now())
        try:
            await context.clock.sleep(seconds)
        finally:
            slot.clear()


async def feel(context: TaskContext, stimulus: str, intensity: float = 1.0) -> None:
    """Let a stimulus of `emotions/stimuli` move the emotions."""
    context.behavior(EmotionModel).feel(stimulus, intensity)


async def listen(context: TaskContext, timeout: float = float("inf")) -> Utterance | None:
    """The next thing heard; None when nothing is heard in time."""
    listener_of(context)
    event = await context.wait_for("speech.heard", timeout=timeout)
    if event is None:
        return None
    heard = event.properties
    return Utterance(heard["text"], heard["rule"], heard["tags"], heard["confidence"])


async def ask(context: TaskContext, question: str, timeout: float = 6.0) -> bool | None:
    """Ask a yes/no question; a nod, a shake, "yes" and "no" are answers. None without one.

    `timeout` seconds count from the end of the question. Raises `question.asked` when it has been
    spoken and `question.answered` with the answer.
    """
    slot = context.board.slot(QUESTION)
    if not context.behaviors:
        listener_of(context)
    await say(context, question)
    slot.set(True, context.clock.now())
    try:
        with (
            context.queue("speech.heard", "head.*") as queue,
            context.clock.move_on_after(timeout),
        ):
            context.events.raise_event("question.asked", text=question)
            while True:
                event = await queue.get()
                key = event.properties.get("rule", event.name)
                if key in ANSWERS:
                    answer = ANSWERS[key]
                    by = "speech" if event.name == "speech.heard" else "head"
                    context.events.raise_event(
                        "question.answered", text=question, answer=answer, by=by
                    )
                    return answer
                if event.name == "speech.heard":
                    return None  # the person changed the subject
    finally:
        slot.clear()
    return None


def is_quiet(behaviors: dict[str, Behavior]) -> bool:
    """Whether nothing heard is still being worked on."""
    listeners = [behavior for behavior in behaviors.values() if isinstance(behavior, Listener)]
    return all(listener.is_idle for listener in listeners)
