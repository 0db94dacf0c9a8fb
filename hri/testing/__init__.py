"""For your own tests: fake time, devices in memory, a silent voice, and ways to run on them.

def test_it_greets():
    robot = Robot(clock=FakeClock(), config="simulated")
    world = robot.resources.obtain("world", SimulatedWorld)
    world.say("hello robot", at=1.0)
    events = live_for(robot, 6.0, *robot.app.load_tasks())
    assert [event.name for event in events if event.name == "speech.said"]
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.hal.drivers.memory import (
    MemoryCamera,
    MemoryMicrophone,
    OffscreenScreen,
    SilentSpeaker,
)
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot import Job, Robot
from hri.speech.synthesizers.silent import SilentVoice
from hri.task.context import TaskContext
from hri.testing.cameras import Fault, FaultyCamera
from hri.testing.golden import Golden, difference
from hri.testing.pictures import expressions_of, spoken_frames

__all__ = [
    "FakeClock",
    "Fault",
    "FaultyCamera",
    "Golden",
    "MemoryCamera",
    "MemoryMicrophone",
    "OffscreenScreen",
    "SilentSpeaker",
    "SilentVoice",
    "context",
    "difference",
    "expressions_of",
    "live_for",
    "run_for",
    "spoken_frames",
]


def context(*devices: Description, seed: int = 0) -> Context:
    """A context on a fake clock, with the devices of your choice."""
    clock = FakeClock()
    return Context(clock, EventBus(clock), ResourceManager(devices, clock), seed=seed)


def run_for(
    seconds: float, behaviors: Sequence[Behavior], lent: Context, interval: float = 0.1
) -> list[Event]:
    """Run behaviors, in this order, for some seconds of fake time; the events they raised."""
    network = Network("test", interval, behaviors=list(behaviors))
    return live(lent, [Runner(network, lent)], seconds)


def live(lent: Context, runners: Sequence[Runner], seconds: float) -> list[Event]:
    """Run networks for some seconds of fake time; the events they raised."""
    events: list[Event] = []
    subscription = lent.events.subscribe("*", events.append)

    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(lent.clock.drive)
            for runner in runners:
                runner.start()
                nursery.start_soon(runner.run)
            await lent.clock.sleep(seconds)
            nursery.cancel_scope.cancel()

    try:
        trio.run(main)
    finally:
        subscription.cancel()
        for runner in runners:
            runner.stop()
    return events


def live_for(robot: Robot, seconds: float, *jobs: Job) -> list[Event]:
    """Let a robot on a fake clock live for some seconds; the events it raised."""
    events: list[Event] = []
    robot.events.subscribe("*", events.append)

    async def end(context: TaskContext) -> None:
        await context.clock.sleep(seconds)
        robot.finish()

    trio.run(partial(robot.live, *jobs, end))
    return events
