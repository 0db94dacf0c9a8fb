"""One case of `hri bench behavior`: how late the ticks of a 100 Hz network begin.

`python -m hri.bench.ticks alone|companion plain|realtime SECONDS` prints a line of JSON.
"""

from __future__ import annotations

import json
import sys
from typing import Any

import numpy as np
import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.running import Networks
from hri.core.clock import Clock, RealClock
from hri.core.event_bus import EventBus
from hri.core.realtime import become_realtime
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot
from hri.simulation.visit_script import load_visit
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext

NAME = "stopwatch"
INTERVAL = 0.01
SETTLING = 5.0
"""Seconds until the companion has loaded its models and the visitor talks."""


class Stopwatch(Behavior):
    """Notes when each tick begins, and how long after its deadline."""

    def start(self, context: Context) -> None:
        self._context = context
        self.times: list[float] = []
        self.lateness: list[float] = []

    def compute(self, now: float, dt: float) -> None:
        self.times.append(now)
        mine = next(one for one in self._context.runners if one.network.name == NAME)
        self.lateness.append(mine.statistics.lateness.last)


def main(load: str, priority: str, seconds: float) -> dict[str, Any]:
    """Run one case. Returns its figures."""
    clock = RealClock()
    stopwatch = Stopwatch("stopwatch")
    network = Network(NAME, INTERVAL)
    network.add(stopwatch)
    if load == "companion":
        refusal = _beside_companion(clock, network, priority, seconds)
    else:
        refusal = _alone(clock, network, priority, seconds)
    return {**figures(stopwatch), "refused": refusal}


def figures(stopwatch: Stopwatch) -> dict[str, Any]:
    """Period and lateness of what was noted."""
    times, lateness = np.array(stopwatch.times), np.array(stopwatch.lateness)
    intervals = round(((times - lateness)[-1] - (times - lateness)[0]) / INTERVAL)
    period = (times[-1] - times[0]) / intervals
    return {
        "ticks": len(times),
        "skipped": intervals + 1 - len(times),
        "period_error_percent": round(abs(period / INTERVAL - 1) * 100, 4),
        "lateness_ms": {
            f"p{at}": round(float(np.percentile(lateness, at)) * 1e3, 3) for at in (50, 95, 99)
        },
        "lateness_max_ms": round(float(lateness.max()) * 1e3, 3),
    }


def _rise(priority: str) -> str:
    return become_realtime() if priority == "realtime" else ""


def _alone(clock: Clock, network: Network, priority: str, seconds: float) -> str:
    networks = Networks(Context(clock, EventBus(clock), ResourceManager((), clock)))

    async def live() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            nursery.start_soon(networks.run)
            await clock.sleep(seconds)
            nursery.cancel_scope.cancel()

    networks.start(network)
    refusal = _rise(priority)
    trio.run(live)
    networks.close()
    return refusal


def _beside_companion(clock: Clock, network: Network, priority: str, seconds: float) -> str:
    """In the loop of the companion, which hears, speaks, sees a visitor and shows its face."""
    devices = (
        Description("microphone", "Hri.SimulatedMicrophone", bus="world"),
        Description("camera", "Hri.SimulatedCamera", bus="world"),
        Description("screen", "Hri.OffscreenScreen"),
        Description("speaker", "Hri.SilentSpeaker"),
    )
    robot = Robot("companion", clock=clock, devices=devices, notice=lambda line: None)
    refusals = []

    async def watch(context: TaskContext) -> None:
        world = robot.resources.obtain("world", SimulatedWorld)
        visit = load_visit(robot.app.folder / "demo.toml")
        visit.start(world, context.clock, context.events)
        await context.clock.sleep(SETTLING)
        refusals.append(_rise(priority))
        robot.networks.start(network)
        await context.clock.sleep(seconds)
        robot.finish()

    robot.live_until_over(*robot.app.load_tasks(), watch)
    return refusals[0]


if __name__ == "__main__":
    load, priority, seconds = sys.argv[1:]
    print(json.dumps(main(load, priority, float(seconds))))
