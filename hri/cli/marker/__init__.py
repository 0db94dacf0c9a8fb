"""`hri marker`: print cards with markers and find them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.marker import check, find, list, print

COMMANDS = {
    "print": (print, "write a card with a marker or a QR code, to be printed"),
    "find": (find, "find markers in pictures: which, how far, and how they are turned"),
    "list": (list, "list the families of markers"),
    "check": (check, "check a table of cards, and list what each starts"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="marker_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.marker_command]
    status: int = module.run(options)
    return status
