"""`hri fleet`: the robots that know each other; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.fleet import asking, list, watch
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
    "list": (list, "list the robots, and how they are"),
    "watch": (watch, "print what happens to robots, a line of JSON each"),
    "say": (asking, "let robots say a text"),
    "hear": (asking, "let robots hear a typed sentence"),
    "run": (asking, "start a task of the app of robots"),
    "app": (asking, "run another app on robots"),
    "stop": (asking, "stop the bases of robots until they are released"),
    "release": (asking, "let the bases of robots move again"),
}
EPILOG = "A robot joins with `hri run APP --fleet NAME`; docs/fleet.md begins with two of them."

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add_commands(parser, COMMANDS)
