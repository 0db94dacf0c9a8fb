"""The end of a trapezoid profile: cruise, slow down evenly, arrive at rest."""

from __future__ import annotations

import math


def velocity_for(remaining: float, max_velocity: float, deceleration: float, dt: float) -> float:
    """The velocity for the next `dt` seconds on the way to a goal, meters or radians a second.

    `remaining` is signed: what is still to go. The velocity depends on where things are now, not on
    a plan made at the start, so a push or a slow base is made up for. Speeding up evenly is the
    command gate's part.
    """
    # Going on for dt seconds and only then slowing down must still end at the goal.
    step = deceleration * dt
    braking = math.sqrt(step * step + 2 * deceleration * abs(remaining)) - step
    # In this order a goal that is not a number gives one that is not, which the gate refuses.
    return math.copysign(min(braking, max_velocity), remaining)
