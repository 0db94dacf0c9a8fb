"""`hri marker`: print cards with markers and find them; a module for each command."""

from __future__ import annotations

import argparse

from hri.cli.marker import check, find, list, print
from hri.cli.terminal.subcommands import Commands, add_commands, run_command as run

COMMANDS: Commands = {
    "print": (print, "write a card with a marker or a QR code, to be printed"),
    "find": (find, "find markers in pictures: which, how far, and how they are turned"),
    "list": (list, "list the families of markers"),
    "check": (check, "check a table of cards, and list what each starts"),
}

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_commands(parser, COMMANDS)
