"""`hri skill on` and `hri skill off`: whether a skill counts."""

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
    is_on = options.verb == "on"
    turn(name, on=is_on)
    undo = "" if is_on else f"; `hri skill on {name}` undoes that"
    report(f"{name} is {options.verb} from the next start of the robot{undo}")
    return 0
