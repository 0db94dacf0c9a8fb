"""`hri soak`: runs simulated hours to find leaks and losses; exit status 1 when there are any."""

from __future__ import annotations

import argparse

from hri.bench.companion_soak import CompanionSoak
from hri.bench.network_soak import Soak
from hri.cli.terminal.messages import Within
from hri.core.quoting import report


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "--hours",
        type=Within(float, 0.01),
        default=1.0,
        metavar="H",
        help="hours of simulated time (%(default)g)",
    )
    add(
        "--behaviors",
        type=Within(int, 1, 1000),
        default=50,
        metavar="N",
        help="behaviors in the network (%(default)s)",
    )
    add("--companion", action="store_true", help="run the companion instead of a network")


def run(options: argparse.Namespace) -> int:
    told, faults = _companion(options) if options.companion else _network(options)
    print(told)
    for fault in faults[:20]:
        report(f"FAULT: {fault}")
    print("failed" if faults else "passed")
    return 1 if faults else 0


def _network(options: argparse.Namespace) -> tuple[str, list[str]]:
    """Results of the large network, and its faults."""
    verdict = Soak(options.hours, options.behaviors, _tell).run()
    told = (
        f"{verdict.hours:g} hours, {verdict.ticks} ticks, {verdict.events} events,"
        f" {verdict.tasks} tasks, {verdict.injected} values injected, {verdict.swaps} networks"
        f" swapped, {verdict.drives} drives, {verdict.crossings} bridges;"
        f" drift {verdict.drift:.1e} s, memory {verdict.growth / 1000:+.1f} kB"
    )
    return told, verdict.faults


def _companion(options: argparse.Namespace) -> tuple[str, list[str]]:
    """Results of the companion, and its faults."""
    verdict = CompanionSoak(options.hours, _tell).run()
    told = (
        f"{verdict.hours:g} hours, {verdict.visits} visits, {verdict.events} events,"
        f" {verdict.answered} answers to {verdict.lines} lines;"
        f" memory {verdict.growth:+.1f} MB"
    )
    return told, verdict.faults


def _tell(line: str) -> None:
    print(line, flush=True)
