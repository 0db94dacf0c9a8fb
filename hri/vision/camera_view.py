"""How a camera sees: where on the robot it is, how wide its view, and what that makes of pixels."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from hri.core.errors import HriError
from hri.core.geometry import ROBOT_FROM_CAMERA, Matrix, Pose3D
from hri.hal.camera import Camera

EYE_DISTANCE = 0.063
"""Meters between the pupils of an adult, in the mean; people differ by 10 % (Dodgson, "Variation
and extrema of human interpupillary distance", 2004)."""
FACE_SIZE = 0.178
"""Meters from chin to hairline, which the box of a face takes."""
FARTHEST_FLOOR = 10.0
"""Meters; beyond it a pixel more or less is a long way."""

Size = tuple[int, int]
"""Width and height of a picture in pixels."""


@dataclass(frozen=True, slots=True)
class CameraView:
    """A pinhole camera on the robot; pictures of it may come in any size.

    Raises HriError for a field of view that no lens has.
    """

    field_of_view: float = Camera.field_of_view
    """Radians across the whole width of the picture."""
    mount: Pose3D = field(default_factory=Pose3D)
    """Where it is fixed to the robot and how it is turned."""

    def __post_init__(self) -> None:
        if not 0 < self.field_of_view < math.pi:
            what = f"a field of view of {self.field_of_view:g} rad"
            raise HriError(
                f"{what} is out of range - give the angle across the picture, above 0, below pi"
            )

    @classmethod
    def of(cls, camera: Camera) -> CameraView:
        """The view of a camera, as its configuration has it. Raises HriError."""
        return cls(camera.field_of_view, camera.manager.pose_of(camera.id))

    def focal_length(self, size: Size) -> float:
        """Pixels."""
        return size[0] / 2 / math.tan(self.field_of_view / 2)

    def toward(self, x: float, y: float, size: Size) -> tuple[float, float]:
        """Bearing (to the left) and elevation (up) of a pixel from the camera, radians.

        Relative to the robot's straight ahead, however the camera is turned.
        """
        ahead, left, up = self._ray(x, y, size)
        return math.atan2(left, ahead), math.atan2(up, math.hypot(ahead, left))

    def on_floor(self, x: float, y: float, size: Size, pan: float = 0.0) -> tuple[float, float]:
        """Where the floor is that a pixel shows: meters ahead of the robot and to its left.

        `pan` is what the camera is turned to the left beside its mount, radians. Raises HriError
        for a pixel outside of the picture, at or above the horizon, or of what is too far away to
        tell, and for a camera whose height is not known.
        """
        if not (0 <= x <= size[0] and 0 <= y <= size[1]):
            what = f"({x:g}, {y:g}) is outside of a picture of {size[0]} x {size[1]}"
            raise HriError(f"{what} - count columns and rows from its upper left corner")
        if self.mount.z <= 0:
            remedy = 'write its z, centimeters above the floor: <Parameter name="z" value="40"/>'
            raise HriError(f"the height of the camera is not in the configuration - {remedy}")
        ahead, left, up = self._ray(x, y, size)
        level = math.hypot(ahead, left)
        if up >= 0 or self.mount.z * level / -up > FARTHEST_FLOOR:
            what = f"({x:g}, {y:g}) shows no floor within {FARTHEST_FLOOR:g} m"
            raise HriError(f"{what} - point at the floor, lower in the picture")
        far = self.mount.z * level / -up
        bearing = math.atan2(left, ahead) + pan
        return self.mount.x + far * math.cos(bearing), self.mount.y + far * math.sin(bearing)

    def horizon(self, size: Size) -> float:
        """Pixels from the top: how far down the middle of a picture shows what is far away at the
        height of the camera.
        """
        up = self.toward(size[0] / 2, size[1] / 2, size)[1]
        return size[1] / 2 + self.focal_length(size) * math.tan(up)

    def distance(self, x: float, y: float, pixels: float, meters: float, size: Size) -> float:
        """Distance in meters to an object of known size from its size in pixels; NaN for 0 pixels.

        The size is measured across the line of sight.
        """
        if pixels <= 0:
            return math.nan
        focal = self.focal_length(size)
        depth = focal * meters / pixels
        return depth * math.hypot(x - size[0] / 2, y - size[1] / 2, focal) / focal

    def pointed(
        self, direction: tuple[float, float, float], x: float, y: float, size: Size
    ) -> tuple[float, float]:
        """Bearing (to the left) and elevation (up) in which something at a pixel points, radians.

        `direction` is as it looks from the camera there: right, down and away from the camera.
        """
        line = np.array([x - size[0] / 2, y - size[1] / 2, self.focal_length(size)])
        line /= np.linalg.norm(line)
        # The turn from the middle of the picture to the pixel: about their common normal.
        normal = np.array([-line[1], line[0], 0.0])
        cross = np.array([[0, 0, normal[1]], [0, 0, -normal[0]], [-normal[1], normal[0], 0]])
        turn = np.eye(3) + cross + cross @ cross / (1 + line[2])
        in_robot: Matrix = ROBOT_FROM_CAMERA @ (turn @ np.array(direction))
        ahead, left, up = self.mount.rotation() @ in_robot
        return math.atan2(left, ahead), math.atan2(up, math.hypot(ahead, left))

    def _ray(self, x: float, y: float, size: Size) -> Matrix:
        """From the camera through a pixel, in the robot's axes; of any length."""
        in_camera = np.array([x - size[0] / 2, y - size[1] / 2, self.focal_length(size)])
        ray: Matrix = self.mount.rotation() @ (ROBOT_FROM_CAMERA @ in_camera)
        return ray
