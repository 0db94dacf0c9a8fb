"""Rolls dice: a task that is over at once, and returns what the robot says."""

from hri.task import TaskContext, immediate

MOST = 6
"""Dice that it has."""


@immediate
def roll_dice(context: TaskContext, dice: float = 1) -> str:
    """Roll this many dice."""
    if dice != int(dice) or dice > MOST:
        return f"I have {MOST} dice, and none to cut in half."
    rolled = [str(context.chance.randint(1, 6)) for _ in range(int(dice))]
    return f"I rolled {' and '.join(rolled)}."
