"""`hri skill`: what an app can do beside its own; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.skill import check, list, new, test, turning
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
    "list": (list, "list the skills of an app, and which are on"),
    "new": (new, "create a skill that is plugged in at once"),
    "check": (check, "report mistakes, and sentences that other commands have or sound like"),
    "test": (test, "play the dialogues of a skill's page"),
    "on": (turning, "turn a skill on again"),
    "off": (turning, "turn a skill off"),
}
EPILOG = "The page docs/skills.md makes one, step by step."

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add_commands(parser, COMMANDS)
