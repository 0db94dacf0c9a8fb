"""A large network that runs for simulated hours while tasks, values and networks come and go.

Beside it a base drives to and fro, tasks take claims from each other, and numbers cross the
bridge: that alone takes real time, so how many ticks it lasts is not the same in two runs.
"""

from __future__ import annotations

import gc
import math
import random
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.catalog import find_behavior
from hri.behavior.declaration import Port, Schema
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.schema import subclass
from hri.core.clock import FakeClock, RealClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.drive.tasks_2003 import drive_move_delta, drive_turn_delta
from hri.hal.pending import Interrupted
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.task.context import TaskContext
from hri.task.task_manager import TaskManager
from hri.task.task_run import TaskStatus

INTERVAL = 0.1
"""Seconds between ticks of the large network."""
EVENT_EVERY = 10
"""Ticks of a crier between two of its events."""
CRIERS = 5
PATIENCE = 3.0
"""Seconds; the longest that an impatient visitor waits for its event."""
LONG_PATIENCE = 7200.0
"""Seconds; the timeout of those who are patient: their timers are cancelled long before."""
GUEST_SECONDS = 60.0
"""Between two exchanges of the small network."""
WARM_UP = 0.25
"""Share of the run after which memory must not grow."""
CROSSING_PATIENCE = 10.0
"""Seconds of real time that a number may take over the bridge."""
NAP = 0.001
"""Seconds of real time between two looks whether it has arrived."""
STRETCH = 20.0
"""Centimeters that the base drives to and fro."""
MOST_GROWTH = 150_000
"""Bytes; queues and tables reach their size in the warm-up."""
MOST_DRIFT = 1e-6
"""Seconds that a tick may be off its place on the grid."""


DEVICES = (
    Description("world", "Hri.SimulatedWorld"),
    Description("drive", "Hri.SimulatedDrive", bus="world"),
    Description("odometry", "Hri.SimulatedOdometry", bus="world"),
)
BRIDGE = Schema("Soak.Bridge", "Hri.MalleableBehavior", "Bridge", "", "net")
NUMBERS = (Port("number", "double"),)
SENDER = replace(BRIDGE, type="Soak.Sender", inputs=NUMBERS)
RECEIVER = replace(BRIDGE, type="Soak.Receiver", outputs=NUMBERS)


class Crier(Behavior):
    """Raises numbered events."""

    count = Output[float]("double", "how many so far")

    def start(self, context: Context) -> None:
        self._events = context.events
        self.ticks = self.cries = 0

    def compute(self, now: float, dt: float) -> None:
        self.ticks += 1
        if self.ticks % EVENT_EVERY == 0:
            self.cries += 1
            self._events.raise_event("soak.cried", crier=self.id, number=self.cries)
        self.count.send(float(self.cries))


class Relay(Behavior):
    """Passes on the sum of what comes in."""

    input = Input[float]("double", "numbers")
    output = Output[float]("double", "their sum")

    def compute(self, now: float, dt: float) -> None:
        self.output.send(sum(self.input.values))


class Grid(Behavior):
    """Knows when each tick should be."""

    def start(self, context: Context) -> None:
        self.ticks = 0
        self.drift = 0.0

    def compute(self, now: float, dt: float) -> None:
        self.drift = max(self.drift, abs(now - self.ticks * INTERVAL))
        self.ticks += 1


@dataclass
class Verdict:
    """What came out."""

    hours: float
    ticks: int = 0
    events: int = 0
    tasks: int = 0
    swaps: int = 0
    injected: int = 0
    drives: int = 0
    crossings: int = 0
    """Numbers that went over a separate bridge."""
    drift: float = 0.0
    """Seconds."""
    growth: int = 0
    """Bytes more than after the warm-up."""
    faults: list[str] = field(default_factory=list)
    """A sentence for each thing that went wrong; none when all is well."""


