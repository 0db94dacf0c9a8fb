"""How soon a base stands when whoever steers it dies, freezes or falls silent: real processes.

A program drives an emulated Create 2 behind a pseudo-terminal. What is ended is, by turns with
SIGKILL and SIGSTOP, a peer that steers the program over the bridge, or a script that drives by
itself; a joystick falls silent in the program's hand. Times are taken where the base is.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager

import numpy as np
import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.device_behaviors import JoystickSticks
from hri.behavior.doors import Doors
from hri.behavior.drive_command import DriveCommand
from hri.behavior.network import Network
from hri.behavior.ports import LINEAR_VELOCITY, Output
from hri.behavior.runner import Runner
from hri.bench.stops import PATIENCE, SPEED, Bench, by_turns
from hri.bench.table import Row, amount, at_most
from hri.bench.workers import running
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import DriveSystem
from hri.hal.drivers.memory import MemoryJoystick
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.net.connection import Connection
from hri.net.malleable import MalleableBehavior

LIMIT_MS = 250.0
TRIES, QUICK_TRIES = 20, 4
REPEATED = 0.1
"""Seconds between two messages of a peer, the longest that docs/bridge.md allows."""
INTERVAL = 0.05
"""Seconds between two ticks of the network that it steers."""
BEAT = 0.02
"""Seconds between two commands of a script, and two looks at the latch."""
TAG = "steering"


class VelocityFromPeer(MalleableBehavior):
    """Takes a velocity from a peer."""

    velocity = Output[float]("double", "cm/s", LINEAR_VELOCITY)


def rows(quick: bool) -> Iterator[Row]:
    """A row for each who may steer: the longest time to zero velocity, and the median."""
    tries = QUICK_TRIES if quick else TRIES
    ended: dict[str, Callable[[int], list[float]]] = {
        "network peer killed or frozen": peer_to_zero,
        "script killed or frozen": script_to_zero,
        "joystick that falls silent": joystick_to_zero,
    }
    for who, measure in ended.items():
        ms = np.array(measure(tries)) * 1000
        what = f"{who} at {SPEED:g} m/s to zero velocity on the port, max"
        median = round(float(np.median(ms)), 2)
        yield amount(what, float(ms.max()), "ms", at_most(LIMIT_MS), tries=tries, median=median)


# --- what is measured ---


def peer_to_zero(tries: int) -> list[float]:
    """Seconds from the end of a peer to zero velocity."""
    bench, figures = Bench(), []
    with bench.port() as port, _process(f"steered({port.path!r}, 'peer')") as program:
        assert program.stdout is not None
        bridge = int(program.stdout.readline())
        for number in range(tries):
            with _process(f"steer({bridge})") as peer:
                figures.append(_ended(bench, peer, by_turns(number)))
    return figures


def script_to_zero(tries: int) -> list[float]:
    """Seconds from the end of a script to zero velocity."""
    bench, figures = Bench(), []
    with bench.port() as port:
        for number in range(tries):
            with _process(f"drive_on({port.path!r})") as script:
                figures.append(_ended(bench, script, by_turns(number)))
    return figures


def joystick_to_zero(tries: int) -> list[float]:
    """Seconds from the last word of a joystick to zero velocity."""
    bench, figures = Bench(), []
    with bench.port() as port, _process(f"steered({port.path!r}, 'joystick')") as program:
        for _ in range(tries):
            figures.append(_ended(bench, program, signal.SIGUSR1))
            os.kill(program.pid, signal.SIGUSR2)
    return figures


def _ended(bench: Bench, process: subprocess.Popen[str], by: signal.Signals) -> float:
    bench.wait("driving", lambda: bench.line.goes(SPEED))
    time = bench.clock.now()
    os.kill(process.pid, by)
    return bench.stop_after(time)


def _process(call: str) -> AbstractContextManager[subprocess.Popen[str]]:
    """One of the programs below."""
    return running(f"from {__name__} import *; {call}", subprocess.PIPE)


# --- the programs ---


def steer(port: int) -> None:
    """A peer that steers over the bridge, for ever."""
    clock = RealClock()
    with Connection(port=port, timeout=PATIENCE) as connection:
        while True:
            connection.send(f"<{TAG}><velocity>{SPEED * 100:g}</velocity></{TAG}>")
            clock.advance(REPEATED)


def drive_on(path: str) -> None:
    """A script that drives, for ever."""
    lent = _lent(path)
    bus = lent.resources.obtain("base", BaseBus)
    drive = lent.resources.obtain("drive", DriveSystem)
    while True:
        _release(bus)
        try:
            drive.set_velocity(Twist(SPEED), lent.clock.now())
        except HriError as error:
            print(error, file=sys.stderr)
        lent.clock.advance(BEAT)


def steered(path: str, by: str) -> None:
    """A program whose base a "peer" or a "joystick" steers, for ever; prints the bridge's port."""
    lent = _lent(path)
    bus = lent.resources.obtain("base", BaseBus)
    stick = lent.resources.obtain("joystick", MemoryJoystick)
    stick.hold((0.0, -1.0))
    signal.signal(signal.SIGUSR1, lambda *_: stick.fall_silent(lent.clock.now()))
    signal.signal(signal.SIGUSR2, lambda *_: stick.hold((0.0, -1.0)))
    network = {
        "peer": lambda: _network(VelocityFromPeer(tcp_port=0, tag_name=TAG), "linear_velocity"),
        "joystick": lambda: _network(JoystickSticks(max_linear=SPEED), "velocity"),
    }[by]()
    runner = Runner(network, lent)
    runner.start()
    if by == "peer":
        print(network["source"].port_in_use, flush=True)  # type: ignore[attr-defined]

    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(lent.clock.drive)
            nursery.start_soon(runner.run)
            while True:
                _release(bus)
                await lent.clock.sleep(BEAT)

    trio.run(main)


def _lent(path: str) -> Context:
    clock = RealClock()
    devices = [
        Description("base", "Hri.Create2", {"port": path}),
        Description("drive", "Hri.BaseDrive", bus="base"),
        Description("joystick", "Hri.MemoryJoystick"),
    ]
    doors = Doors(trusted=(TAG,))
    return Context(clock, EventBus(clock), ResourceManager(devices, clock), doors=doors)


def _network(source: Behavior, input: str) -> Network:
    """`input` of the drive takes the velocity of the source."""
    network = Network("steered", INTERVAL)
    for id, behavior in {"source": source, "drive": DriveCommand()}.items():
        behavior.id = id
        network.add(behavior)
    network.connect("source.velocity", f"drive.{input}")
    return network


def _release(bus: BaseBus) -> None:
    """Open the latch, as a person would: on a busy machine a base may fall silent."""
    if bus.state.is_latched:
        bus.unlatch()
