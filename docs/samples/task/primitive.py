"""A primitive: a task that is a network, here one that creeps ahead until it has come 30 cm far."""

import math

from hri.core import Pose2D
from hri.task import TaskStatus, get_task_manager
from hri.task.primitive import Primitive, primitive

WAY = 0.3  # meters
NEAR = 30.0  # cm, the stop limit of the network


@primitive("Examples.Creep")
class Creep(Primitive):
    """Watches its network; how many meters it has come when it ends."""

    def start(self) -> None:
        self._first: Pose2D | None = None
        self.on_value("odometry", "pose", self.look_at_pose)
        self.on_value("sensor", "distance", self.look_ahead)

    def look_at_pose(self, pose: Pose2D, now: float) -> None:
        self._first = self._first or pose
        way = math.dist((pose.x, pose.y), (self._first.x, self._first.y))
        if way >= WAY:
            self.set_status(TaskStatus.SUCCESS, way)

    def look_ahead(self, distance: float, now: float) -> None:
        if distance < NEAR:
            self.set_status(TaskStatus.FAILURE, f"something is {distance:.0f} cm ahead")


def main() -> None:
    """Creep once."""
    print(f"crept {Creep():.2f} m")
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
