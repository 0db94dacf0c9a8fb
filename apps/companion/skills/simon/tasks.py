"""Simon says: orders to nod and to shake the head, of which only Simon's count."""

from hri.core import Event
from hri.robot import verbs
from hri.speech import QUESTION
from hri.task import TaskContext

ORDERS = {"nod": "nod your head", "shake": "shake your head"}
DEEDS = {"head.nodded": "nod", "yes": "nod", "head.shaken": "shake", "no": "shake"}
"""Which order an event, or a word that is said, obeys."""
FIRST = "Let's play! Do what I say, but only when Simon says so."
LATER = [True, True, False, False]
"""Whether Simon says it: rounds after the first, in any order."""
PATIENCE = 4.0
"""Seconds for a gesture."""
UNSEEN = 2
"""Simon's orders in a row after which nothing seen means that nothing can be seen."""
ENDINGS = ("yes", "no", "stop", "enough", "never_mind", "i_lost")
"""Rules of words that end the game; others end it, too, and have their own answer."""


async def play_simon(context: TaskContext) -> str | None:
    """Give five orders, and count the mistakes."""
    comment, mistakes, unseen = FIRST, 0, 0
    for is_simon in [True, *context.chance.sample(LATER, len(LATER))]:
        order = context.chance.choice(list(ORDERS))
        event = await _after(context, f"{comment} {_in_words(order, is_simon)}")
        done = _deed(event)
        if event is not None and not done:
            is_end = event.properties["rule"] in ENDINGS
            return "Okay, we can play again later." if is_end else None
        unseen = 0 if done else unseen + is_simon
        if unseen == UNSEEN:
            return "I can't see your head move. Let's play again when you're in front of me."
        mistakes += done != (order if is_simon else "")
        comment = _comment(order, is_simon, done)
    return f"{comment} {_result(mistakes)}"


def _in_words(order: str, is_simon: bool) -> str:
    words = ORDERS[order]
    return f"Simon says: {words}!" if is_simon else f"{words.capitalize()}!"


async def _after(context: TaskContext, words: str) -> Event | None:
    """Say it; the gesture that is made then, or what is said to it, if anything.

    As with a question that is open, one nod is enough, and the robot asks nothing else.
    """
    slot = context.board.slot(QUESTION)
    try:
        with context.queue("head.nodded", "head.shaken", "speech.heard") as queue:
            await verbs.say(context, words)
            queue.keep("speech.heard")
            slot.set(True, context.clock.now())
            with context.clock.move_on_after(PATIENCE):
                return await queue.get()
    finally:
        slot.clear()
    return None


def _deed(event: Event | None) -> str:
    """The order that was obeyed; empty for none."""
    return "" if event is None else DEEDS.get(event.properties.get("text", event.name), "")


def _comment(order: str, is_simon: bool, done: str) -> str:
    if not is_simon:
        return "Oops, Simon didn't say that!" if done else "Well done, Simon didn't say that!"
    if not done:
        return "I didn't see you do it."
    return "Great!" if done == order else "Oops, that was something else!"


def _result(mistakes: int) -> str:
    if not mistakes:
        return "The game is over, and you made no mistake!"
    count = "one mistake" if mistakes == 1 else f"{mistakes} mistakes"
    return f"The game is over. You made {count}, and I had fun!"
