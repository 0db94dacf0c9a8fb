"""`hri skill on`: a skill counts again."""

from __future__ import annotations

import argparse

from hri.cli.skill.plugged import add_app, chosen, plugged_in
from hri.core.quoting import report
from hri.robot.skills import turn


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="name of a skill")
    add_app(parser)


def run(options: argparse.Namespace) -> int:
    (name,) = chosen(plugged_in(options.app), [options.name])
    turn(name, on=True)
    report(f"{name} is on from the next start of the robot")
    return 0
