import math

import pytest
import trio

from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.tasks import move, stop, turn
from hri.task.context import TaskContext
from tests.drive.course import Course


@pytest.mark.parametrize("distance", [10.0, 1.0, 0.1, -0.5])
def test_move_goes_the_distance(distance: float) -> None:
    course = Course()
    travelled = course.run(lambda context: move(context, distance))
    assert course.base.pose.x == pytest.approx(distance, abs=0.01)
    assert travelled == pytest.approx(course.base.pose.x, abs=0.001)
    assert course.base.velocity.linear == pytest.approx(0.0, abs=0.005)
    assert course.reasons() == ["done"]


def test_ten_meters_take_no_longer_than_they_must() -> None:
    course = Course()
    course.run(lambda context: move(context, 10.0))
    assert course.fastest == pytest.approx(0.3)
    assert course.clock.now() < 10.0 / 0.3 + 3.0


def test_move_takes_a_speed_and_a_mood() -> None:
    course = Course()
    course.hurries.value = 0.6
    assert course.run(lambda context: move(context, 1.0, speed=0.2)) == pytest.approx(1.0, abs=0.01)
    assert course.fastest == pytest.approx(0.12)


@pytest.mark.parametrize("hurry", [0.6, 1.2])
def test_who_hurries_or_dawdles_comes_to_rest_at_the_goal_and_does_not_come_back(
    hurry: float,
) -> None:
    course = Course()
    course.hurries.value = hurry
    moved = course.run(lambda context: move(context, 0.5))
    assert moved == pytest.approx(0.5, abs=0.01)
    assert course.base.way == pytest.approx(moved, abs=0.002)
    assert course.run(lambda context: turn(context, 0.3)) == pytest.approx(0.3, abs=0.02)


def test_move_takes_an_acceleration_for_both_ends() -> None:
    course = Course()
    moved = course.run(lambda context: move(context, 1.0, speed=0.2, acceleration=0.1))
    assert moved == pytest.approx(1.0, abs=0.01)
    assert course.clock.now() == pytest.approx(1.0 / 0.2 + 0.2 / 0.1, abs=0.4)


def test_an_acceleration_beyond_the_gates_carries_it_no_farther() -> None:
    course = Course(deceleration=0.2)
    assert course.run(lambda context: move(context, 1.0, 0.4, 5.0)) == pytest.approx(1.0, abs=0.01)
    assert course.base.way == pytest.approx(1.0, abs=0.01), "it did not come back"


def test_move_holds_its_heading_on_slipping_wheels() -> None:
    course = Course(slip=0.01)
    course.run(lambda context: move(context, 10.0))
    assert course.base.odometry.x == pytest.approx(10.0, abs=0.01)
    assert course.base.odometry.heading == pytest.approx(0.0, abs=0.02)
    assert course.base.pose.x == pytest.approx(10.0, rel=0.02)


@pytest.mark.parametrize("angle", [math.pi / 2, -math.pi, 5 * math.pi, math.radians(5)])
def test_turn_turns_the_angle(angle: float) -> None:
    course = Course()
    turned = course.run(lambda context: turn(context, angle))
    assert turned == pytest.approx(angle, abs=math.radians(1))
    assert course.base.pose.heading == pytest.approx(angle, abs=math.radians(1))
    assert course.base.pose.x == pytest.approx(0.0, abs=1e-6)


def test_move_gives_up_before_a_wall_and_tells_how_far_it_got() -> None:
    course = Course(wall=2.0)
    travelled = course.run(lambda context: move(context, 10.0))
    assert 1.4 < travelled < 1.6
    assert course.reasons() == ["obstacle"]


def test_cancelling_a_move_stops_the_base() -> None:
    course = Course()

    async def moved_for_a_while(context: TaskContext) -> None:
        with context.clock.move_on_after(3.0):
            await move(context, 10.0)
        await context.clock.sleep(1.0)

    course.run(moved_for_a_while)
    assert course.base.velocity == Twist()
    assert 0.6 < course.base.pose.x < 1.1
    assert course.reasons() == ["done"]


def test_halt_ends_a_move() -> None:
    course = Course()

    async def halted(context: TaskContext) -> float:
        context.clock.call_at(3.0, course.gate.halt)
        return await move(context, 10.0)

    assert course.run(halted) == pytest.approx(course.base.pose.x, abs=0.01)
    assert course.clock.now() < 4.5
    assert course.reasons() == ["halt"]


def test_stop_ends_a_move_gently() -> None:
    course = Course()

    async def stopped(context: TaskContext) -> float:
        results = []

        async def moving() -> None:
            results.append(await move(context, 10.0))

        async with trio.open_nursery() as nursery:
            nursery.start_soon(moving)
            await context.clock.sleep(3.0)
            await stop(context)
        return results[0]

    assert 0.7 < course.run(stopped) < 1.1
    assert course.base.velocity.linear == pytest.approx(0.0, abs=0.005)
    assert course.reasons() == ["done"]


def test_a_new_motion_takes_over() -> None:
    course = Course()

    async def both(context: TaskContext) -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(move, context, 10.0)
            await context.clock.sleep(2.0)
            nursery.start_soon(turn, context, 1.0)

    course.run(both)
    assert course.base.pose.x < 1.0
    assert course.base.pose.heading == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("distance", [math.nan, math.inf])
def test_move_refuses_what_it_cannot_do(distance: float) -> None:
    course = Course()
    with pytest.raises(ValueError, match="finite"):
        trio.run(move, course.task, distance)
    with pytest.raises(ValueError, match="above 0"):
        trio.run(move, course.task, 1.0, 0.0)
    with pytest.raises(ValueError, match=r"-1 m/s² - give a number above 0"):
        trio.run(move, course.task, 1.0, 0.2, -1)


def test_the_guides_fifty_given_in_meters_is_refused_with_both_readings() -> None:
    course = Course()
    with pytest.raises(HriError, match=r"a move of 50 m .* \(20 m\) - give 0\.5 if you meant cm"):
        trio.run(move, course.task, 50.0)


def test_a_turn_takes_a_second_for_each_radian_and_more_when_it_is_to_be_slower() -> None:
    course = Course()
    course.run(lambda context: turn(context, 2 * math.pi))
    assert course.clock.now() == pytest.approx(2 * math.pi, abs=1.5)
    course = Course()
    course.run(lambda context: turn(context, 2 * math.pi, rate=0.5))
    assert course.clock.now() == pytest.approx(4 * math.pi, abs=1.5)