class Soak:
    """One run: everything in it repeats with the same seed."""

    def __init__(self, hours: float, behaviors: int, tell: Callable[[str], object]) -> None:
        self.seconds = hours * 3600
        self.tell = tell
        self.random = random.Random(0)
        self.clock = FakeClock()
        self.real = RealClock()
        self.events = EventBus(self.clock)
        self.resources = ResourceManager(DEVICES, self.clock)
        context = Context(self.clock, self.events, self.resources)
        self.tasks = TaskManager(context)
        self.networks = self.tasks.networks
        self.network = large_network(max(behaviors, CRIERS + 2))
        self.verdict = Verdict(hours)
        self.heard: dict[str, int] = {}
        self.watched = 0

    def run(self) -> Verdict:
        """Live through it all."""
        tracemalloc.start()
        try:
            trio.run(self._live)
        finally:
            tracemalloc.stop()
            self.networks.close()
            self.resources.close()
        self._judge()
        return self.verdict

    async def _live(self) -> None:
        async with trio.open_nursery() as nursery:
            self.tasks.live_in(nursery)
            nursery.start_soon(self.clock.drive)
            nursery.start_soon(self.networks.run)
            self.networks.start(self.network)
            self.networks.start(guest_network(0))
            self.networks.watch("large", "crier0", "count", self._see)
            self.events.subscribe("soak.cried", self._hear)
            nursery.start_soon(self._send_visitors)
            nursery.start_soon(self._exchange_guests)
            nursery.start_soon(self._send_drivers)
            nursery.start_soon(self._cross_bridges)
            resident = self.tasks.install(self._reside)
            await self.clock.sleep(self.seconds * WARM_UP)
            listeners, memory = len(self.events.subscriptions), _memory()
            for quarter in (0.5, 0.75, 1.0):
                await self.clock.sleep_until(self.seconds * quarter)
                self.verdict.growth = _memory() - memory
                self._tell_progress()
            self.verdict.ticks = self.networks.runners["large"].statistics.ticks
            # No new visitors come while those that wait run out of patience, or get their event.
            self._is_closing = True
            resident.cancel()
            await self.clock.sleep(GUEST_SECONDS)
            if len(self.events.subscriptions) > listeners:
                self.verdict.faults.append("tasks that ended still listen to events")
            if (holder := self.tasks.claims.holder("drive")) is not None:
                self.verdict.faults.append(f"{holder} still holds the drive")
            nursery.cancel_scope.cancel()

    _is_closing = False

    async def _send_visitors(self) -> None:
        """Install tasks that wait, end, fail or are cancelled."""
        while not self._is_closing:
            await self.clock.sleep(self.random.uniform(0.1, 2.0))
            is_patient = self.random.random() < 0.5
            patience = LONG_PATIENCE if is_patient else self.random.uniform(0.1, PATIENCE)
            task = self.tasks.install(self._visit, patience)
            self.verdict.tasks += 1
            if self.random.random() < 0.2:
                await self.clock.sleep(self.random.uniform(0.0, 1.0))
                task.cancel()

    async def _visit(self, context: TaskContext, patience: float) -> None:
        event = await context.wait_for("soak.c*", timeout=patience)
        if event is not None:
            async with context.claim("relay0"):
                self.networks.inject("large", "relay0", "input", event.properties["number"])
                self.verdict.injected += 1
                await context.clock.sleep(INTERVAL)

    async def _reside(self, context: TaskContext) -> None:
        """Wait for one event after the other, each time with a timeout that never comes."""
        while True:
            await context.wait_for("soak.cried", timeout=LONG_PATIENCE)

    async def _send_drivers(self) -> None:
        """Let one task turn the base until another one takes the drive and drives to and fro."""
        while not self._is_closing:
            turning = self.tasks.install(drive_turn_delta, math.tau)
            await self.clock.sleep(1.0)
            driving = self.tasks.install(drive_to_and_fro)
            await driving.wait()
            self.verdict.drives += 1
            if not isinstance(turning.error, Interrupted):
                self.verdict.faults.append(f"{turning} did not lose the drive to {driving}")
            if driving.status is not TaskStatus.SUCCESS:
                self.verdict.faults.append(f"{driving}: {driving.error}")
            await self.clock.sleep(GUEST_SECONDS)

    async def _cross_bridges(self) -> None:
        """Open a bridge, send a number over it and close it, again and again."""
        while not self._is_closing:
            receiver = bridge_end(RECEIVER, bind="127.0.0.1", tcp_port=0)
            self.networks.start(receiver)
            listening: Any = receiver["bridge"]
            sender = bridge_end(SENDER, tcp_host="127.0.0.1", tcp_port=listening.port_in_use)
            self.networks.start(sender)
            if await self._has_crossed(sender.name, receiver.name):
                self.verdict.crossings += 1
            else:
                self.verdict.faults.append("a number did not cross the bridge")
            self.networks.stop(sender.name)
            self.networks.stop(receiver.name)
            await self.clock.sleep(GUEST_SECONDS)

    async def _has_crossed(self, sender: str, receiver: str) -> bool:
        """Send numbers until one arrives; those before there is a connection are lost."""
        arrived: list[float] = []
        self.networks.watch(receiver, "bridge", "number", lambda value, _: arrived.append(value))
        given_up = self.real.now() + CROSSING_PATIENCE
        while not arrived and self.real.now() < given_up:
            self.networks.inject(sender, "bridge", "number", 1.0)
            await self.clock.sleep(INTERVAL)
            self.real.advance(NAP)
        return bool(arrived)

    async def _exchange_guests(self) -> None:
        while True:
            await self.clock.sleep(GUEST_SECONDS)
            self.verdict.swaps += 1
            self.networks.swap("guest", guest_network(self.verdict.swaps))

    def _hear(self, event: Event) -> None:
        crier, number = event.properties["crier"], event.properties["number"]
        if number != self.heard.get(crier, 0) + 1:
            self.verdict.faults.append(f"{crier}: event {number} came out of turn")
        self.heard[crier] = number
        self.verdict.events += 1

    def _see(self, value: float, now: float) -> None:
        self.watched += 1

    def _tell_progress(self) -> None:
        hours = self.clock.now() / 3600
        told = f"{self.verdict.events} events, {self.verdict.tasks} tasks"
        self.tell(f"{hours:.2f} h: {told}, {self.verdict.growth / 1000:+.1f} kB")

    def _judge(self) -> None:
        """Compare the observed figures with the expected ones."""
        verdict, faults = self.verdict, self.verdict.faults
        grid = self.network["grid"]
        assert isinstance(grid, Grid), "it was made below"
        verdict.drift = grid.drift
        cries = sum(crier.cries for crier in self.network.behaviors if isinstance(crier, Crier))
        if verdict.events != cries:
            faults.append(f"{cries - verdict.events} of {cries} events were lost")
        if self.watched != grid.ticks:
            faults.append(f"a watch saw {self.watched} of {grid.ticks} values")
        if verdict.drift > MOST_DRIFT:
            faults.append(f"ticks drift by {verdict.drift:g} s")
        if abs(verdict.ticks - self.seconds / INTERVAL) > 1:
            faults.append(f"{verdict.ticks} ticks in {self.seconds:g} s")
        if verdict.growth > MOST_GROWTH:
            faults.append(f"memory grew by {verdict.growth} bytes")


async def drive_to_and_fro(context: TaskContext) -> None:
    """Drive ahead and back again."""
    async with context.claim("drive"):
        await drive_move_delta(context, STRETCH)
        await drive_move_delta(context, -STRETCH)


def _memory() -> int:
    gc.collect()
    return tracemalloc.get_traced_memory()[0]


def large_network(count: int) -> Network:
    """Criers, and a chain of relays behind them."""
    network = Network("large", INTERVAL)
    network.add(Grid("grid"))
    for number in range(CRIERS):
        network.add(Crier(f"crier{number}"))
    for number in range(count - CRIERS - 1):
        network.add(Relay(f"relay{number}"))
        source = f"relay{number - 1}.output" if number else "crier0.count"
        network.connect(source, f"relay{number}.input")
    network.sort()
    return network


def guest_network(number: int) -> Network:
    """A small one, of another rate each time."""
    network = Network("guest", INTERVAL * (1 + number % 5))
    network.add(Relay("relay"))
    return network


def bridge_end(schema: Schema, **parameters: Any) -> Network:
    """A network with one end of a bridge, named like its schema."""
    network = Network(schema.type, INTERVAL)
    network.add(subclass(find_behavior(schema.driver), schema)("bridge", **parameters))
    return network
