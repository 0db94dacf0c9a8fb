"""`hri drive replay RUN --out run.png`: a picture or a film of a run, seen from above."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from hri.cli.drive.plan import Plan
from hri.cli.drive.recorded import read_run
from hri.cli.terminal.messages import Within
from hri.cli.terminal.progress_line import progress, waiting
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.hal.drivers.image_size import write_picture
from hri.simulation.navigation_trips import DEFAULT_POLICY, POLICIES

NAME = "replay"
"""The word given instead of a port."""
RATE = 20.0
"""Frames per second of a film."""
SPEED = 4.0
"""Default speed of a film, relative to real time."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group(f"hri drive {NAME} RUN").add_argument
    about = "a file of a run, the folder of a recording, or the number of a room to drive through"
    add("run", nargs="?", default="", metavar="RUN", help=about)
    add(
        "--out", type=Path, metavar="FILE", help="a .png, or a film such as .mp4 (default: run.png)"
    )
    about = "how to go through the room of that number (default: full)"
    add("--policy", choices=tuple(POLICIES), help=about)
    about = f"speed of the film relative to real time (default: {SPEED:g})"
    add("--speed", type=Within(float, 0.1, 100), default=SPEED, metavar="N", help=about)


def run(options: argparse.Namespace) -> int:
    """Draw it. Exit status 0."""
    if not options.run:
        raise HriError(f"no run given - hri drive {NAME} RUN --out run.png")
    if options.policy and not options.run.isdecimal():
        what = f"--policy {options.policy}: {options.run} is a recorded run"
        raise HriError(f"{what} - leave it out, or give the number of a room")
    out = options.out or Path("run.png")
    with waiting("reading and drawing the run"):
        plan = Plan(read_run(options.run, options.policy or DEFAULT_POLICY))
        if out.suffix.lower() == ".png":
            write_picture(out, plan.whole())
        else:
            _write_film(out, plan, options.speed)
    report(f"{out}: {plan.run.title or options.run}")
    return 0


def _write_film(path: Path, plan: Plan, speed: float) -> None:
    from hri.face.renderers.movie import check_movie, write_movie

    check_movie(path, RATE)
    indices = list(_indices(plan, speed))
    pictures = (plan.at(index) for index in indices)
    write_movie(path, progress(pictures, len(indices), path.name), RATE)


def _indices(plan: Plan, speed: float) -> Iterator[int]:
    """The moments that a film shows, evenly spaced in time."""
    moments = plan.run.moments
    number, time = 0, moments[0].time
    while time <= moments[-1].time:
        while number + 1 < len(moments) and moments[number + 1].time <= time:
            number += 1
        yield number
        time += speed / RATE
