"""A guessing game: questions whose answers may be nods and shakes."""

from hri.robot import verbs
from hri.task import TaskContext

LEAST, MOST = 1, 100
TIME_TO_THINK = 4.0
"""Seconds."""


async def guess_number(context: TaskContext) -> str:
    """Halve what is left with each question; without an answer the game is over."""
    await context.clock.sleep(TIME_TO_THINK)
    least, most = LEAST, MOST
    while least < most:
        middle = (least + most) // 2
        is_more = await verbs.ask(context, f"Is it more than {middle}?")
        if is_more is None:
            return "Okay, we can play again later."
        least, most = (middle + 1, most) if is_more else (least, middle)
    return f"It's {least}!"
