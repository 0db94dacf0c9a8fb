"""`hri face`: create, check, show, render and list faces; a module for each command."""

from __future__ import annotations

import argparse
from contextlib import nullcontext

from hri.cli.face import animate, check, export, lips, list, new, render, sheet, show
from hri.cli.terminal.progress_line import waiting

COMMANDS = {
    "render": (render, "draw one picture"),
    "sheet": (sheet, "draw all expressions and visemes, with labels"),
    "animate": (animate, "film a script for a face"),
    "lips": (lips, "film a face that moves its lips to a sound file"),
    "show": (show, "open a window with a moving face that updates when its drawings are saved"),
    "new": (new, "copy a face to start a new one from"),
    "check": (check, "load a face and report all mistakes"),
    "list": (list, "list all faces"),
    "export": (export, "write a baked face as JSON, for other programs"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""
LIVE = ("show",)
"""Interactive commands."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="face_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    name = options.face_command
    module, about = COMMANDS[name]
    with nullcontext() if name in LIVE else waiting(about):
        status: int = module.run(options)
    return status
