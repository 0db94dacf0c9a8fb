"""Tasks that move the base; numbers are in the default units of `hri.task.units`.

DriveMoveDelta(distance, velocity=0, acceleration=0)
DriveTurnDelta(angle, velocity=0, acceleration=0)
MoveRelative(heading, [distance, angular_velocity, velocity])
TurnRelative(angle, velocity=0)
GoTo(x, y, heading=None, near=0)      a place of the odometry frame, around what is in the way
GoBy(x, y, near=0)                    a point of the robot's own frame
PointAndGo(x, y, camera_id="", near=0)    the spot of the floor at a pixel of a picture
ComeHere(person="", distance=0)       to someone who is seen
FollowPerson(person="", distance=0, seconds=0)
Wander(seconds=0)
Stop()
Move(distance_m), Turn(angle_rad)     meters and radians, whatever the units are

A velocity, acceleration, distance or time of 0 is a usual one. Angles go to the left.
"""

from hri.task.library import tasks_by_name

__all__ = [  # noqa: F822
    "ComeHere",
    "DriveMoveDelta",
    "DriveTurnDelta",
    "FollowPerson",
    "GoBy",
    "GoTo",
    "Move",
    "MoveRelative",
    "PointAndGo",
    "Stop",
    "Turn",
    "TurnRelative",
    "Wander",
]

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
