import pytest

from hri.core.errors import HriError
from hri.task.parallel import Parallel
from hri.task.patterns import TooSlow, repeat, retry, with_timeout
from hri.task.task_run import TaskStatus
from hri.task.util import Wait
from tests.task.stage import Stage

pytestmark = pytest.mark.proves("T08")


async def fail(context):
    context.fail("no")


def test_waiting_for_the_first_cancels_the_others():
    async def main(context):
        race = Parallel(context)
        slow, fast = race.add_task(Wait, [5000]), race.add_task(Wait, [1000])
        await context.clock.sleep(10)
        assert slow.status is fast.status is TaskStatus.READY
        assert await race.wait_for_first_task() is fast
        assert (fast.status, slow.status) == (TaskStatus.SUCCESS, TaskStatus.CANCELLED)
        assert context.clock.now() == 11

    Stage().run(main)


def test_waiting_for_all_takes_as_long_as_the_longest():
    async def main(context):
        all_three = Parallel(context)
        tasks = [all_three.add_task(Wait, [1000 * n]) for n in (3, 1, 2)]
        failing = all_three.add_task(fail)
        assert await all_three.wait_for_all_tasks() == [*tasks, failing]
        assert context.clock.now() == 3
        assert failing.status is TaskStatus.FAILURE
        assert {task.status for task in tasks} == {TaskStatus.SUCCESS}

    Stage().run(main)


def test_cancelling_the_one_that_waits_cancels_all():
    async def main(context):
        both = Parallel(context)
        tasks = [both.add_task(Wait, [9000]) for _ in range(2)]
        with context.clock.move_on_after(1.0):
            await both.wait_for_all_tasks()
        assert {task.status for task in tasks} == {TaskStatus.CANCELLED}

    Stage().run(main)


def test_mistakes():
    async def main(context):
        with pytest.raises(RuntimeError, match=r"write Parallel\(context\)"):
            Parallel()
        nothing = Parallel(context)
        with pytest.raises(ValueError, match="nothing to wait for"):
            nothing.wait_for_first_task()
        assert await nothing.wait_for_all_tasks() == []
        with pytest.raises(HriError, match=r"Hri\.Wait: missing"):
            nothing.add_task(Wait)

    Stage().run(main)


def test_timeouts_retries_and_repetitions():
    tries = []

    async def third_time_lucky(context):
        tries.append(context.clock.now())
        if len(tries) < 3:
            context.fail("not yet")
        return len(tries)

    async def main(context):
        with pytest.raises(TooSlow, match=r"Hri.Wait took longer than 1 s"):
            await with_timeout(context, 1.0, Wait, 2000)
        await with_timeout(context, 3.0, Wait, 2000)
        assert await retry(context, 3, 0.5, third_time_lucky) == 3
        assert tries == [3.0, 3.5, 4.0]
        with pytest.raises(HriError, match="no"):
            await retry(context, 2, 0.5, fail)
        assert await repeat(context, 2, third_time_lucky) == [4, 5]

    Stage().run(main)
