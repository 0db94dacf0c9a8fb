"""Functions that run beside the loop call tasks as a plain script does, in the loop that runs."""

import threading

import pytest

from hri.core.errors import HriError
from hri.task import Parallel, get_task_manager, script
from hri.task.context import TaskContext, TaskFailed
from hri.task.task import task
from hri.task.util import Wait
from tests.task.stage import Stage


@task("Aside.Double")
async def double(context: TaskContext, number: float) -> float:
    await context.clock.sleep(2.0)
    if number < 0:
        context.fail("no negative numbers")
    return 2 * number


def test_a_plain_call_runs_in_the_loop_that_runs_and_waits_for_it(monkeypatch) -> None:
    monkeypatch.setattr(script, "_make", lambda: pytest.fail("a second task manager was made"))
    stage = Stage()

    def plain() -> tuple[float, str]:
        assert get_task_manager() is stage.manager
        doubled = double(4)
        try:
            double(-1)
        except TaskFailed as error:
            return doubled, str(error)
        return doubled, ""

    async def job(context: TaskContext) -> tuple[float, str]:
        found: tuple[float, str] = await context.blocking(plain)
        return found

    assert stage.run(job) == (8.0, "no negative numbers")
    assert stage.clock.now() == pytest.approx(4.0, abs=0.1)


def test_parallel_events_and_installed_tasks_work_from_there_too() -> None:
    stage = Stage()

    def plain() -> list[float]:
        both = Parallel()
        tasks = [both.add_task(double, [number]) for number in (1, 2)]
        both.wait_for_all_tasks()
        get_task_manager().raise_event("aside.over", many=2)
        installed = get_task_manager().install(double, 5)
        Wait(3000)
        return [*(one.result for one in tasks), installed.result]

    assert stage.run(lambda context: context.blocking(plain)) == [2.0, 4.0, 10.0]
    assert "aside.over" in stage.names()


def test_a_task_that_is_cancelled_ends_what_its_function_has_called() -> None:
    stage, ends = Stage(), []
    is_over = threading.Event()

    @task("Aside.Long")
    async def long(context: TaskContext) -> None:
        try:
            await context.clock.sleep(100.0)
        finally:
            ends.append(context.clock.now())

    def plain() -> None:
        try:
            long()
        except RuntimeError as error:
            ends.append(str(error))
        try:
            long()
        except (RuntimeError, HriError):
            is_over.set()

    async def job(context: TaskContext) -> None:
        with context.clock.move_on_after(1.0):
            await context.blocking(plain)
        await context.clock.sleep(1.0)
        await context.blocking(is_over.wait, 10.0)

    stage.run(job)
    assert ends[0] == pytest.approx(1.0, abs=0.1)
    assert is_over.is_set()


def test_a_thread_of_ones_own_beside_a_robot_is_refused_in_a_sentence() -> None:
    refused = []

    def plain() -> None:
        try:
            Wait(10)
        except HriError as error:
            refused.append(str(error))

    with script.robot_lives():
        thread = threading.Thread(target=plain)
        thread.start()
        thread.join(10.0)
    assert refused == [
        "a robot runs in this process, and this thread does not belong to it"
        " - run the function by `await context.blocking(function)`"
    ]
