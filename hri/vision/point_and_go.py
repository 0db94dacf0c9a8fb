"""Going to the place that someone points at in the picture of a camera.

pixel (x, y) -> Hri.PointAndGo -> goal -> Hri.ObstacleAvoidance -> Hri.CommandGate

The pixel is taken for a spot of a level floor, so the configuration must say how high the camera
is (`z`, cm) and how it is turned (`pitch`, radians, positive looks down).
"""

from __future__ import annotations

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.ports import Input, Output, Param
from hri.core.geometry import after_move
from hri.core.signals import Pose2D
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.vision.camera_view import CameraView


class PointAndGo(DeviceBehavior):
    """Makes a goal of a pixel that someone points at; the goal stays until another comes.

    A pixel that shows no floor fails the tick and leaves the goal as it was.
    """

    category = "vision"
    camera_id = Param("camera", "id of the camera")
    odometry_id = Param("odometry", "id of the odometry")

    x = Input[float]("double", "column of the pixel, from the left edge of the picture")
    y = Input[float]("double", "row of the pixel, from the upper edge; both come in one tick")
    reset = Input[bool]("boolean", "true forgets the goal; goes before a pixel", is_optional=True)
    goal = Output[Pose2D]("pose", "where to go, in the frame of the odometry; nothing: stay")

    def start(self, context: Context) -> None:
        super().start(context)
        self._camera = self.obtain(self.camera_id, Camera)
        self._odometry = self.obtain(self.odometry_id, Odometry)
        self._goal: Pose2D | None = None

    def compute(self, now: float, dt: float) -> None:
        x, y = self.x.value, self.y.value
        if self.reset.value:
            self._goal = None
        elif x is not None and y is not None:
            place = floor_seen(self._camera, x, y, now)
            self._goal = after_move(self._odometry.pose(now), *place)
        if self._goal is not None:
            self.goal.send(self._goal)


def floor_seen(camera: Camera, x: float, y: float, now: float) -> tuple[float, float]:
    """The spot of the floor at a pixel of a camera: meters ahead and to the left of the robot.

    Raises HriError as `CameraView.on_floor` does.
    """
    size = camera.width, camera.height
    return CameraView.of(camera).on_floor(x, y, size, camera.pan(now))
