"""`hri emotion forget`: erases what the robot remembers of how it felt, or of a person."""

from __future__ import annotations

import argparse

from hri.emotion.persistence import forget, memory_file


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = "A robot that is running forgets it, too, within a second or so."
    about = "forget only this person: what the robot thinks of them, and what they did by name"
    parser.add_argument("person", nargs="?", metavar="PERSON", help=about)


def run(options: argparse.Namespace) -> int:
    path = memory_file()
    was_there = forget(path, options.person)
    what = options.person or "all that was felt"
    print(f"{path}: {what} is forgotten" if was_there else f"{path}: there is nothing to forget")
    return 0
