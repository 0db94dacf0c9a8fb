"""What the page, or a script, can ask of the robot: one table, with what each command takes.

The server and the interface's document are made from it; `actions` has what the robot then does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.studio.request_queue import STOP

PRESS = "press"
"""The argument that names a stop."""
LONGEST_TEXT = 500
"""Letters."""
LONGEST_NETWORK = 1_000_000
"""Letters of a network."""
FARTHEST = 100.0
"""Meters of a place from the middle of the room."""


@dataclass(frozen=True, slots=True)
class Argument:
    """What a command takes."""

    kind: type
    about: str
    is_optional: bool = False
    longest: int = LONGEST_TEXT
    """Letters of a text."""
    is_exact: bool = False
    """Whether the blanks around a text belong to it."""


@dataclass(frozen=True, slots=True)
class Command:
    """Something that the robot, or its simulated room, can be asked to do."""

    about: str
    arguments: Mapping[str, Argument] = field(default_factory=dict)
    is_open: bool = False
    """Whether anyone on this machine may ask, without code or token."""
    answer: str = "done"
    """What it answers."""


_NETWORK = {"name": Argument(str, "of a network that runs")}
_TEXT = {"text": Argument(str, "what is said")}
_WHO = {"who": Argument(str, "name of the person; the first without", is_optional=True)}
_PLACE = {
    "x": Argument(float, "meters ahead, in the room"),
    "y": Argument(float, "meters to the left, in the room"),
}
_ON = {"on": Argument(bool, "whether it is")}
HEAR = "hear"
COMMANDS: Mapping[str, Command] = {
    STOP: Command(
        "stop the base at once, until it is released",
        {PRESS: Argument(str, "its name: the same that comes by another way is done once", True)},
        is_open=True,
    ),
    "release": Command("let the base move again"),
    HEAR: Command(
        "hear a typed sentence as if it had been said",
        _TEXT,
        answer="`understood` is true, with `text`, `rule` and `tags`; false, with `reason`, "
        "`detail` and `nearest`, a sentence that is like it; or null where other words came before "
        "and it is not known yet, with `reason`",
    ),
    "say": Command("say a text", _TEXT),
    "hush": Command("stop speaking, and forget the texts that wait"),
    "talk": Command("hear while someone holds a button, until a moment after the last such", _ON),
    "mute": Command("make it deaf, or let it hear again", _ON),
    "watch": Command("switch the camera on or off", _ON),
    "visitor_say": Command("let a simulated person speak", {**_TEXT, **_WHO}),
    "visitor_nod": Command("let a simulated person nod", _WHO),
    "visitor_shake": Command("let a simulated person shake the head", _WHO),
    "visitor_go": Command("let a simulated person walk to a place", {**_PLACE, **_WHO}),
    "visitor_enter": Command("let a simulated person come in", _WHO),
    "visitor_leave": Command("let a simulated person go out", _WHO),
    "bump": Command("let someone push against the base"),
    "place": Command(
        "put a thing into the simulated room, or move it",
        {"name": Argument(str, "of the thing"), **_PLACE},
    ),
    "obstacle": Command(
        "put an obstacle into the simulated room, or move it",
        {"name": Argument(str, "of the obstacle"), **_PLACE},
    ),
    "remove": Command(
        "take a thing or an obstacle out of the simulated room",
        {"name": Argument(str, "of the thing or obstacle")},
    ),
    "network_start": Command(
        "run a network, in the place of the one of that name, should it run",
        {
            "path": Argument(str, "its file", longest=4000),
            "text": Argument(
                str,
                "what it is to be, if not as saved",
                True,
                LONGEST_NETWORK,
                is_exact=True,
            ),
        },
    ),
    "network_stop": Command("end a network that was started so", _NETWORK),
    "network_pause": Command(
        "let a network pause: every drive gets zero; or let it go on", {**_NETWORK, **_ON}
    ),
    "network_tick": Command(
        "let a paused network compute once; nothing of it leaves for the drive or the board",
        _NETWORK,
    ),
    "network_break": Command(
        "pause a network after the tick in which a condition holds",
        {
            **_NETWORK,
            "port": Argument(str, "an output, as behavior.output"),
            "condition": Argument(
                str, "such as < 30, == true, changes, or sent; without one it ends", True
            ),
        },
    ),
}
"""By name; the interface over HTTP has each as `POST /api/v1/NAME`."""


def checked(name: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of a command as it wants them. Raises HriError for what is wrong with them."""
    if name not in COMMANDS:
        raise HriError(f'no command "{name}" - {did_you_mean(name, COMMANDS)}')
    wanted = COMMANDS[name].arguments
    for other in given.keys() - wanted.keys():
        raise HriError(f'{name} takes no "{other}" - {did_you_mean(other, wanted, "leave it out")}')
    return {
        key: _checked(key, argument, given.get(key))
        for key, argument in wanted.items()
        if not argument.is_optional or given.get(key, "") != ""
    }


def _checked(key: str, argument: Argument, value: Any) -> Any:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if argument.kind is bool and isinstance(value, bool):
        return value
    if (
        argument.kind is str
        and isinstance(value, str)
        and 0 < len(value.strip()) <= argument.longest
    ):
        return value if argument.is_exact else value.strip()
    if argument.kind is float and is_number and -FARTHEST <= value <= FARTHEST:
        return float(value)
    wants = {
        bool: "true or false",
        str: f"a text of at most {argument.longest} letters",
        float: f"a number from -{FARTHEST:g} to {FARTHEST:g}",
    }[argument.kind]
    raise HriError(f'"{key}" must be {wants} - {argument.about}')
