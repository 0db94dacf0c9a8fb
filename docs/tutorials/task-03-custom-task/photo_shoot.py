"""A task of our own: photos at intervals."""

import math

from hri.task import TaskContext
from hri.task.task import task
from hri.task.units import UNIT_TIME, in_si
from hri.task.vision import GetImage


@task("Examples.PhotoShoot")
async def PhotoShoot(context: TaskContext, delay: float, stop_count: float = math.inf) -> float:
    """Write image001.jpg, image002.jpg, ... and return how many.

    `delay` is the time between two photos, in default units. Without a `stop_count` this goes on
    until the task is cancelled.
    """
    if stop_count <= 0:
        context.fail("stop_count must be positive - leave it out for photos without end")
    photos = 0
    while photos < stop_count:
        frame = await GetImage(context)
        photos += 1
        frame.write_file(f"image{photos:03d}.jpg", 0.9)
        context.task.result = photos
        await context.clock.sleep(in_si(UNIT_TIME, delay))
    return photos
