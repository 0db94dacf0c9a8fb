"""`hri skill off`: a skill counts no longer."""

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
    turn(name, on=False)
    report(f"{name} is off from the next start of the robot; `hri skill on {name}` undoes that")
    return 0
