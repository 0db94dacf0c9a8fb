"""`hri color`: teach colors and find them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.color import check, learn, list, remove, show, test
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
    "learn": (learn, "learn a color from boxes in pictures, a video or the camera"),
    "list": (list, "list the colors that can be found by name"),
    "show": (show, "draw the chroma that has a color"),
    "test": (test, "find colors in pictures"),
    "check": (check, "report damaged colors, and colors that are hard to tell apart"),
    "remove": (remove, "remove colors of your own"),
}

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_commands(parser, COMMANDS)
