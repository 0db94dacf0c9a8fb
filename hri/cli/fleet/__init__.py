"""`hri fleet`: the robots that know each other; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.fleet import asking, list, watch

COMMANDS = {
    "list": (list, "list the robots, and how they are"),
    "watch": (watch, "print what happens to robots, a line of JSON each"),
    "say": (asking, "let robots say a text"),
    "hear": (asking, "let robots hear a typed sentence"),
    "run": (asking, "start a task of the app of robots"),
    "stop": (asking, "stop the bases of robots until they are released"),
    "release": (asking, "let the bases of robots move again"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""
EPILOG = "A robot joins with `hri run APP --fleet NAME`; docs/fleet.md begins with two of them."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    commands = parser.add_subparsers(dest="fleet_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        command = commands.add_parser(name, help=about, description=about)
        command.set_defaults(verb=name)
        module.add_arguments(command)


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.fleet_command]
    status: int = module.run(options)
    return status
