from .behaviors import CommandGate as CommandGate
from .covered_ground import CoveredGround as CoveredGround
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
from .push_detector import PushDetector as PushDetector
from .supervisor_relay import SupervisorRelay as SupervisorRelay
from .tasks import (
    CRUISE as CRUISE,
    TURN_RATE as TURN_RATE,
    move as move,
    stop as stop,
    turn as turn,
)
