"""`hri object`: teach objects and recognize them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.object import attribute, check, learn, list, merge, remove, show, split, test
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
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

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_commands(parser, COMMANDS)
