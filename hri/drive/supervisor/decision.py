"""What the supervisor decides at one turn."""

from __future__ import annotations

from dataclasses import dataclass

from hri.core.signals import Twist
from hri.drive.supervisor.cause import Cause
from hri.hal.motion import REST
from hri.hal.rank import Rank


@dataclass(frozen=True, slots=True)
class Decision:
    """What the wheels are told."""

    twist: Twist
    level: Rank
    reason: Cause
    """Why it rests, or why it is slower than was asked."""
    target: Twist = REST
    """The velocity that `twist` leads to."""
    stop: Cause | None = None
    """Set in the one step in which it comes to rest, or the latch closes for a new reason."""
    must_wake: bool = False
    """Whether the base is to be greeted again, since it does not obey."""
    must_cut: bool = False
    """Whether all that the base does has to be ended, whoever began it: someone has just pressed a
    button, or let it go, at which a base may set off by itself."""
