"""Your own task: run it with `python thing.py`."""

from hri.task import TaskContext
from hri.task.task import task


@task("My.Thing")
async def thing(context: TaskContext, count: int = 3) -> str:
    """Count down, a second a number, and raise an event for each."""
    for number in range(count, 0, -1):
        context.events.raise_event("number.counted", number=number)
        await context.clock.sleep(1.0)
    return "go"


if __name__ == "__main__":
    print(thing())
