"""Values between robots of a fleet on loopback: `python -m benchmarks.net.fleet`.

Robots in two processes, for real: networks that tick at 100 Hz, the seals, Zenoh. A value is the
time at which it was made, which the other process compares with its own clock: on one machine both
are the same.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import psutil

from hri.behavior.behavior import Behavior
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.bench.figures import machine
from hri.bench.table import Row, amount, at_least, at_most
from hri.bench.workers import variables
from hri.core.errors import HriError
from hri.net.zenoh.member import Member
from hri.net.zenoh.remote_slot import RemoteSlot
from hri.net.zenoh.session import FleetSettings
from hri.robot import Robot
from hri.task.context import TaskContext

PATIENCE = 60.0
SECONDS = 10.0
"""Of each measurement."""
PORTS = 100
"""Values at 100 Hz each: 10,000 a second."""
KILLS = 10
EMPTY = '<BehaviorNetwork name="empty"/>'


class Watch(Behavior):
    """Sends what time it is."""

    time = Output[float]("double", "seconds")

    def compute(self, now: float, dt: float) -> None:
        self.time.send(time.perf_counter())


def _living(name: str, folder: str, count: int, pipe: Pipe) -> None:
    """A process with a robot that sends values, until something comes."""
    path = Path(folder, "empty.xml")
    robot = Robot(str(path), "simulated")
    member = Member(robot, FleetSettings(name))

    async def begin(context: TaskContext) -> None:
        network = Network("clock", interval=0.01)
        network.add(Watch("watch"))
        for number in range(count):
            network.connect("watch.time", f"board.t{number}")
        context.networks.start(network)
        pipe.send(os.getpid())
        while not pipe.poll():
            await context.clock.sleep(0.05)
        robot.finish()

    robot.live_until_over(member.be_in_fleet, begin)


@contextmanager
def _other(name: str, folder: str, count: int) -> Iterator[tuple[Pipe, int]]:
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_living, args=(name, folder, count, there), daemon=True)
    process.start()
    if not here.poll(PATIENCE):
        raise HriError("the other robot does not begin - run the bench again")
    yield here, here.recv()
    if process.is_alive():
        here.send(None)
    process.join(PATIENCE)


def _seen(folder: str, slots: int, seconds: float) -> tuple[list[float], float, float]:
    """Delays of the values of another robot, values a second, and how much memory grew, MB."""
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, FleetSettings("reader"))
    delays: list[float] = []
    arrive = RemoteSlot.arrive

    def taken(slot: RemoteSlot, value: Any, came: Any) -> None:
        arrive(slot, value, came)
        if value is not None:
            delays.append(time.perf_counter() - value)

    RemoteSlot.arrive = taken  # type: ignore[method-assign, assignment]
    result: list[float] = []

    async def watch(context: TaskContext) -> None:
        first = [context.board.slot(f"writer/t{n}") for n in range(slots)]
        while any(slot.value is None for slot in first):
            await context.clock.sleep(0.05)
        delays.clear()
        begun, memory = time.perf_counter(), psutil.Process().memory_info().rss
        await context.clock.sleep(seconds)
        result.append(len(delays) / (time.perf_counter() - begun))
        result.append((psutil.Process().memory_info().rss - memory) / 1e6)
        robot.finish()

    try:
        robot.live_until_over(member.be_in_fleet, watch)
    finally:
        RemoteSlot.arrive = arrive  # type: ignore[method-assign]
    return delays, result[0], result[1]


def delays(folder: str) -> Iterator[Row]:
    """From a port on one robot to a slot on another."""
    for count in (1, PORTS):
        with _other("writer", folder, count):
            found, rate, grown = _seen(folder, count, SECONDS)
        ms = np.array(found) * 1e3
        limits = (at_most(1.0), at_most(5.0)) if count == 1 else (None, None)
        yield amount(f"{count} at 100 Hz: delay, median", float(np.median(ms)), "ms", limits[0])
        yield amount(
            f"{count} at 100 Hz: delay, p99", float(np.percentile(ms, 99)), "ms", limits[1]
        )
        limit = at_least(100.0 * count * 0.98)
        yield amount(f"{count} at 100 Hz: values", rate, "a second", limit)
        yield amount(f"{count} at 100 Hz: memory grown", grown, "MB", at_most(20.0))


def losses(folder: str) -> Iterator[Row]:
    """How long a slot keeps the value of a robot that was killed, or frozen."""
    for name, number in (("killed", signal.SIGKILL), ("frozen", signal.SIGSTOP)):
        times = [_lost(folder, number) for _ in range(KILLS)]
        yield amount(f"slot empties, robot {name}, longest", 1e3 * max(times), "ms", at_most(250.0))


def _lost(folder: str, number: signal.Signals) -> float:
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, FleetSettings("reader"))
    found: list[float] = []
    with _other("writer", folder, 1) as (_, pid):

        async def watch(context: TaskContext) -> None:
            slot = context.board.slot("writer/t0")
            while slot.value is None:
                await context.clock.sleep(0.01)
            begun = time.perf_counter()
            os.kill(pid, number)
            while slot.value is not None:
                await context.clock.sleep(0.005)
            found.append(time.perf_counter() - begun)
            os.kill(pid, signal.SIGKILL)
            robot.finish()

        robot.live_until_over(member.be_in_fleet, watch)
    return found[0]


def main() -> None:
    """Print a row for each figure, and the machine."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.parse_args()
    with TemporaryDirectory() as folder, variables(XDG_STATE_HOME=folder):
        Path(folder, "empty.xml").write_text(EMPTY)
        for part in (delays, losses):
            for row in part(folder):
                print(json.dumps(row), flush=True)
    print(json.dumps({"machine": machine()}))


if __name__ == "__main__":
    main()
