"""What the app does: each task named in `app.toml` runs from its start to its end."""

from functools import partial

from hri.robot.verbs import ask, gesture, move, say
from hri.task import TaskContext


async def converse(context: TaskContext) -> None:
    """Call the function in DEEDS for the rule of grammar.jsgf that was heard."""
    with context.queue("speech.heard") as queue:
        while True:
            heard = (await queue.get()).properties
            if heard["rule"] in DEEDS:
                # A task by itself: when it fails, the robot reports that and goes on.
                task = context.manager.install(partial(DEEDS[heard["rule"]], **heard["tags"]))
                await task.wait()
            elif heard["rule"] not in ANSWERS:
                await say(context, f"I do not know what to do for {heard['rule']}.")


async def greet(context: TaskContext) -> None:
    await say(context, "Hello, I am thing.")


async def count(context: TaskContext, last: float) -> None:
    """Nod, then count, with a pause between."""
    await gesture(context, "nod")
    for number in range(1, round(last) + 1):
        await say(context, str(number))
        await context.clock.sleep(0.5)


async def leave(context: TaskContext) -> None:
    if await ask(context, "Shall I back off?"):
        await move(context, -0.2)
    await say(context, "Goodbye.")


DEEDS = {"greet": greet, "count": count, "leave": leave}
ANSWERS = {"yes", "no"}
"""What `ask` waits for."""
