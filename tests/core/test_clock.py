import random
import threading
import weakref
from functools import partial

import pytest
import trio
import trio.testing

from hri.core.clock import FakeClock, RealClock


def live(clock, *jobs, hold=False):
    """Run jobs beside the clock until the last one ends."""

    async def main():
        async with trio.open_nursery() as outer:
            outer.start_soon(clock.drive)
            async with trio.open_nursery() as inner:
                for job in jobs:
                    clock.soon(partial(inner.start_soon, job))
                await clock.sleep(0)
            outer.cancel_scope.cancel()

    trio.run(main)


def test_an_hour_passes_at_once_on_the_fake_clock():
    clock = FakeClock()

    async def sleeper():
        await clock.sleep(3600)

    live(clock, sleeper)
    assert clock.now() == 3600


def test_sleepers_of_equal_time_wake_in_the_order_they_asked_every_time():
    def run():
        clock, order = FakeClock(), []

        async def sleeper(name):
            for _ in range(20):
                await clock.sleep(0.1)
                order.append(name)

        live(clock, *(partial(sleeper, name) for name in "abcde"))
        return "".join(order)

    first = run()
    assert first == "abcde" * 20
    assert all(run() == first for _ in range(5))


def test_a_timeout_cancels_and_tells():
    clock = FakeClock()
    caught = []

    async def slow():
        with clock.move_on_after(2.0) as scope:
            await clock.sleep(10)
        caught.append((scope.cancelled_caught, clock.now()))

    live(clock, slow)
    assert caught == [(True, 2.0)]


def test_a_timeout_that_is_not_reached_leaves_no_timer_behind():
    clock = FakeClock()
    scopes = []

    async def quick():
        with clock.move_on_after(1000.0) as scope:
            await clock.sleep(1)
        scopes.append(scope)
        await clock.sleep(2000)

    live(clock, quick)
    assert clock.now() == 2001
    assert not scopes[0].cancel_called


def test_the_result_of_a_worker_shows_up_after_its_modeled_latency():
    clock = FakeClock()
    worker = clock.worker(latency=0.25)
    worker.submit(lambda: 42)
    assert worker.poll() == []
    clock.advance(0.2)
    assert worker.poll() == []
    clock.advance(0.05)
    assert worker.poll() == [42]
    assert worker.poll() == []


def test_a_busy_worker_refuses_a_second_job():
    worker = FakeClock().worker(latency=1.0)
    worker.submit(lambda: 1)
    with pytest.raises(RuntimeError, match="busy"):
        worker.submit(lambda: 2)


