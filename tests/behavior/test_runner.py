from functools import partial
from time import perf_counter

import pytest
import trio
from trio.testing import MockClock

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager


class Metronome(Behavior):
    """Notes when it ticks."""

    beat = Output[float]("double", "the time")

    def start(self, context):
        self.times, self.steps, self.is_stopped = [], [], False

    def compute(self, now, dt):
        self.times.append(now)
        self.steps.append(dt)
        self.beat.send(now)

    def stop(self):
        self.is_stopped = True


class Sluggish(Behavior):
    """Takes longer than it may, once: time passes while it computes."""

    def start(self, context):
        self.clock, self.was_slow = context.clock, False

    def compute(self, now, dt):
        if now > 0.02 and not self.was_slow:
            self.was_slow = True
            self.clock.advance(0.055)


class Broken(Behavior):
    """Cannot start."""

    def start(self, context):
        raise ValueError("no")


def runner_of(clock, interval, *behaviors):
    network = Network("test", interval)
    for behavior in behaviors:
        network.add(behavior)
    runner = Runner(network, Context(clock, EventBus(clock), ResourceManager((), clock)))
    runner.start()
    return runner


def run(clock, *jobs):
    async def main():
        async with trio.open_nursery() as outer:
            outer.start_soon(clock.drive)
            async with trio.open_nursery() as inner:
                for job in jobs:
                    clock.soon(partial(inner.start_soon, job))
                await clock.sleep(0)
            outer.cancel_scope.cancel()

    trio.run(main)


@pytest.mark.proves("B06")
def test_two_networks_tick_at_their_own_rates():
    clock = FakeClock()
    fast, slow = Metronome("fast"), Metronome("slow")
    runners = [runner_of(clock, 0.1, fast), runner_of(clock, 0.25, slow)]
    run(clock, *(partial(runner.run, duration=1.0) for runner in runners))
    assert fast.times == pytest.approx([k * 0.1 for k in range(10)])
    assert slow.times == pytest.approx([0, 0.25, 0.5, 0.75])
    assert fast.steps == pytest.approx([0] + [0.1] * 9)


def test_a_faster_network_ticks_between_the_behaviors_of_a_slower_one():
    time = MockClock(autojump_threshold=0)

    class Working(Behavior):
        """Takes four milliseconds each time."""

        def compute(self, now, dt):
            time.jump(0.004)

    clock = RealClock(time.current_time)
    context = Context(clock, EventBus(clock), ResourceManager((), clock))
    fast, slow = Network("fast", 0.01), Network("slow", 0.1)
    fast.add(Metronome("beat"))
    for number in range(10):
        slow.add(Working(f"work{number}"))
    runners = [Runner(network, context) for network in (slow, fast)]
    for runner in runners:
        runner.start()

    async def main():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            for runner in runners:
                nursery.start_soon(runner.run)
            await clock.sleep(0.955)
            nursery.cancel_scope.cancel()

    trio.run(main, clock=time)
    slowly, quickly = (runner.statistics for runner in runners)
    assert quickly.missed == slowly.missed == 0
    assert quickly.lateness.longest <= 0.004 + 1e-9
    assert (quickly.ticks, slowly.ticks) == (96, 10)


def test_a_count_ends_the_run_and_stop_reaches_every_behavior():
    clock = FakeClock()
    beat = Metronome("beat")
    runner = runner_of(clock, 0.1, beat)
    run(clock, partial(runner.run, count=7))
    runner.stop()
    runner.stop()
    assert len(beat.times) == 7
    assert beat.is_stopped


@pytest.mark.proves("B07")
def test_a_missed_interval_is_counted_named_and_not_made_up_for(caplog):
    clock = FakeClock()
    beat, sluggish = Metronome("beat"), Sluggish("slow one")
    runner = runner_of(clock, 0.02, beat, sluggish)
    run(clock, partial(runner.run, duration=0.3))
    assert runner.statistics.missed == 2
    assert runner.statistics.slowest in ("beat", "slow one")
    assert "Missed desired interval" in caplog.text
    # The slow tick of 0.04 ends at 0.095: 0.06 and 0.08 are skipped, the grid goes on at 0.1.
    assert beat.times == pytest.approx([0, 0.02, 0.04, *(k * 0.02 for k in range(5, 15))])


def test_when_one_behavior_cannot_start_the_others_are_stopped():
    clock = FakeClock()
    beat = Metronome("beat")
    with pytest.raises(ValueError, match="no"):
        runner_of(clock, 0.1, beat, Broken("broken"))
    assert beat.is_stopped


class Faulty(Behavior):
    """Fails once, at the third tick."""

    beat = Output[float]("double", "the time")

    def compute(self, now, dt):
        self.count += 1
        if self.count == 3:
            raise ZeroDivisionError("no device")
        self.beat.send(now)

    count = 0


def test_a_behavior_that_fails_rests_and_comes_back_while_others_go_on(caplog):
    clock = FakeClock()
    beat, faulty = Metronome("beat"), Faulty("faulty")
    runner = runner_of(clock, 0.1, faulty, beat)
    failures = []
    runner.context.events.subscribe("behavior.failed", failures.append)
    run(clock, partial(runner.run, duration=3.0))
    assert len(beat.times) == 30
    assert faulty.count == 20 + 1
    assert [event.properties["behavior"] for event in failures] == ["test.faulty"]
    assert runner.statistics.failures == 1
    assert "no device" in caplog.text


