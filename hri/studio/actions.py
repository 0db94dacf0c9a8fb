"""What the robot does when it is asked: an action for each of `commands`."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hri.conversation.examples import nearest_sentence
from hri.conversation.puzzlement import as_said
from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.origin import STUDIO, caused_by
from hri.core.signals import Rejection
from hri.hal.camera import Camera
from hri.robot import Robot
from hri.simulation.room import Wall
from hri.simulation.visitor import Visitor
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import Grammar
from hri.speech.understanding import Heard
from hri.studio.commands import checked
from hri.studio.request_queue import STOP
from hri.studio.running import RunningNetworks
from hri.task.context import TaskContext

BECAUSE = "someone pressed stop in the studio"
HOLD = 1.5
"""Seconds of hearing for each word that the button is still held: a page may vanish meanwhile."""
UNDERSTOOD_WITHIN = 1.0
"""Seconds after which the answer does not wait for what becomes of a sentence."""
LOOK_EVERY = 0.02
"""Seconds between two looks at it."""
LONGEST_TOLD = 4000
"""Letters of an argument that its event has; a whole network is left out."""


@dataclass(frozen=True, slots=True)
class Asked:
    """The robot that is asked, in its loop."""

    robot: Robot
    context: TaskContext
    networks: RunningNetworks

    @property
    def now(self) -> float:
        """Seconds."""
        return self.context.clock.now()

    @property
    def world(self) -> SimulatedWorld:
        """The simulated room. Raises HriError where the room is real."""
        found = self.context.resources.opened(SimulatedWorld)
        if not found:
            raise HriError("this room is real - only simulated people can be asked")
        return found[0]

    def visitor(self, name: str) -> Visitor:
        """A simulated person, or the first. Raises HriError where there is none."""
        return Visitor(self.world, self.context.clock, name)


def _inside(world: SimulatedWorld, x: float, y: float) -> None:
    """Raises HriError for a place outside of the walls."""
    walls = [one for one in world.room.obstacles if isinstance(one, Wall)]
    if not walls:
        return
    xs = [end for wall in walls for end in (wall.x1, wall.x2)]
    ys = [end for wall in walls for end in (wall.y1, wall.y2)]
    if not (min(xs) < x < max(xs) and min(ys) < y < max(ys)):
        inside = f"x from {min(xs):g} to {max(xs):g} and y from {min(ys):g} to {max(ys):g}"
        raise HriError(f"({x:g}, {y:g}) is outside of the room's walls - choose {inside}")


def _place(asked: Asked, name: str, x: float, y: float) -> None:
    _inside(asked.world, x, y)
    asked.world.advance(asked.now)
    pose, radius = asked.world.base.pose, asked.world.base.limits.radius
    if math.dist((pose.x, pose.y), (x, y)) <= radius:
        raise HriError(f"the robot stands there - choose a place {radius:.1f} m away from it")
    asked.world.place(name, x, y)


def _obstacle(asked: Asked, name: str, x: float, y: float) -> None:
    _inside(asked.world, x, y)
    asked.world.put_obstacle(name, x, y, asked.now)


def _visitor_go(asked: Asked, x: float, y: float, who: str = "") -> None:
    _inside(asked.world, x, y)
    asked.visitor(who).go(x, y)


def _say(asked: Asked, text: str) -> None:
    asked.context.behavior(Voice).say(text)


def _hush(asked: Asked) -> None:
    asked.context.behavior(Voice).hush()


def _hear(asked: Asked, text: str) -> Awaitable[dict[str, Any]]:
    told: list[Heard] = []
    listener = asked.context.behavior(Listener)
    listener.type_line(text, told.append)
    return _understood(asked.context.clock, told, listener.loaded_grammar, text)


async def _understood(
    clock: Clock, told: Sequence[Heard], grammar: Grammar, text: str
) -> dict[str, Any]:
    """What became of a typed sentence: the rule and tags, or why it does not count."""
    until = clock.now() + UNDERSTOOD_WITHIN
    while not told and clock.now() < until:
        await clock.sleep(LOOK_EVERY)
    if not told:
        return {"understood": None, "reason": "not yet: other words came before"}
    if isinstance(heard := told[0], Rejection):
        nearest = as_said(nearest_sentence(grammar, text))
        why = {"reason": heard.reason, "detail": heard.detail, "nearest": nearest}
        return {"understood": False, **why}
    return {
        "understood": True,
        "text": heard.text,
        "rule": heard.rule,
        "tags": dict(heard.tags),
    }


def _talk(asked: Asked, on: bool) -> None:
    listener = asked.context.behavior(Listener)
    if on and not listener.is_held:
        _hush(asked)
    listener.hold(HOLD if on else 0.0)


def _mute(asked: Asked, on: bool) -> None:
    asked.context.behavior(Listener).is_muted = on
    asked.context.events.raise_event("microphone.muted", muted=on)


def _watch(asked: Asked, on: bool) -> None:
    for camera in asked.context.resources.opened(Camera):
        camera.switch(on)


ACTIONS: Mapping[str, Callable[..., object]] = {
    STOP: lambda asked, press="": asked.robot.stop_until_released(BECAUSE),
    "release": lambda asked: asked.robot.release(),
    "hear": _hear,
    "say": _say,
    "hush": _hush,
    "talk": _talk,
    "mute": _mute,
    "watch": _watch,
    "visitor_say": lambda asked, text, who="": asked.visitor(who).say(text),
    "visitor_nod": lambda asked, who="": asked.visitor(who).nod(),
    "visitor_shake": lambda asked, who="": asked.visitor(who).shake(),
    "visitor_go": _visitor_go,
    "visitor_enter": lambda asked, who="": asked.visitor(who).enter(),
    "visitor_leave": lambda asked, who="": asked.visitor(who).leave(),
    "bump": lambda asked: asked.visitor("").bump(),
    "place": _place,
    "obstacle": _obstacle,
    "remove": lambda asked, name: asked.world.take_away(name),
    "network_start": lambda asked, path, text="": asked.networks.start(asked.context, path, text),
    "network_stop": lambda asked, name: asked.networks.stop(name),
    "network_pause": lambda asked, name, on: asked.networks.pause(name, on),
    "network_tick": lambda asked, name: asked.networks.tick(name),
    "network_break": lambda asked, name, port, condition="": asked.networks.break_at(
        name, port, condition
    ),
}


def obey(asked: Asked, name: str, given: Mapping[str, Any]) -> Awaitable[object] | None:
    """Do what a command says; where that takes a while, what to await for the answer.

    Raises HriError when it cannot be done.
    """
    arguments = checked(name, given)
    is_repeated = name == "talk" and arguments["on"] and asked.context.behavior(Listener).is_held
    with caused_by(STUDIO):
        done = ACTIONS[name](asked, **arguments)
        if not is_repeated:
            # The words of "hear" are in `speech.heard`, and if rejected are nobody's business.
            told = {} if name == "hear" else _short(arguments)
            asked.context.events.raise_event("studio.asked", command=name, arguments=told)
    return done if isinstance(done, Awaitable) else None


def _short(arguments: Mapping[str, Any]) -> dict[str, Any]:
    return {key: one for key, one in arguments.items() if len(str(one)) <= LONGEST_TOLD}
