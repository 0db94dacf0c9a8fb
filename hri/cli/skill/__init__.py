"""`hri skill`: what an app can do beside its own; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.skill import check, list, new, test, turning

COMMANDS = {
    "list": (list, "list the skills of an app, and which are on"),
    "new": (new, "create a skill that is plugged in at once"),
    "check": (check, "report mistakes, and sentences that other commands have or sound like"),
    "test": (test, "play the dialogues of a skill's page"),
    "on": (turning, "turn a skill on again"),
    "off": (turning, "turn a skill off"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""
EPILOG = "The page docs/skills.md makes one, step by step."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    commands = parser.add_subparsers(dest="skill_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.skill_command]
    status: int = module.run(options)
    return status
