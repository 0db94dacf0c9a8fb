"""What the robot does when it is asked: an action for each of `commands`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hri.core.errors import HriError
from hri.hal.camera import Camera
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.simulation.visitor import Visitor
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener, Voice
from hri.studio.commands import checked
from hri.studio.link import STOP
from hri.task.context import TaskContext

BECAUSE = "someone pressed stop in the studio"


@dataclass(frozen=True, slots=True)
class Asked:
    """The robot that is asked, in its loop."""

    robot: Robot
    context: TaskContext

    @property
    def world(self) -> SimulatedWorld:
        """The simulated room. Raises HriError where the room is real."""
        found = self.context.resources.opened(SimulatedWorld)
        if not found:
            raise HriError("this room is real - only simulated people can be asked")
        return found[0]

    @property
    def visitor(self) -> Visitor:
        """The simulated person. Raises HriError where there is none."""
        return Visitor(self.world, self.context.clock)


def _stop(asked: Asked) -> None:
    asked.robot.tasks.take_away("drive")
    asked.context.events.raise_event("drive.halt", because=BECAUSE)
    for base in asked.context.resources.opened(EmergencyStop):
        base.stop_latched(BECAUSE)


def _release(asked: Asked) -> None:
    for base in asked.context.resources.opened(EmergencyStop):
        base.unlatch()


def _say(asked: Asked, text: str) -> None:
    asked.context.behavior(Voice).say(text)


def _hush(asked: Asked) -> None:
    asked.context.behavior(Voice).hush()


def _hear(asked: Asked, text: str) -> None:
    asked.context.behavior(Listener).type_line(text)


def _mute(asked: Asked, on: bool) -> None:
    asked.context.behavior(Listener).is_muted = on
    asked.context.events.raise_event("microphone.muted", muted=on)


def _watch(asked: Asked, on: bool) -> None:
    for camera in asked.context.resources.opened(Camera):
        camera.switch(on)


ACTIONS: Mapping[str, Callable[..., object]] = {
    STOP: _stop,
    "release": _release,
    "hear": _hear,
    "say": _say,
    "hush": _hush,
    "mute": _mute,
    "watch": _watch,
    "visitor_say": lambda asked, text: asked.visitor.say(text),
    "visitor_nod": lambda asked: asked.visitor.nod(),
    "visitor_shake": lambda asked: asked.visitor.shake(),
    "visitor_go": lambda asked, x, y: asked.visitor.go(x, y),
    "visitor_enter": lambda asked: asked.visitor.enter(),
    "visitor_leave": lambda asked: asked.visitor.leave(),
    "bump": lambda asked: asked.visitor.bump(),
    "place": lambda asked, name, x, y: asked.world.place(name, x, y),
}


def obey(asked: Asked, name: str, given: Mapping[str, Any]) -> None:
    """Do what a command says. Raises HriError when it cannot be done."""
    arguments = checked(name, given)
    ACTIONS[name](asked, **arguments)
