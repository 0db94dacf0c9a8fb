"""`hri memory`: what the robot remembers of people; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.memory import export, list, show
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
    "list": (list, "list the people that the robot remembers"),
    "show": (show, "show all that it remembers of a person"),
    "export": (export, "write all that it remembers as JSON"),
}
EPILOG = "`hri forget NAME` forgets a person, `hri forget` everyone."

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add_commands(parser, COMMANDS)
