"""`hri memory`: what the robot remembers of people; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.memory import export, list, show

COMMANDS = {
    "list": (list, "list the people that the robot remembers"),
    "show": (show, "show all that it remembers of a person"),
    "export": (export, "write all that it remembers as JSON"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""
EPILOG = "`hri forget NAME` forgets a person, `hri forget` everyone."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    commands = parser.add_subparsers(dest="memory_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.memory_command]
    status: int = module.run(options)
    return status
