"""`hri color`: teach colors and find them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.color import check, learn, list, remove, show, test

COMMANDS = {
    "learn": (learn, "learn a color from boxes in pictures, a video or the camera"),
    "list": (list, "list the colors that can be found by name"),
    "show": (show, "draw the chroma that has a color"),
    "test": (test, "find colors in pictures"),
    "check": (check, "report damaged colors, and colors that are hard to tell apart"),
    "remove": (remove, "remove colors of your own"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="color_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.color_command]
    status: int = module.run(options)
    return status