def test_an_exception_of_a_job_is_raised_by_poll():
    clock = FakeClock()
    worker = clock.worker(latency=0.0)
    worker.submit(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        worker.poll()
    assert not worker.is_busy


def test_a_held_clock_stands_still_until_it_is_released():
    clock = FakeClock()
    clock.hold()
    seen = []

    async def sleeper():
        await clock.sleep(5)

    async def holder():
        for _ in range(3):
            await trio.lowlevel.checkpoint()
        seen.append(clock.now())
        clock.release()

    async def main():
        async with trio.open_nursery() as outer:
            outer.start_soon(clock.drive)
            async with trio.open_nursery() as inner:
                inner.start_soon(sleeper)
                inner.start_soon(holder)
            outer.cancel_scope.cancel()

    trio.run(main)
    assert seen == [0.0]
    assert clock.now() == 5


def live_in_real_time(main):
    """Run `main(clock)` beside a real clock whose seconds are those of trio, which jumps ahead."""

    async def run():
        clock = RealClock(source=trio.current_time)
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await main(clock)
            nursery.cancel_scope.cancel()

    trio.run(run, clock=trio.testing.MockClock(autojump_threshold=0))


def test_the_real_clock_wakes_sleepers_when_they_asked_for_it():
    woke = []

    async def main(clock):
        async def sleeper(seconds):
            await clock.sleep(seconds)
            woke.append((seconds, round(clock.now(), 6)))

        async with trio.open_nursery() as nursery:
            for seconds in (30, 10, 20):
                nursery.start_soon(sleeper, seconds)
            await clock.sleep(5)
            nursery.start_soon(sleeper, 1)

    live_in_real_time(main)
    assert woke == [(1, 6), (10, 10), (20, 20), (30, 30)]


def test_a_real_timeout_cancels():
    caught = []

    async def main(clock):
        with clock.move_on_after(2) as scope:
            await clock.sleep(10)
        caught.append((scope.cancelled_caught, round(clock.now(), 6)))

    live_in_real_time(main)
    assert caught == [(True, 2)]


def test_a_real_worker_runs_off_the_loop():
    thread_names = []

    async def main(clock):
        worker = clock.worker(latency=0)
        worker.submit(lambda: threading.current_thread().name)
        while not thread_names:
            thread_names.extend(worker.poll())
            await clock.sleep(0.001)
        worker.close()

    live_in_real_time(main)
    assert thread_names != [threading.current_thread().name]


def test_a_timer_in_the_past_runs_now_and_infinity_is_refused():
    clock = FakeClock()
    clock.advance(10)
    assert clock.call_at(3, lambda: None).time == 10
    with pytest.raises(ValueError, match="finite"):
        clock.call_at(float("inf"), lambda: None)


@pytest.mark.proves("P12")
@pytest.mark.parametrize("clock", [FakeClock(), RealClock()])
def test_a_program_without_a_loop_lets_time_pass(clock):
    begun, rang = clock.now(), []
    clock.call_at(begun + 0.01, lambda: rang.append(clock.now()))
    assert clock.advance_until(lambda: bool(rang), 5.0)
    assert begun + 0.01 <= rang[0] < begun + 5.0
    assert not clock.advance_until(lambda: False, 0.01)


def test_waiting_for_what_cannot_happen_is_told():
    with pytest.raises(RuntimeError, match="nothing is left"):
        FakeClock().advance_until(lambda: False)


def test_a_clock_has_one_driver():
    async def main(clock):
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await trio.testing.wait_all_tasks_blocked()
            with pytest.raises(RuntimeError, match="robot loop"):
                clock.advance(1.0)
            nursery.cancel_scope.cancel()

    clock = RealClock()
    trio.run(main, clock)
    assert not clock.is_driven


def test_another_thread_may_ask_the_loop_for_a_timer():
    clock, called = RealClock(), []

    async def main():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await trio.testing.wait_all_tasks_blocked()
            rung = trio.Event()

            def ring():
                called.append(threading.get_ident())
                rung.set()

            await trio.to_thread.run_sync(clock.call_at, 0.0, ring)
            with trio.fail_after(10):
                await rung.wait()
            nursery.cancel_scope.cancel()

    trio.run(main)
    assert called == [threading.get_ident()]


class Alarm:
    """A callback that can be counted."""

    def __init__(self, rang, name):
        self.rang, self.name = rang, name

    def __call__(self):
        self.rang.append(self.name)


def test_timers_that_were_cancelled_are_not_kept_until_they_are_due():
    clock, rang, kept = FakeClock(), [], weakref.WeakSet()
    for number in range(20_000):
        alarm = Alarm(rang, number)
        kept.add(alarm)
        clock.call_at(3600.0, alarm).cancel()
    del alarm
    assert len(kept) <= 2000


def test_clearing_away_what_was_cancelled_changes_no_order():
    clock, rang, chance = FakeClock(), [], random.Random(1)
    wanted = []
    for number in range(10_000):
        when = chance.randrange(50)
        timer = clock.call_at(when, Alarm(rang, (when, number)))
        if chance.random() < 0.8:
            timer.cancel()
        else:
            wanted.append((when, number))
    clock.advance(60)
    assert rang == sorted(wanted)
