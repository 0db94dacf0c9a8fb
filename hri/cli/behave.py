"""`behave NETWORK.xml`: run a behavior network at its rate."""

from __future__ import annotations

import argparse
import logging
import sys
from collections.abc import Sequence
from functools import partial
from typing import TextIO

import trio

from hri.behavior.behavior import Context, bridge_ports
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.behavior.tick_statistics import Statistics
from hri.cli.door_options import add_door_options, doors_of
from hri.cli.port_plot import PortPlot
from hri.cli.terminal.ending import Ending
from hri.cli.terminal.exit_status import status_of
from hri.cli.terminal.messages import LineFormatter, OptionParser, Within
from hri.cli.terminal.streams import unfailing_output
from hri.core.clock import Clock, FakeClock, RealClock
from hri.core.errors import HriError, did_you_mean
from hri.core.event_bus import EventBus
from hri.core.quoting import report
from hri.core.realtime import become_realtime
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager

log = logging.getLogger("hri.behave")
SHORTEST = 0.01
"""Seconds; minimum of durations and intervals."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a network. Exit status 0, 1 when a behavior failed, 2 when a file or option is wrong."""
    options = _parser().parse_args(sys.argv[1:] if arguments is None else arguments)
    if options.fast and options.duration is None and options.invocation_count is None:
        print("behave: --fast runs as fast as it can - add --duration S", file=sys.stderr)
        return 2
    ending = Ending()
    with unfailing_output(), ending.kept_for_later():
        return status_of(lambda: _behave(options, ending))


def _parser() -> argparse.ArgumentParser:
    parser = OptionParser(prog="behave", description="Run a behavior network.")
    add = parser.add_argument
    add("network", metavar="NETWORK.xml", help="path, or name in the search folders")
    add(
        "--debug",
        nargs="?",
        const="",
        metavar="CATEGORY",
        help="print debug messages, of one part or all",
    )
    add("--duration", type=Within(float, SHORTEST), metavar="S", help="end after this many seconds")
    add("--invocation-count", type=Within(int, 1), metavar="N", help="end after this many ticks")
    add("--invocation-interval", type=Within(float, SHORTEST), metavar="S", help="seconds per tick")
    add("--without-resources", action="store_true", help="configure no devices at all")
    add("--load-all-resources", action="store_true", help="open every device at the start")
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add(
        "--plot",
        action="append",
        default=[],
        metavar="PORT",
        help="plot an output: ID.OUTPUT",
    )
    add("--realtime", action="store_true", help="run with real-time priority, where allowed")
    add("--fast", action="store_true", help="fake time, as fast as the machine can")
    add_door_options(parser)
    return parser


CATEGORIES = (
    *("behave", "behavior", "drive", "emotion", "events", "face", "memory", "net", "network"),
    *("recording", "resources", "service", "studio", "task", "vision", "whereabouts"),
)
"""Values of `--debug`: the parts of `hri` that write a log."""


class _Lines(logging.StreamHandler[TextIO]):
    """Writes the log, and ends the program when its reader is gone."""

    def handleError(self, record: logging.LogRecord) -> None:
        error = sys.exc_info()[1]
        if isinstance(error, BrokenPipeError):
            raise error
        super().handleError(record)


def _set_up_logging(debug: str | None) -> None:
    handler = _Lines(sys.stdout)
    form = "%(levelname)s - %(message)s [%(filename)s:%(lineno)d]"
    handler.setFormatter(LineFormatter(form))
    ours = logging.getLogger("hri")
    ours.handlers = [handler]
    ours.setLevel(logging.INFO)
    if debug and debug not in CATEGORIES:
        remedy = did_you_mean(debug, CATEGORIES)
        raise HriError(f'behave: --debug has no category "{debug}" - {remedy}')
    if debug is not None:
        logging.getLogger(f"hri.{debug}" if debug else "hri").setLevel(logging.DEBUG)


def _behave(options: argparse.Namespace, ending: Ending) -> int:
    _set_up_logging(options.debug)
    print("Initializing...", end="", flush=True)
    clock: Clock = FakeClock() if options.fast else RealClock()
    resources = _resources(options, clock)
    print("ok", flush=True)
    log.info("Loading network file.")
    network = load_network(options.network)
    for warning in network.warnings:
        log.warning("%s", warning)
    network.check()
    if options.invocation_interval is not None:
        network.interval = options.invocation_interval
    doors = doors_of(options)
    for line in doors.unknown(bridge_ports(network.behaviors)):
        log.warning(line)
    lent = Context(clock, EventBus(clock), resources, doors=doors)
    runner = Runner(network, lent)
    plots = [PortPlot(runner, port) for port in options.plot]
    began = clock.now()
    try:
        if options.load_all_resources:
            for id in resources.ids(Resource):
                resources.obtain(id, Resource)
        runner.start()
        if options.realtime and (refusal := become_realtime()):
            log.warning(refusal)
        log.info(f"Running network with an interval of {network.interval:.2f} sec.")
        trio.run(partial(_run, runner, clock, options, ending))
    finally:
        runner.stop()
        resources.close()
        _tell_timings(runner)
    _tell_outcome(runner.statistics, clock.now() - began)
    for plot in plots:
        report(str(plot.write()))
    return 1 if runner.statistics.failures else 0


def _tell_outcome(statistics: Statistics, seconds: float) -> None:
    """One summary line at the end."""
    count = f"{statistics.ticks} tick{'s' * (statistics.ticks != 1)} in {seconds:.1f} s"
    missed = f"{statistics.missed} missed" if statistics.missed else "none missed"
    failed = f"{statistics.failures} failures" if statistics.failures else "no failures"
    report(f"behave: {count}, {missed}, {failed}", file=sys.stderr)


def _tell_timings(runner: Runner) -> None:
    """Statistics of the run, with --debug: the slowest behaviors first."""
    statistics = runner.statistics
    log.debug(
        "%d ticks, %d missed; they began %.3f ms late on average, %.3f ms at most",
        statistics.ticks,
        statistics.missed,
        statistics.lateness.mean * 1e3,
        statistics.lateness.longest * 1e3,
    )
    by_time = sorted(statistics.behaviors.items(), key=lambda item: -item[1].total)
    for id, timing in by_time:
        line = "%s: %d times, %.1f us on average, %.1f us at most"
        log.debug(line, id, timing.count, timing.mean * 1e6, timing.longest * 1e6)


def _resources(options: argparse.Namespace, clock: Clock) -> ResourceManager:
    if options.without_resources:
        return ResourceManager((), clock)
    return ResourceManager.load(options.config, clock)


async def _run(runner: Runner, clock: Clock, options: argparse.Namespace, ending: Ending) -> None:
    async with trio.open_nursery() as nursery:
        nursery.start_soon(clock.drive)
        nursery.start_soon(ending.wait, nursery.cancel_scope.cancel)
        await runner.run(options.invocation_count, options.duration)
        nursery.cancel_scope.cancel()


if __name__ == "__main__":
    sys.exit(main())
