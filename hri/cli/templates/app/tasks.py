"""What the app does: each task named in `app.toml` runs from its start to its end."""

from hri.speech.tasks import say
from hri.task.context import TaskContext


async def greet(context: TaskContext) -> None:
    """Greet, then count, with a pause between."""
    await say(context, "Hello, I am thing.")
    for number in ("one", "two", "three"):
        await context.clock.sleep(0.5)
        await say(context, number)
