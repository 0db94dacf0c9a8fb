"""The app's own tasks: named by `action` in replies.toml, with the tags as arguments."""

from hri.robot.verbs import gesture
from hri.task import TaskContext


async def timer(context: TaskContext, seconds: float) -> str:
    """Wait; the robot says the returned text."""
    await context.clock.sleep(seconds)
    context.events.raise_event("timer.ended", seconds=seconds)
    return f"{seconds:g} seconds are over."


async def rejoice(context: TaskContext, seconds: float = 0.0) -> None:
    """Started by `[on]` in app.toml. Properties of the event are arguments."""
    await gesture(context, "laugh" if seconds > 30 else "nod")
