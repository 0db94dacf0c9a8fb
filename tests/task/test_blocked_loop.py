"""A task that blocks: the loop names it, and `blocking` runs it aside."""

import logging
import threading
from time import perf_counter

import pytest
import trio

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.core.clock import FakeClock, RealClock
from hri.core.event_bus import EventBus
from hri.hal.resource_manager import ResourceManager
from hri.task.task import task
from hri.task.task_manager import TaskManager


class Pulse(Behavior):
    """Notes that the network ticks."""

    def __init__(self, id=""):
        super().__init__(id)
        self.ticked = threading.Event()

    def compute(self, now, dt):
        self.ticked.set()


def run(clock, job, *arguments):
    """Run a task beside a network that ticks every 10 ms; what the task returned."""
    context = Context(clock, EventBus(clock), ResourceManager({}, clock))
    tasks = TaskManager(context).context
    network = Network("pulse", 0.01)
    pulse = network.add(Pulse("pulse"))
    results = []

    async def main():
        async with trio.open_nursery() as nursery:
            tasks.manager.live_in(nursery)
            nursery.start_soon(clock.drive)
            nursery.start_soon(tasks.networks.run)
            tasks.networks.start(network)
            results.append(await tasks.manager.run(job, pulse, *arguments))
            nursery.cancel_scope.cancel()

    trio.run(main)
    return results[0]


def busy(seconds):
    end = perf_counter() + seconds
    while perf_counter() < end:
        pass


@task("Examples.Blocks")
async def blocks(context, pulse, seconds: float):
    """Keeps the loop, and then lets a network tick."""
    await context.clock.sleep(0.05)
    busy(seconds)
    await context.clock.sleep(0.05)


@task("Examples.Aside")
async def aside(context, pulse):
    """Waits in a thread for a tick of the network, which never comes when the loop waits too."""

    def wait():
        pulse.ticked.clear()
        return pulse.ticked.wait(30)

    return await context.blocking(wait)


def test_a_task_that_blocks_is_named_with_what_to_do(caplog):
    with caplog.at_level(logging.WARNING, "hri"):
        run(RealClock(), blocks, 0.3)
    lines = [line for line in caplog.messages if line.startswith("Examples.Blocks held all")]
    assert len(lines) == 1
    assert "context.blocking" in lines[0]


def test_a_missed_interval_names_the_task_that_held_it_up(caplog, monkeypatch):
    monkeypatch.setattr("hri.behavior.runner.BETWEEN_REPORTS", 0.0)
    with caplog.at_level(logging.WARNING, "hri"):
        run(RealClock(), blocks, 0.15)
    missed = [line for line in caplog.messages if line.startswith("Missed desired interval")]
    assert any("Examples.Blocks held the loop up" in line for line in missed)


def test_networks_tick_while_a_function_blocks_aside():
    assert run(RealClock(), aside) is True


def test_fake_time_stands_still_while_a_function_blocks_aside():
    @task("Examples.Counts")
    async def counts(context, pulse):
        before = context.clock.now()
        total = await context.blocking(sum, [1, 2, 3])
        return total, context.clock.now() - before

    assert run(FakeClock(), counts) == (6, 0.0)


def test_what_a_function_aside_raises_is_raised_by_the_task():
    @task("Examples.Fails")
    async def fails(context, pulse):
        with pytest.raises(ValueError, match="no number"):
            await context.blocking(int, "no number")
        return "went on"

    assert run(FakeClock(), fails) == "went on"
