"""A mirror game: a task that answers gestures of the head with the same gesture."""

from hri.core import Event
from hri.robot import verbs
from hri.speech import QUESTION
from hri.task import Lane, TaskContext

COPIES = {"head.nodded": "nod", "yes": "nod", "head.shaken": "shake", "no": "shake"}
"""What it makes after an event, or a word that is said."""
PATIENCE = 30.0
"""Seconds without a gesture after which the game is over."""
ENDINGS = ("yes", "no", "stop", "enough", "never_mind")
"""Rules of words that end the game; others end it, too, and have their own answer."""


async def mirror_head(context: TaskContext) -> str | None:
    """Copy the head until something else is said, or nothing is seen for long.

    As with a question that is open, one nod is enough, and the robot asks nothing else.
    """
    gestures, slot = Lane(context), context.board.slot(QUESTION)
    try:
        with context.queue("head.nodded", "head.shaken", "speech.heard") as queue:
            await verbs.say(context, "I'm your mirror! Nod, or shake your head.")
            slot.set(True, context.clock.now())
            while True:
                event: Event | None = None
                with context.clock.move_on_after(PATIENCE):
                    event = await queue.get()
                if event is None:
                    return "I see nothing more to copy. That was fun!"
                copy = COPIES.get(event.properties.get("text", event.name))
                if copy is None:
                    is_end = event.properties["rule"] in ENDINGS
                    return "Okay, no more mirror. That was fun!" if is_end else None
                gestures.start(verbs.gesture, copy)
    finally:
        slot.clear()
