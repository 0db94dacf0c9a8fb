"""`hri emotion`: check, list, try out and watch what the robot feels; a module for each command."""

from __future__ import annotations

import argparse
from contextlib import nullcontext

from hri.cli import forget
from hri.cli.emotion import check, list, simulate, story, watch
from hri.cli.terminal.progress_line import waiting

COMMANDS = {
    "check": (check, "load all emotion files, run their self-tests, report what is wrong"),
    "list": (list, "show personalities, stimuli and emotions"),
    "simulate": (simulate, "play events and print the feelings"),
    "story": (story, "play stories and say where the feelings are not as they expect"),
    "watch": (watch, "show what a running robot feels"),
    "forget": (forget, "the same as `hri forget`"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""
LIVE = ("watch", "forget")
"""Interactive commands."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="emotion_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    name = options.emotion_command
    module, about = COMMANDS[name]
    with nullcontext() if name in LIVE else waiting(about):
        status: int = module.run(options)
    return status
