"""Charades: faces to guess, and questions with their own grammar."""

from hri.core import Utterance
from hri.robot import verbs
from hri.task import Lane, TaskContext

FEELINGS = ("happy", "sad", "angry", "surprised", "scared", "disgusted")
"""Expressions of the face, which are tags of feelings.jsgf as well."""
QUESTIONS = ("How do I feel?", "And how do I feel now?", "And what's this one?")
LONGEST = 60.0
"""Seconds for which a face is held at most."""


async def play_charades(context: TaskContext) -> str | None:
    """Show three feelings; without an answer the game is over."""
    face, right = Lane(context), 0
    feelings = context.chance.sample(FEELINGS, len(QUESTIONS))
    await verbs.say(context, "Look at my face!")
    for question, feeling in zip(QUESTIONS, feelings, strict=True):
        face.start(verbs.show, feeling, LONGEST)
        try:
            answer = await verbs.ask(context, question, grammar="feelings.jsgf", timeout=10.0)
        finally:
            face.stop()
        if not isinstance(answer, Utterance):
            return None
        is_right = answer.tags.get("feeling") == feeling
        right += is_right
        await verbs.say(context, f"Yes, I was {feeling}!" if is_right else f"I was {feeling}.")
    return f"You guessed {right} of {len(QUESTIONS)}. Thanks for playing!"
