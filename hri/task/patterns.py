"""What tasks often do with a job: limit its time, try it again, repeat it."""

from __future__ import annotations

from typing import Any

from hri.core.errors import HriError
from hri.hal.pending import Interrupted
from hri.task.context import TaskContext
from hri.task.task_run import Job, name_of


class TooSlow(HriError):
    """A job took longer than it was given."""


async def with_timeout(context: TaskContext, seconds: float, job: Job, *arguments: Any) -> Any:
    """What a job returns; it is cancelled, and TooSlow raised, when it takes longer."""
    with context.clock.move_on_after(seconds):
        return await job(context, *arguments)
    raise TooSlow(f"{name_of(job)} took longer than {seconds:g} s - give it more time")


async def retry(context: TaskContext, times: int, delay: float, job: Job, *arguments: Any) -> Any:
    """The result of a job's first successful try, with `delay` seconds between tries. Only an
    HriError leads to another try; the last one is raised.
    """
    for _ in range(times - 1):
        try:
            return await job(context, *arguments)
        except Interrupted:
            raise  # whoever has taken the drive is not to be fought
        except HriError:
            await context.clock.sleep(delay)
    return await job(context, *arguments)


async def repeat(context: TaskContext, times: int, job: Job, *arguments: Any) -> list[Any]:
    """The results of a job run several times in sequence."""
    return [await job(context, *arguments) for _ in range(times)]
