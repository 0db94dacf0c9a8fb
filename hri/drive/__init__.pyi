from .behaviors import CommandGate as CommandGate
from .goals import DeadReckoning as DeadReckoning, FollowTarget as FollowTarget, Wander as Wander
from .going import Beeline as Beeline, ObstacleAvoidance as ObstacleAvoidance
from .guard import BaseGuard as BaseGuard
from .tasks import move as move, stop as stop, turn as turn
from .travel import come_here as come_here, follow as follow, go_to as go_to, wander as wander
