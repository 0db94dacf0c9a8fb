"""A robot that is a companion: it hears, feels, shows a face, speaks, sees a nod and moves.

    from hri import Robot

    with Robot() as robot:
        robot.say("Hello.")
        robot.show("happy")
        if robot.ask("Shall I come closer?"):
            robot.move(0.5)

The map, from what you hold in your hand down to what everything stands on:

    Robot                       opens resources, runs networks and tasks
    hri.face.render_face        a picture of the face as a numpy array
    hri.behavior.behavior       Behavior, and hri.behavior.ports: Input, Output, Param
    hri.task.context            what a task may use
    hri.hal                     one interface a kind of device; drivers in hri.hal.drivers
    hri.core.signals            the values that travel
    hri.core.clock              RealClock, FakeClock
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hri.robot import Robot

__all__ = ["Robot"]

# Read when numpy is first imported. The matrices here are small: more threads make their products
# slower (three times, for the phone network), and take the core that the robot loop runs on.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def __getattr__(name: str) -> object:
    # Robot brings in every subsystem; tools that need only a part start faster without it.
    if name == "Robot":
        from hri.robot import Robot

        return Robot
    raise AttributeError(f"module hri has no attribute {name!r}")
