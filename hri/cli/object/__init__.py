"""`hri object`: teach objects and recognize them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.object import attribute, check, learn, list, merge, remove, show, split, test

COMMANDS = {
    "learn": (learn, "learn an object from pictures, a video or the camera"),
    "list": (list, "list the objects of a set"),
    "show": (show, "draw the views of an object, with their features"),
    "attribute": (attribute, "set or list what is noted of an object"),
    "test": (test, "recognize objects in pictures"),
    "check": (check, "report objects that are too plain or look like others"),
    "remove": (remove, "remove objects from a set"),
    "merge": (merge, "write one set with the objects of several"),
    "split": (split, "write some objects of a set to a new one"),
}
"""Each is a module with `add_arguments(parser)` and `run(options) -> exit status`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="object_command", metavar="COMMAND", required=True)
    for name, (module, about) in COMMANDS.items():
        module.add_arguments(commands.add_parser(name, help=about, description=about))


def run(options: argparse.Namespace) -> int:
    module, _ = COMMANDS[options.object_command]
    status: int = module.run(options)
    return status
