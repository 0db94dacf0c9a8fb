"""A base on a straight course, driven through the real gate: what the tests measure."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from typing import Any

import trio

from hri.behavior.behavior import Context
from hri.behavior.drive_command import DriveCommand
from hri.behavior.ports import OutputPort
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event, RangeReading, Twist
from hri.drive.behaviors import CommandGate
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext
from hri.task.task_manager import TaskManager

TICK = 0.02
RADIUS = 0.2
DEVICES = (
    Description("mute", "Hri.SilentVoice"),
    Description("world", "Hri.SimulatedWorld", {"voice": "mute"}),
    Description("drive", "Hri.SimulatedDrive", bus="world"),
    Description("odometry", "Hri.SimulatedOdometry", bus="world"),
)


class Course:
    """A clock, a gate, a base, and a wall across the way at `wall` meters."""

    def __init__(self, wall: float = math.inf, slip: float = 0.0, **parameters: Any) -> None:
        self.clock = FakeClock()
        self.wall = wall
        self.resources = ResourceManager(DEVICES, self.clock)
        self.base = self.resources.obtain("world", SimulatedWorld).base
        self.base._clearance = lambda x, y, time: self.wall - x
        self.base._slip = slip
        self.context = Context(self.clock, EventBus(self.clock), self.resources)
        self.events: list[Event] = []
        self.context.events.subscribe("drive.*", self.events.append)
        self.gate = CommandGate(**parameters)
        self.sees, self.feels = OutputPort[RangeReading](), OutputPort[bool]()
        self.asks, self.hurries = OutputPort[Twist](), OutputPort[float]()
        self.gate.range.sources.append(self.sees)
        self.gate.bump.sources.append(self.feels)
        self.gate.twist.sources.append(self.asks)
        self.gate.speed.sources.append(self.hurries)
        self.drive = DriveCommand("drive")
        self.drive.velocity.sources.append(self.gate.velocity)
        self.gate.start(self.context)
        self.drive.start(self.context)
        self.sensor_speaks = self.switch_speaks = True
        self.task = TaskManager(self.context, {"moving.gate": self.gate}).context
        self.fastest = 0.0

    def tick(self) -> None:
        now = self.clock.now()
        self.base.advance(now)
        ahead = self.wall - self.base.pose.x - RADIUS
        reading = RangeReading("front", ahead if ahead <= 0.8 else math.inf, now)
        self.sees.value = reading if self.sensor_speaks else None
        self.feels.value = self.base.is_touching if self.switch_speaks else None
        self.gate.compute(now, TICK)
        self.drive.compute(now, TICK)
        self.fastest = max(self.fastest, abs(self.base.velocity.linear))

    def tick_for(self, seconds: float) -> None:
        """Tick outside a robot loop."""
        for _ in range(round(seconds / TICK)):
            self.tick()
            self.clock.advance(TICK)

    def run(self, task: Callable[[TaskContext], Awaitable[Any]]) -> Any:
        """Run one task to its end while the gate ticks."""
        results = []

        async def main() -> None:
            async with trio.open_nursery() as nursery:
                nursery.start_soon(self.clock.drive)
                nursery.start_soon(self._tick_on)
                results.append(await task(self.task))
                nursery.cancel_scope.cancel()

        trio.run(main)
        return results[0]

    async def _tick_on(self) -> None:
        while True:
            self.tick()
            await self.clock.sleep(TICK)

    def reasons(self) -> list[str]:
        return [e.properties["reason"] for e in self.events if e.name == "drive.stopped"]
