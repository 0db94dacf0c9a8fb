"""What a robot of a fleet does for who proves the token: a table of verbs."""

from __future__ import annotations

import re
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import msgspec

from hri.core.errors import HriError, did_you_mean
from hri.core.origin import FLEET, caused_by
from hri.emotion.behaviors import EmotionModel
from hri.hal.battery import Battery
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.robot.app import load_app
from hri.speech.behaviors import Listener, Voice
from hri.task.context import TaskContext

BECAUSE = "another robot or program of the fleet asked for it"
LONGEST_TEXT = 500
"""Letters."""
MOST_ARGUMENTS = 20
FAREWELL = 0.2
"""Seconds in which the answer gets away before a robot ends."""
_APP = re.compile(r"[A-Za-z][\w-]{0,63}")


class Request(msgspec.Struct, array_like=True, forbid_unknown_fields=True, frozen=True):
    """Something that is asked for."""

    ticket: str
    verb: str
    arguments: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Asked:
    """The robot that is asked, in its loop."""

    robot: Robot
    context: TaskContext


async def answer_to(asked: Asked, request: Request) -> object:
    """Do what a request says; what came of it. Raises HriError for what cannot be done."""
    if request.verb not in VERBS:
        raise HriError(f'no request "{request.verb}" - {did_you_mean(request.verb, VERBS)}')
    with caused_by(FLEET):
        if request.verb != "state":
            told = {key: one for key, one in request.arguments.items() if key != "text"}
            asked.context.events.raise_event("fleet.asked", verb=request.verb, arguments=told)
        found = VERBS[request.verb](asked, request.arguments)
        return await found if isinstance(found, Awaitable) else found


def _state(asked: Asked, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """What `hri fleet list` shows."""
    robot, context = asked.robot, asked.context
    model = context.find_behavior(EmotionModel)
    feels = model.feeling() if model is not None else None
    battery = next(iter(context.resources.opened(Battery)), None)
    base = next(iter(context.resources.opened(EmergencyStop)), None)
    return {
        "app": robot.app.name,
        "seconds": context.clock.now(),
        "feels": feels.label if feels is not None else None,
        "battery": battery.level(context.clock.now()) if battery is not None else None,
        "base": None if base is None else "stopped" if base.is_latched else "free",
        "networks": sorted(robot.networks.runners),
        "tasks": sorted(
            {task.name for task in robot.tasks.installed if not task.name.startswith("_")}
        ),
    }


def _stop(asked: Asked, arguments: Mapping[str, Any]) -> None:
    asked.robot.stop_until_released(BECAUSE)


def _release(asked: Asked, arguments: Mapping[str, Any]) -> None:
    asked.robot.release()


def _say(asked: Asked, arguments: Mapping[str, Any]) -> None:
    asked.context.behavior(Voice).say(_text(arguments))


def _hear(asked: Asked, arguments: Mapping[str, Any]) -> None:
    asked.context.behavior(Listener).type_line(_text(arguments))


def _run(asked: Asked, arguments: Mapping[str, Any]) -> None:
    """Start a task of the app by name."""
    given = arguments.get("arguments", ())
    if not isinstance(given, list | tuple) or len(given) > MOST_ARGUMENTS:
        raise HriError(f"a task takes a list of at most {MOST_ARGUMENTS} arguments")
    app, name = asked.robot.app, str(arguments.get("task", ""))
    if "." not in name and name not in app.task_names():  # such as what tasks.py only imports
        raise HriError(f'no task "{name}" - {did_you_mean(name, app.task_names())}')
    asked.robot.tasks.install(app.task(name), *given)


async def _app(asked: Asked, arguments: Mapping[str, Any]) -> None:
    """End the app, and let another one of that machine run instead; only by name, not by path."""
    robot, name = asked.robot, str(arguments.get("app", ""))
    if robot.next_app is None:
        what = "this robot records, or ends with its app"
        raise HriError(f"{what} - start it with `hri run APP --fleet NAME`")
    if _APP.fullmatch(name) is None:
        raise HriError(f'"{name:.60}" is not the name of an app - take one of its machine')
    await asked.context.blocking(load_app, name)
    robot.next_app = name
    end = partial(robot.finish, why=f'the fleet asked for the app "{name}"')
    asked.context.clock.call_at(asked.context.clock.now() + FAREWELL, end)


def _text(arguments: Mapping[str, Any]) -> str:
    text = arguments.get("text")
    if not isinstance(text, str) or not 0 < len(text.strip()) <= LONGEST_TEXT:
        raise HriError(f"give a text of at most {LONGEST_TEXT} letters")
    return text.strip()


VERBS: Mapping[str, Callable[[Asked, Mapping[str, Any]], object]] = {
    "state": _state,
    "stop": _stop,
    "release": _release,
    "say": _say,
    "hear": _hear,
    "run": _run,
    "app": _app,
}
"""By name; `Member` itself answers `want`."""