def test_outputs_are_empty_again_at_the_next_tick():
    clock = FakeClock()
    beat = Metronome("beat")
    runner = runner_of(clock, 0.1, beat)
    runner.tick(0.0)
    assert beat.beat.value == 0.0
    beat.compute = lambda now, dt: None
    runner.tick(0.1)
    assert beat.beat.value is None


@pytest.mark.proves("B06")
def test_deadlines_do_not_drift_over_hours():
    clock = FakeClock()
    beat = Metronome("beat")
    runner = runner_of(clock, 0.1, beat)
    run(clock, partial(runner.run, count=20_000))
    assert beat.times == [k * 0.1 for k in range(20_000)]


@pytest.mark.proves("B11", "B12")
def test_an_input_has_many_links_and_those_that_sent_nothing_are_left_out():
    class Pair(Behavior):
        """Sends on one of two ports."""

        first = Output[float]("double", "never")
        second = Output[float]("double", "always")

        def compute(self, now, dt):
            self.second.send(7.0)

    class Sink(Behavior):
        """Takes all."""

        input = Input[float]("double", "numbers")

        def compute(self, now, dt):
            self.taken = (self.input.value, self.input.values, len(self.input.sources))

    network = Network("test")
    network.add(Pair("pair"))
    sink = network.add(Sink("sink"))
    network.connect("pair.first", "sink.input")
    network.connect("pair.second", "sink.input")
    clock = FakeClock()
    runner = Runner(network, Context(clock, EventBus(clock), ResourceManager((), clock)))
    runner.start()
    runner.tick(0.0)
    assert sink.taken == (7.0, [7.0], 2)


def test_a_loop_that_something_else_holds_up_blames_no_behavior(caplog):
    clock = FakeClock()
    beat = Metronome("beat")
    runner = runner_of(clock, 0.1, beat)

    async def hold_up():
        await clock.sleep(0.35)
        clock.advance(0.3)

    run(clock, partial(runner.run, duration=1.0), hold_up)
    assert runner.statistics.missed == 2
    assert runner.statistics.slowest == ""
    assert "something else held the loop up" in caplog.text


def test_a_behavior_that_rests_is_not_blamed_for_what_others_do():
    class Resting(Behavior):
        """Takes long, by the clock of the machine, and fails."""

        def compute(self, now, dt):
            end = perf_counter() + 0.02
            while perf_counter() < end:
                pass
            raise ValueError("no")

    clock = FakeClock()
    runner = runner_of(clock, 0.02, Resting("resting"), Sluggish("slow one"))
    run(clock, partial(runner.run, duration=0.3))
    assert runner.statistics.slowest == "slow one"


def test_what_interrupts_a_tick_leaves_a_network_that_can_be_stopped():
    class Interrupted(Behavior):
        """Ctrl-C comes while it computes."""

        input = Input[float]("double", "a number")

        def compute(self, now, dt):
            raise KeyboardInterrupt

    clock = FakeClock()
    beat, interrupted = Metronome("beat"), Interrupted("interrupted")
    runner = runner_of(clock, 0.1, interrupted, beat)
    runner.inject("interrupted", "input", 1.0)
    with pytest.raises(KeyboardInterrupt):
        runner.tick(0.0)
    assert interrupted.input.sources == []
    runner.stop()
    assert beat.is_stopped


def test_a_stop_from_inside_a_tick_that_is_interrupted_still_stops_all():
    class Last(Behavior):
        """Ends the network, and is interrupted."""

        def compute(self, now, dt):
            runner.stop()
            raise KeyboardInterrupt

    beat = Metronome("beat")
    runner = runner_of(FakeClock(), 0.1, beat, Last("last"))
    with pytest.raises(KeyboardInterrupt):
        runner.tick(0.0)
    assert beat.is_stopped


def test_a_watch_that_fails_is_told_once(caplog):
    runner = runner_of(FakeClock(), 0.1, Metronome("beat"))
    runner.watch("beat", "beat", lambda value, now: 1 / 0)
    for step in range(5):
        runner.tick(step * 0.1)
    assert caplog.text.count("a watch on test failed") == 1


class Muddled(Behavior):
    """Sends a text where it promised a number."""

    number = Output[float]("double", "a number")

    def compute(self, now, dt):
        self.number.send("five")


def test_what_is_not_of_the_datatype_of_its_port_is_not_sent(caplog):
    runner = runner_of(FakeClock(), 0.1, Muddled("muddled"))
    runner.tick(0.0)
    assert runner.network["muddled"].number.value is None
    assert "'five' is of type str was sent - this output is a double" in caplog.text


class Homeless(Behavior):
    """Needs a device that is not configured."""

    def start(self, context):
        context.resources.obtain("sonra", Resource)


def test_what_a_behavior_lacks_is_told_with_its_name():
    with pytest.raises(HriError, match=r'^test\.front: no device "sonra"'):
        runner_of(FakeClock(), 0.1, Homeless("front"))
