"""The task that goes to the place someone points at in a picture: seeing and driving at once."""

from __future__ import annotations

from hri.core.geometry import after_move
from hri.drive.navigation_tasks import go_to_point, in_m
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.task.context import TaskContext
from hri.task.opening import opened
from hri.task.task import task
from hri.vision.point_and_go import floor_seen


@task("Hri.PointAndGo")
async def point_and_go(
    context: TaskContext, x: float, y: float, camera_id: str = "", near: float = 0.0
) -> None:
    """Go to the spot of the floor at a pixel of a camera, of the first one without an id.

    `x` and `y` are column and row, from the upper left corner of the picture. In the end it faces
    along the straight line to there. `near` is as for `Hri.GoTo`. Fails when it does not get there,
    and for a pixel that shows no floor.
    """
    async with (
        opened(context, Camera, camera_id) as camera,
        opened(context, Odometry, "odometry") as odometry,
    ):
        now = context.clock.now()
        goal = after_move(odometry.pose(now), *floor_seen(camera, x, y, now))
    await go_to_point(context, goal, near=in_m(near))
