from functools import partial

import pytest
import trio

from hri.task.lane import Lane
from tests.task.stage import Stage


def run(job):
    Stage().run(job)


def test_what_comes_next_takes_the_place_of_what_runs():
    log = []

    async def job(context, name, seconds):
        try:
            await context.clock.sleep(seconds)
            log.append(f"{name} done")
        except trio.Cancelled:
            log.append(f"{name} cut at {context.clock.now():g}")
            raise

    async def main(context):
        lane = Lane(context)
        lane.start(job, "first", 10)
        await context.clock.sleep(1)
        lane.start(job, "second", 2)
        await context.clock.sleep(3)
        assert not lane.is_busy
        lane.start(job, "third", 2)
        await context.clock.sleep(1)
        lane.stop()
        lane.stop()
        await context.clock.sleep(1)

    run(main)
    assert log == ["first cut at 1", "second done", "third cut at 5"]


def test_a_held_job_starts_again_unless_another_takes_its_place():
    log = []

    async def job(context, name):
        log.append(f"{name} at {context.clock.now():g}")
        await context.clock.sleep(2)

    async def main(context):
        lane = Lane(context)
        lane.hold()
        lane.resume()
        lane.start(job, "first")
        await context.clock.sleep(1)
        lane.hold()
        assert not lane.is_busy
        await context.clock.sleep(1)
        lane.resume()
        await context.clock.sleep(1)
        lane.hold()
        lane.start(job, "second")
        lane.resume()
        await context.clock.sleep(3)
        lane.hold()
        lane.resume()
        lane.start(job, "third")
        await context.clock.sleep(1)
        lane.hold()
        lane.stop()
        lane.resume()
        await context.clock.sleep(1)

    run(main)
    assert log == ["first at 0", "first at 2", "second at 3", "third at 6"]


def test_a_lane_needs_a_robot_that_lives():
    with pytest.raises(RuntimeError, match="lives"):
        Lane(Stage().context).start(lambda: None)


def test_waiting_for_events_in_order_with_a_timeout():
    async def main(context):
        clock = context.clock
        clock.call_at(1.0, partial(context.events.raise_event, "head.nodded"))
        event = await context.wait_for("head.*", timeout=5)
        assert (event.name, event.time) == ("head.nodded", 1.0)
        assert await context.wait_for("head.*", timeout=2) is None
        assert clock.now() == 3.0
        with context.queue("a", "b") as queue:
            for name in ("a", "x", "b"):
                context.events.raise_event(name)
            assert [(await queue.get()).name for _ in range(2)] == ["a", "b"]

    run(main)
