"""The task that goes to the place someone points at in a picture: seeing and driving at once."""

from __future__ import annotations

from hri.core.errors import HriError
from hri.core.geometry import after_move
from hri.drive.navigation_tasks import go_to_point
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.task.context import TaskContext
from hri.task.task import task
from hri.vision.point_and_go import floor_seen


@task("Hri.PointAndGo")
async def point_and_go(context: TaskContext, x: float, y: float, camera_id: str = "") -> None:
    """Go to the spot of the floor at a pixel of a camera, of the first one without an id.

    `x` and `y` are column and row, from the upper left corner of the picture. In the end it faces
    along the straight line to there. Fails when it does not get there, and for a pixel that shows
    no floor.
    """
    resources, now = context.resources, context.clock.now()
    camera = resources.obtain(camera_id, Camera) if camera_id else resources.find(Camera)
    if camera is None:
        raise HriError("no camera in the configuration - add one")
    odometry = resources.obtain("odometry", Odometry)
    try:
        goal = after_move(odometry.pose(now), *floor_seen(camera, x, y, now))
    finally:
        resources.release(odometry)
        resources.release(camera)
    await go_to_point(context, goal)
