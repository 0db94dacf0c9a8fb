"""What the app does: each task named in `app.toml` runs from its start to its end."""

from hri.robot.verbs import gesture, say
from hri.task.context import TaskContext


async def converse(context: TaskContext) -> None:
    """Do what is asked: the name of the rule in grammar.jsgf says which of these it is."""
    deeds = {"greet": greet, "count": count, "leave": leave}
    with context.queue("speech.heard") as queue:
        while True:
            heard = await queue.get()
            await deeds[heard.properties["rule"]](context, **heard.properties["tags"])


async def greet(context: TaskContext) -> None:
    await say(context, "Hello, I am thing.")


async def count(context: TaskContext, last: float) -> None:
    """Nod, then count, with a pause between."""
    await gesture(context, "nod")
    for number in range(1, round(last) + 1):
        await say(context, str(number))
        await context.clock.sleep(0.5)


async def leave(context: TaskContext) -> None:
    await say(context, "Goodbye.")
