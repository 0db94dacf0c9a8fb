"""What the app does itself: tasks named by `action` in replies.toml, with the tags of the words."""

from hri.robot.verbs import gesture
from hri.task import TaskContext


async def timer(context: TaskContext, seconds: float) -> str:
    """Wait; what is returned is said."""
    await context.clock.sleep(seconds)
    context.events.raise_event("timer.ended", seconds=seconds)
    return f"{seconds:g} seconds are over."


async def rejoice(context: TaskContext, seconds: float = 0.0) -> None:
    """What `[on]` in app.toml starts. Properties of the event come as arguments."""
    await gesture(context, "laugh" if seconds > 30 else "nod")
