import pytest
import trio

from hri.core.errors import HriError
from hri.task.context import TaskContext, TaskFailed
from hri.task.task import find_task, task
from hri.task.task_run import TaskStatus
from tests.task.stage import Stage


@task("Examples.Double")
async def double(context: TaskContext, number: float, text: str = "") -> float:
    """Twice a number, after a second."""
    await context.clock.sleep(1.0)
    return 2 * number


@task("Examples.Sum")
async def total(context: TaskContext, numbers: tuple[float, ...]) -> tuple[float, ...]:
    """The numbers and their sum."""
    return (*numbers, sum(numbers))


async def fail(context):
    context.fail("it is too dark")


async def crash(context):
    raise KeyError("oops")


async def for_ever(context):
    await trio.sleep_forever()


@pytest.mark.proves("T01", "T02")
def test_a_task_is_found_by_name_and_run_with_a_context():
    wait = find_task("Evolution.Wait")
    assert wait is find_task("Hri.Wait")
    assert wait.id == "Hri.Wait"
    assert repr(wait) == "<TaskType Hri.Wait(milliseconds: float) -> None>"
    stage = Stage()
    stage.run(wait, 1500)
    assert stage.clock.now() == 1.5
    with pytest.raises(
        HriError, match=r'unknown task "Evolution.Wiat" - did you mean "Evolution.Wait"'
    ):
        find_task("Evolution.Wiat")


@pytest.mark.proves("T02", "T06", "T11")
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((), r"Examples.Double: missing a required argument: 'number' - it takes \(number"),
        ((1, "a", 2), "too many positional arguments"),
        (("one",), "number is 'one' - give a number"),
        ((True,), "number is True - give a number"),
        ((1, 2), "text is 2 - give a text"),
    ],
)
def test_arguments_that_do_not_fit_are_told(arguments, message):
    stage = Stage()
    with pytest.raises(HriError, match=message):
        stage.manager.make(double, *arguments)
    with pytest.raises(HriError, match=message):
        double(stage.context, *arguments)


@pytest.mark.proves("T06")
def test_lists_become_tuples_of_floats():
    assert Stage().run(total, [1, 2]) == (1.0, 2.0, 3.0)
    with pytest.raises(HriError, match="give numbers"):
        Stage().run(total, ["a"])


@pytest.mark.proves("T06")
def test_inside_of_a_task_it_is_awaited():
    async def main(context):
        assert await double(context, 4) == 8
        with pytest.raises(RuntimeError, match="await it with the context"):
            double(4)

    Stage().run(main)


@pytest.mark.proves("T03", "T09")
def test_status_result_and_error_of_a_task():
    async def main(context):
        manager = context.manager
        working, failing, crashing = (
            manager.install(double, 4),
            manager.install(fail),
            manager.install(crash),
        )
        assert working.status is TaskStatus.READY
        await context.clock.sleep(0.5)
        assert working.status is TaskStatus.RUNNING
        assert working.result is None
        assert await working.wait() is TaskStatus.SUCCESS
        assert (working.result, working.error) == (8, None)
        assert failing.status is TaskStatus.FAILURE
        assert isinstance(failing.error, TaskFailed)
        assert isinstance(crashing.error, KeyError)

    stage = Stage()
    stage.run(main)
    failures = [event.properties for event in stage.events if event.name == "task.failed"]
    assert failures == [
        {"task": "fail", "error": "it is too dark"},
        {"task": "crash", "error": "'oops'"},
    ]


@pytest.mark.proves("T03")
def test_a_failure_of_a_task_that_is_awaited_is_raised():
    with pytest.raises(TaskFailed, match="too dark"):
        Stage().run(fail)


@pytest.mark.proves("T09", "T10")
def test_cancelling():
    log = []

    async def cooperative(context):
        while not context.termination_requested:
            with trio.CancelScope(shield=True):
                await context.clock.sleep(1.0)
        log.append(context.clock.now())

    async def main(context):
        manager = context.manager
        running, unborn, polite = (
            manager.install(for_ever),
            manager.install(for_ever),
            manager.install(cooperative),
        )
        unborn.cancel()
        await context.clock.sleep(2.5)
        for each in (running, running, polite):
            each.cancel()
        await manager.wait()
        assert unborn.status is running.status is TaskStatus.CANCELLED
        assert polite.status is TaskStatus.SUCCESS
        assert manager.running == [context.task]

    Stage().run(main)
    assert log == [3.0]


