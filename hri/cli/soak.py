"""`hri soak`: simulated hours of a large network; exit status 1 when anything leaks or is lost."""

from __future__ import annotations

import argparse
import math

from hri.testing.soak import Soak


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--hours", type=_hours, default=1.0, metavar="H", help="of simulated time (%(default)g)")
    add("--behaviors", type=_count, default=50, metavar="N", help="in the network (%(default)s)")


def _hours(text: str) -> float:
    value = float(text)
    if not 0.01 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} - write hours, 0.01 or more")
    return value


def _count(text: str) -> int:
    value = int(text)
    if not 1 <= value <= 1000:
        raise argparse.ArgumentTypeError(f"{text} - write a count, 1 to 1000")
    return value


def run(options: argparse.Namespace) -> int:
    verdict = Soak(options.hours, options.behaviors, lambda line: print(line, flush=True)).run()
    print(
        f"{verdict.hours:g} hours, {verdict.ticks} ticks, {verdict.events} events,"
        f" {verdict.tasks} tasks, {verdict.injected} values injected, {verdict.swaps} networks"
        f" swapped, {verdict.drives} drives, {verdict.crossings} bridges;"
        f" drift {verdict.drift:.1e} s, memory {verdict.growth / 1000:+.1f} kB"
    )
    for fault in verdict.faults[:20]:
        print(f"FAULT: {fault}")
    print("failed" if verdict.faults else "passed")
    return 1 if verdict.faults else 0
