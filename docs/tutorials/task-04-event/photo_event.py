"""A task that other tasks order photos from, by events.

It hears                                 and raises
  Examples.PhotoEvent.Shoot                Examples.PhotoEvent.Done
    name: how the file names begin           name: as in Shoot
    count: how many                        Examples.PhotoEvent.Error
    delay: between two, in default units     error: what was wrong with a Shoot
  Examples.PhotoEvent.StopShoot
  Examples.PhotoEvent.End
"""

import math
from typing import NamedTuple

from hri.core import Event, HriError
from hri.task import TaskContext
from hri.task.events import event
from hri.task.task import task
from hri.task.units import UNIT_TIME, in_si
from hri.task.vision import GetImage

ALL = "Examples.PhotoEvent.*"


class Order(NamedTuple):
    """The properties of a Shoot."""

    name: str
    count: float
    delay: float


def order_of(shoot: Event) -> Order:
    """Raises HriError when a property is missing or of another type."""
    return Order(
        shoot.get_property("name", str),
        shoot.get_property("count", float),
        shoot.get_property("delay", float),
    )


@task("Examples.PhotoEvent")
async def PhotoEvent(context: TaskContext) -> float:
    """Take photos as events order them, until End; how many were taken."""
    manager, clock = context.manager, context.clock
    order, due = Order("", 0, 0), math.inf
    photos = total = 0
    context.task.enable_event(ALL)
    while True:
        command = await context.task.wait_for_event(ALL, due - clock.now())
        match command and command.name:
            case None:
                photos, total = photos + 1, total + 1
                frame = await GetImage(context)
                frame.write_file(f"{order.name}{photos:03d}.jpg", 0.9)
                due += in_si(UNIT_TIME, order.delay)
                if photos >= order.count:
                    due = math.inf
                    manager.raise_event(event("Examples.PhotoEvent.Done", name=order.name))
            case "Examples.PhotoEvent.Shoot":
                try:
                    order = order_of(command)
                except HriError:
                    error = event("Examples.PhotoEvent.Error", error="Invalid property type.")
                    manager.raise_event(error)
                else:
                    photos, due = 0, clock.now()
            case "Examples.PhotoEvent.StopShoot":
                due = math.inf
            case "Examples.PhotoEvent.End":
                break
    context.task.disable_event(ALL)
    return total
