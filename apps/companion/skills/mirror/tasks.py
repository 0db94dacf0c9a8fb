"""A mirror game: a task that does with the robot's face what the person does with theirs."""

from typing import Any

from hri.core import Event
from hri.robot import verbs
from hri.speech import QUESTION
from hri.task import Lane, TaskContext

GESTURES = {"head.nodded": "nod", "yes": "nod", "head.shaken": "shake", "no": "shake"}
"""What it makes after an event, or a word that is said."""
EXPRESSIONS = {
    "smile": "happy",
    "brows_raised": "surprised",
    "brows_lowered": "angry",
    "eyes_shut": "asleep",
}
"""What its face shows while theirs shows something."""
LONGEST = 10.0
"""Seconds that it shows something whose end it does not see."""
PATIENCE = 30.0
"""Seconds without a gesture after which the game is over."""
ENDINGS = ("yes", "no", "stop", "enough", "never_mind")
"""Rules of words that end the game; others end it, too, and have their own answer."""
SEEN = ("head.nodded", "head.shaken", "person.expressed", "person.relaxed")


async def mirror_head(context: TaskContext) -> str | None:
    """Copy head and face until something else is said, or nothing is seen for long.

    As with a question that is open, one nod is enough, and the robot asks nothing else.
    """
    lane, slot = Lane(context), context.board.slot(QUESTION)
    try:
        with context.queue(*SEEN, "speech.heard") as queue:
            await verbs.say(context, "I'm your mirror! Nod, shake your head, or smile.")
            slot.set(True, context.clock.now())
            while True:
                event: Event | None = None
                with context.clock.move_on_after(PATIENCE):
                    event = await queue.get()
                if event is None:
                    return "I see nothing more to copy. That was fun!"
                if event.name == "person.relaxed":
                    if lane.runs(verbs.show):  # a nod goes on
                        lane.stop()
                elif copy := _copy(event):
                    lane.start(*copy)
                elif event.name == "speech.heard":
                    is_end = event.properties["rule"] in ENDINGS
                    return "Okay, no more mirror. That was fun!" if is_end else None
    finally:
        slot.clear()
        lane.stop()


def _copy(event: Event) -> tuple[Any, ...]:
    """The job that copies an event, and its arguments; empty for nothing to copy."""
    done = event.properties.get("text", event.name)
    if done in GESTURES:
        return verbs.gesture, GESTURES[done]
    shown = EXPRESSIONS.get(event.properties.get("expression", ""))
    return (verbs.show, shown, LONGEST) if shown else ()