@pytest.mark.proves("T07", "T09")
def test_shutdown_cancels_all_and_may_be_called_twice():
    async def main(context):
        tasks = [context.manager.install(for_ever) for _ in range(3)]
        await context.clock.sleep(1.0)
        with trio.CancelScope(shield=True):
            context.manager.shutdown()
            context.manager.shutdown()
            await tasks[0].wait()
        assert {each.status for each in tasks} == {TaskStatus.CANCELLED}

    stage = Stage()
    assert stage.run(main) is None


def test_nothing_can_be_installed_where_no_robot_lives():
    with pytest.raises(RuntimeError, match="lives"):
        Stage().manager.install(for_ever)


@pytest.mark.proves("T12", "T13", "T14")
def test_events_are_queued_between_enable_and_disable():
    async def main(context):
        task, raise_event = context.task, context.manager.raise_event
        raise_event("photo.lost")
        assert await task.wait_for_event("photo.*", timeout=1.0) is None
        task.enable_event("photo.*")
        task.enable_event("photo.*")
        raise_event("photo.taken", count=1)
        raise_event("door.opened")
        raise_event("photo.taken", count=2)
        task.disable_event("photo.*")
        raise_event("photo.taken", count=3)
        counts = [(await task.wait_for_event("*")).properties["count"] for _ in range(2)]
        assert counts == [1, 2]
        task.disable_event("photo.*")
        raise_event("photo.taken", count=4)
        assert await task.wait_for_event("*", timeout=1.0) is None
        with pytest.raises(HriError, match="is not enabled"):
            task.disable_event("photo.*")

    Stage().run(main)


@pytest.mark.proves("T13")
def test_waiting_for_one_event_keeps_the_others_that_are_enabled():
    async def main(context):
        task, raise_event = context.task, context.manager.raise_event
        task.enable_event("a.*")
        for name in ("a.first", "b.second", "a.third"):
            context.clock.soon(lambda name=name: raise_event(name))
        assert (await task.wait_for_event("b.*")).name == "b.second"
        assert (await task.wait_for_event("a.third")).name == "a.third"
        assert (await task.wait_for_event("a.*")).name == "a.first"

    Stage().run(main)


def test_two_parts_of_a_task_wait_for_events_at_once():
    came = []

    async def main(context):
        async def wait_for(pattern):
            event = await context.task.wait_for_event(pattern, timeout=10.0)
            came.append((pattern, event and event.name, context.clock.now()))

        async with trio.open_nursery() as nursery:
            for pattern in ("a", "b", "*"):
                nursery.start_soon(wait_for, pattern)
                await context.clock.sleep(0)
            for at, name in enumerate("cba", start=1):
                context.clock.call_at(float(at), lambda name=name: context.events.raise_event(name))

    Stage().run(main)
    assert came == [("*", "c", 1.0), ("b", "b", 2.0), ("a", "a", 3.0)]


def test_a_listener_that_fails_is_no_failure_of_the_task_that_raises():
    async def main(context):
        context.events.subscribe("*", lambda event: 1 / 0)
        failing = context.manager.install(fail)
        await failing.wait()
        assert failing.status is TaskStatus.FAILURE

    stage = Stage()
    stage.run(main)
    assert "task.failed" in stage.names()


def test_waiting_needs_a_time():
    for never in (float("nan"), float("inf")):
        with pytest.raises(HriError, match=f"{never} is not a time - "):
            Stage().run(find_task("Hri.Wait"), never)
    with pytest.raises(HriError, match="nan is not a time"):
        Stage().run(find_task("Hri.WaitForEvent"), "door.*", float("nan"))
    stage = Stage()
    stage.run(find_task("Hri.Wait"), -5)
    assert stage.clock.now() == 0
