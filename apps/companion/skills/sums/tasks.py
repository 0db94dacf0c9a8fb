"""Sums: a task that remembers what came out last, in a slot of the board."""

import operator

from hri.task import TaskContext, immediate

LAST = "sums.last"
SIGNS = {
    "plus": operator.add,
    "minus": operator.sub,
    "times": operator.mul,
    "divided by": operator.truediv,
}


@immediate
def sum_up(
    context: TaskContext, sign: str, first: float | None = None, second: float | None = None
) -> str:
    """Say what comes out; a number that is missing is what came out last."""
    slot = context.board.slot(LAST)
    one, other = (slot.value if number is None else number for number in (first, second))
    if one is None or other is None:
        return "I haven't worked anything out yet."
    if sign == "divided by" and other == 0:
        return "Nothing can be divided by zero."
    result = round(SIGNS[sign](one, other), 3)
    slot.set(result, context.clock.now())
    return f"{one:g} {sign} {other:g} is {result:.10g}."
