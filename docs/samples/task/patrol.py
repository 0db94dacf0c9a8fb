"""A custom task drives a square and reports at each corner; it has a minute for that."""

import math

from hri.task import Parallel, TaskContext, TaskStatus, get_task_manager
from hri.task.navigation import MoveRelative, TurnRelative
from hri.task.task import task
from hri.task.util import Wait

SIDE = 50  # cm
SPEED = 20  # cm/s
MINUTE = 60_000  # milliseconds


@task("Examples.Patrol")
async def patrol(context: TaskContext, side: float, rounds: int = 1) -> int:
    """Drive squares with sides of `side` cm; the count of corners."""
    corners = 0
    for _ in range(4 * rounds):
        await MoveRelative(context, 0.0, [side, 0, SPEED])
        await TurnRelative(context, math.pi / 2)
        corners += 1
        context.events.raise_event("patrol.turned", corner=corners)
    return corners


def main() -> None:
    """Patrol once around, unless that takes too long."""
    manager = get_task_manager()
    manager.events.subscribe(
        "patrol.turned", lambda event: print(f"corner {event.properties['corner']}", flush=True)
    )
    race = Parallel()
    tour = race.add_task(patrol, [SIDE])
    race.add_task(Wait, [MINUTE])
    race.wait_for_first_task()
    print("back again" if tour.status is TaskStatus.SUCCESS else "out of time")
    manager.shutdown()


if __name__ == "__main__":
    main()
