import pytest
import trio
from hypothesis import given, settings, strategies as st

from hri.task.claims import Interrupted
from hri.task.parallel import Parallel
from hri.task.task_run import TaskStatus
from tests.task.stage import Stage


def holding(log, name, seconds, thing, priority=0):
    """A job that claims something and notes when it has it."""

    async def job(context):
        try:
            async with context.claim(thing, priority):
                log.append((name, "has", context.clock.now()))
                await context.clock.sleep(seconds)
                log.append((name, "is done", context.clock.now()))
        except Interrupted as error:
            log.append((name, str(error), context.clock.now()))
            raise

    job.__name__ = name
    return job


def test_a_newer_motion_replaces_the_older_one_which_learns_why():
    log = []

    async def main(context):
        first = context.manager.install(holding(log, "first", 9, "drive"))
        await context.clock.sleep(1)
        context.manager.install(holding(log, "second", 2, "drive"))
        await context.manager.wait()
        assert first.status is TaskStatus.CANCELLED
        assert isinstance(first.error, Interrupted)

    stage = Stage()
    stage.run(main)
    assert log == [
        ("first", "has", 0),
        ("first", "second has taken the drive - try again when it is free", 1),
        ("second", "has", 1),
        ("second", "is done", 3),
    ]
    assert "task.failed" not in stage.names()


def test_sentences_come_one_after_the_other():
    log = []

    async def main(context):
        for name in ("first", "second", "third"):
            context.manager.install(holding(log, name, 2, "voice"))
        await context.clock.sleep(1)
        assert context.manager.claims.holder("voice") == "first"
        assert context.manager.claims.holder("drive") is None
        await context.manager.wait()

    Stage().run(main)
    assert [line for line in log if line[1] == "has"] == [
        ("first", "has", 0),
        ("second", "has", 2),
        ("third", "has", 4),
    ]


@pytest.mark.parametrize("thing", ["drive", "voice"])
def test_the_higher_priority_interrupts_and_the_lower_waits(thing):
    log = []

    async def main(context):
        context.manager.install(holding(log, "low", 9, thing))
        await context.clock.sleep(1)
        context.manager.install(holding(log, "high", 2, thing, priority=1))
        await context.clock.sleep(1)
        context.manager.install(holding(log, "late", 2, thing))
        await context.manager.wait()

    Stage().run(main)
    assert [(name, when) for name, what, when in log if what == "has"] == [
        ("low", 0),
        ("high", 1),
        ("late", 3),
    ]


def test_a_holder_claims_again_and_lends_to_its_parallel_tasks():
    log = []

    async def main(context):
        async with context.claim("drive"):
            await holding(log, "again", 1, "drive")(context)
            both = Parallel(context)
            both.add_task(holding(log, "left", 5, "drive"))
            both.add_task(holding(log, "right", 1, "drive"))
            await both.wait_for_all_tasks()

    Stage().run(main)
    assert log == [
        ("again", "has", 0),
        ("again", "is done", 1),
        ("left", "right has taken the drive - try again when it is free", 1),
        ("right", "has", 1),
        ("right", "is done", 2),
    ]


def test_what_a_holder_installs_claims_like_any_other():
    log = []

    async def main(context):
        async with context.claim("drive"):
            context.manager.install(holding(log, "installed", 1, "drive"))
            await context.clock.sleep(9)

    stage = Stage()
    with pytest.raises(Interrupted, match="installed has taken the drive"):
        stage.run(main)


CLAIMS = st.lists(
    st.tuples(
        st.sampled_from(["drive", "voice", "arm"]),
        st.integers(0, 2),
        st.integers(0, 6),
        st.integers(0, 4),
        st.one_of(st.none(), st.integers(0, 8)),
        st.booleans(),
    ),
    max_size=8,
)


@settings(deadline=None)
@given(CLAIMS)
def test_there_are_never_two_holders_and_nobody_waits_for_ever(claims):
    holders = {"drive": 0, "voice": 0, "arm": 0}
    served = []

    async def use(context, thing, priority, seconds, is_nested):
        async with context.claim(thing, priority):
            if is_nested:
                await use(context, thing, 0, seconds, False)
                return
            holders[thing] += 1
            try:
                assert holders[thing] == 1
                await context.clock.sleep(seconds / 10)
            finally:
                holders[thing] -= 1
            served.append(thing)

    async def main(context):
        tasks = []
        for thing, priority, begin, seconds, cancel, is_nested in claims:
            await context.clock.sleep(begin / 10)
            tasks.append(context.manager.install(use, thing, priority, seconds, is_nested))
            if cancel is not None:
                context.clock.call_at(context.clock.now() + cancel / 10, tasks[-1].cancel)
        await context.manager.wait()
        for task in tasks:
            assert task.status in (TaskStatus.SUCCESS, TaskStatus.CANCELLED), task.error

    Stage().run(main)
    assert not any(holders.values())
    if claims and all(claim[4] is None for claim in claims):
        assert served


def test_an_interruption_inside_a_nursery_is_one():
    log = []

    async def nest(context):
        async with context.claim("drive"), trio.open_nursery() as nursery:
            nursery.start_soon(holding(log, "first", 5, "drive"), context)
            await context.clock.sleep(1)
            nursery.start_soon(holding(log, "second", 1, "drive"), context)

    async def main(context):
        nested = context.manager.install(nest)
        await nested.wait()
        assert nested.status is TaskStatus.CANCELLED
        assert isinstance(nested.error, Interrupted)

    stage = Stage()
    stage.run(main)
    assert (
        "first",
        "a newer claim of nest has taken the drive - try again when it is free",
        1,
    ) in log
    assert "task.failed" not in stage.names()


def test_what_fails_beside_an_interruption_is_a_failure():
    async def main(context):
        async def give_way():
            raise Interrupted("somebody has taken the drive")

        async def fail():
            raise ValueError("no")

        async def nest(context):
            async with trio.open_nursery() as nursery:
                nursery.start_soon(give_way)
                nursery.start_soon(fail)

        nested = context.manager.install(nest)
        await nested.wait()
        assert nested.status is TaskStatus.FAILURE

    Stage().run(main)
