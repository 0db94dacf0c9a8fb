"""`hri fleet say|hear|run|app|stop|release`: what robots are asked to do."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from hri.cli.fleet_options import add_looking_options, settings_of
from hri.core.errors import HriError
from hri.core.quoting import message_line, report
from hri.net.zenoh.fleet import ALL, fleet


def add_arguments(parser: argparse.ArgumentParser) -> None:
    verb = parser.get_default("verb")
    parser.add_argument("robot", help=f'name of a robot, or "{ALL}"')
    if verb in ("say", "hear"):
        parser.add_argument("text")
    elif verb == "run":
        parser.add_argument("task", help="name of a task of its app")
        about = "what the task takes: numbers, true, false; anything else is a text"
        parser.add_argument("argument", nargs="*", help=about)
    elif verb == "app":
        parser.add_argument("app", help="name of an app on its machine")
    add_looking_options(parser)


def run(options: argparse.Namespace) -> int:
    """Ask each robot; 1 where one of them did not do it."""
    failed = 0
    with fleet(settings_of(options)) as found:
        for name in found.chosen([options.robot]):
            try:
                found.ask(name, options.verb, _arguments(options))
                report(f"{name}: done")
            except HriError as error:
                failed = 1
                print(message_line(str(error)), file=sys.stderr)
    return failed


def _arguments(options: argparse.Namespace) -> dict[str, Any]:
    if options.verb in ("say", "hear"):
        return {"text": options.text}
    if options.verb == "run":
        return {"task": options.task, "arguments": list(map(_value, options.argument))}
    return {"app": options.app} if options.verb == "app" else {}


def _value(text: str) -> Any:
    """A number or a truth as such, anything else as the text that it is."""
    try:
        value = json.loads(text)
    except ValueError:
        return text
    return value if isinstance(value, bool | int | float) else text
