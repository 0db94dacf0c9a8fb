"""Tasks that move the base; numbers are in the default units of `hri.task.units`.

DriveMoveDelta(distance, velocity=0, acceleration=0)
DriveTurnDelta(angle, velocity=0, acceleration=0)
MoveRelative(heading, [distance, angular_velocity, velocity])
TurnRelative(angle, velocity=0)
Stop()

A velocity or acceleration of 0 is a usual one. Angles go to the left.
"""

from hri.task.library import tasks_by_name

__all__ = ["DriveMoveDelta", "DriveTurnDelta", "MoveRelative", "Stop", "TurnRelative"]  # noqa: F822

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
