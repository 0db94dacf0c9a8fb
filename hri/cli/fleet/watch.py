"""`hri fleet watch`: what happens to robots, a line of JSON each."""

from __future__ import annotations

import argparse
import json
import math

from hri.cli.fleet_options import add_looking_options, settings_of
from hri.cli.terminal.messages import Within
from hri.core.event_bus import matches
from hri.net.zenoh.fleet import ALL, fleet


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("robot", nargs="*", default=[ALL], help="names of robots; all of them without")
    add("--event", default="*", metavar="PATTERN", help="events to print (%(default)s)")
    add("--seconds", type=Within(float, 0.001), default=math.inf, metavar="S", help="end after")
    add_looking_options(parser)


def run(options: argparse.Namespace) -> int:
    with fleet(settings_of(options)) as found:
        for event in found.events(options.robot, options.seconds):
            if matches(options.event, event["event"]):
                print(json.dumps(event), flush=True)
    return 0
