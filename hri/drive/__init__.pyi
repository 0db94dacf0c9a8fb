from .behaviors import CommandGate as CommandGate
from .goal_behaviors import (
    Beeline as Beeline,
    DeadReckoning as DeadReckoning,
    FollowTarget as FollowTarget,
    ObstacleAvoidance as ObstacleAvoidance,
    Wander as Wander,
)
from .navigation_tasks import (
    come_here as come_here,
    follow as follow,
    go_to as go_to,
    wander as wander,
)
from .supervisor_relay import SupervisorRelay as SupervisorRelay
from .tasks import move as move, stop as stop, turn as turn
