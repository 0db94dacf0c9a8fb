import threading

import pytest
import trio

from hri.core.clock import FakeClock, RealClock
from hri.hal.pending import Interrupted, Pending, completed

pytestmark = pytest.mark.proves("H27")


def due(clock: FakeClock, seconds: float, value: str = "there") -> Pending[str]:
    pending: Pending[str] = Pending(clock)
    clock.call_at(clock.now() + seconds, lambda: pending.complete(value))
    return pending


def test_waiting_without_a_loop_lets_time_pass():
    clock = FakeClock()
    assert due(clock, 1.5).wait() == "there"
    assert clock.now() == 1.5


def test_a_wait_that_takes_too_long_ends_and_the_work_goes_on():
    clock = FakeClock()
    pending = due(clock, 1.5)
    with pytest.raises(TimeoutError, match=r"no result within 0\.5 s"):
        pending.wait(0.5)
    with pytest.raises(RuntimeError, match="no result yet"):
        pending.result()
    assert pending.wait(2.0) == "there"
    assert clock.now() == 1.5


def in_loop(clock, program):
    async def main():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            result = await program()
            nursery.cancel_scope.cancel()
            return result

    return trio.run(main)


def test_it_can_be_awaited_by_several():
    clock = FakeClock()

    async def program():
        pending = due(clock, 2.0)
        heard = []

        async def hear():
            heard.append((await pending, clock.now()))

        async with trio.open_nursery() as nursery:
            nursery.start_soon(hear)
            nursery.start_soon(hear)
        return heard, await pending

    assert in_loop(clock, program) == ([("there", 2.0)] * 2, "there")


def test_an_await_that_is_given_up_leaves_the_work_alone():
    clock = FakeClock()

    async def program():
        pending = due(clock, 2.0)
        with clock.move_on_after(1.0) as scope:
            await pending
        assert scope.cancelled_caught
        assert not pending.is_done
        return await pending

    assert in_loop(clock, program) == "there"


def test_the_robot_loop_refuses_to_be_blocked():
    clock = FakeClock()

    async def program():
        pending = due(clock, 1.0)
        with pytest.raises(RuntimeError, match="await it"):
            pending.wait()
        await pending
        return pending.wait()  # what is there blocks nobody

    assert in_loop(clock, program) == "there"


def test_another_thread_waits_while_the_loop_runs():
    clock = FakeClock()

    async def program():
        return await trio.to_thread.run_sync(due(clock, 3.0).wait)

    assert in_loop(clock, program) == "there"


def test_held_time_passes_while_a_thread_waits_and_no_longer():
    clock = FakeClock()

    def script(pending):
        with pytest.raises(TimeoutError):
            pending.wait(1.0)
        return clock.now(), pending.wait()

    async def program():
        clock.hold()
        pending = due(clock, 3.0)
        clock.call_at(9.0, lambda: None)
        return await trio.to_thread.run_sync(script, pending)

    assert in_loop(clock, program) == (1.0, "there")
    assert clock.now() == 3.0


def test_a_thread_may_bring_the_result():
    pending: Pending[int] = Pending(RealClock())
    threading.Thread(target=pending.complete, args=(7,)).start()
    assert pending.wait(10.0) == 7


def test_a_thread_may_bring_the_result_to_a_task_that_awaits():
    clock = RealClock()

    async def program():
        pending: Pending[int] = Pending(clock)
        threading.Thread(target=pending.complete, args=(7,)).start()
        with trio.fail_after(10.0):
            return await pending

    assert in_loop(clock, program) == 7


def test_callbacks_come_once_also_when_it_is_over():
    clock = FakeClock()
    pending, calls = due(clock, 1.0), []
    pending.on_done(lambda ended: calls.append(("early", ended.result())))
    assert calls == []
    clock.advance(1.0)
    pending.on_done(lambda ended: calls.append(("late", ended.result())))
    assert calls == [("early", "there"), ("late", "there")]


@pytest.mark.proves("P14")
def test_a_failure_is_an_exception_however_it_is_learnt():
    clock = FakeClock()
    pending: Pending[None] = Pending(clock)
    assert pending.fail(OSError("the cable is out"))
    for learn in (pending.result, pending.wait):
        with pytest.raises(OSError, match="the cable is out"):
            learn()

    async def program():
        with pytest.raises(OSError, match="the cable is out"):
            await pending

    in_loop(clock, program)


def test_cancelling_ends_the_work_and_says_why():
    stops = []
    pending: Pending[str] = Pending(FakeClock(), on_cancel=lambda: stops.append("stop"))
    assert pending.cancel("another move came - wait for the first")
    assert not pending.cancel()
    assert not pending.complete("too late")
    assert stops == ["stop"]
    with pytest.raises(Interrupted, match="another move came"):
        pending.wait()


def test_the_first_end_counts():
    pending = completed(FakeClock(), "done")
    assert not pending.fail(OSError())
    assert not pending.cancel()
    assert pending.wait() == "done"


def test_many_threads_agree_on_one_end():
    pending: Pending[int] = Pending(FakeClock())
    barrier, firsts = threading.Barrier(16), []

    def end(number: int) -> None:
        barrier.wait()
        if pending.complete(number):
            firsts.append(number)

    threads = [threading.Thread(target=end, args=(number,)) for number in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert firsts == [pending.result()]
