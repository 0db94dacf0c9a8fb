"""Spellings of tasks and events that programs of 2003 bring along."""

from hri.task.primitive import Primitive, primitive
from hri.task.task import find_task, task
from tests.task.stage import Stage


def test_a_task_of_the_same_program_is_found_by_its_name():
    @task("Mine.Count")
    async def count(context, upto: float) -> float:
        return upto + 1

    assert find_task("Mine.Count") is count
    assert Stage().run(find_task("Mine.Count"), 2.0) == 3.0


def test_a_primitive_of_the_same_program_is_found_by_its_name():
    @primitive("Mine.Primitive")
    class Mine(Primitive):
        """Does nothing."""

    assert find_task("Mine.Primitive") is Mine


def test_a_task_of_a_package_is_not_replaced_by_one_of_the_program():
    @task("Hri.Wait")
    async def wait(context) -> None:
        """Not the one that others mean."""

    assert find_task("Evolution.Wait") is not wait


def test_termination_requested_may_be_called():
    @task("Mine.Looks")
    async def looks(context) -> list[bool]:
        before = context.termination_requested()
        context.task.termination_requested = True
        return [before, context.termination_requested(), bool(context.termination_requested)]

    assert Stage().run(looks) == [False, True, True]
