"""The ends of motions: how near the base gets, alone and after many, and where things stand."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import trio
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.geometry import after_move, along_arc, wrapped
from hri.core.latest import Board
from hri.core.signals import Pose2D
from hri.drive import navigation_tasks, tasks_2003
from hri.drive.arrival import Arrival
from hri.drive.avoidance import Manner, is_reached, straight_to, turn_to
from hri.drive.nominal_pose import nominal_pose, note_arrival
from hri.hal.motion import REST
from hri.task.context import TaskContext, TaskFailed
from tests.drive.test_navigation_tasks import Set

HALL = "[robot]\nstart = [3, 3]\n[person]\nat = [0.5, 0.5]\n" + "".join(
    f"[[wall]]\nfrom = {one}\nto = {other}\n"
    for one, other in (
        ([0, 0], [6, 0]),
        ([6, 0], [6, 6]),
        ([6, 6], [0, 6]),
        ([0, 6], [0, 0]),
    )
)
BOX = "[[box]]\ncenter = [4, 3]\nlength = 0.4\nwidth = 0.4\n"
TICK = 0.05


class Trip:
    """Tasks one after another in the hall, and how far the base is from where they lead."""

    def __init__(self, folder: Path, things: str = "", robot: str = "three sensors") -> None:
        self.stage = Set(folder, HALL + things, robot)
        self.base = self.stage.world.base
        self.meant = Pose2D()
        self.worst = self.worst_turn = 0.0
        self.swings = 0

    def drive(self, task: Any, *moves: tuple[float, ...]) -> None:
        self.stage.run(self._drive, task, moves)

    async def _drive(self, context: TaskContext, task: Any, moves: tuple[Any, ...]) -> None:
        for move in moves:
            await task(context, *move)
            self.meant = after_move(self.meant, move[0] / 100, move[1] / 100)
            stands = self.base.odometry
            self.worst = max(self.worst, _apart(stands, self.meant))
            off = abs(wrapped(stands.heading - self.meant.heading))
            self.worst_turn = max(self.worst_turn, off)

    def go_to(self, x: float, y: float, near: float = 0.0) -> float:
        """Meters from a place of the hall in the end; counts swings to and fro on the last bit."""
        goal = Pose2D(x - 3.0, y - 3.0)

        async def watched(context: TaskContext) -> None:
            async with trio.open_nursery() as nursery:
                nursery.start_soon(self._watch, context, goal)
                await navigation_tasks.go_to_task(context, goal.x * 100, goal.y * 100, None, near)
                nursery.cancel_scope.cancel()

        with unpacked():
            self.stage.run(watched)
        return _apart(self.base.odometry, goal)

    async def _watch(self, context: TaskContext, goal: Pose2D) -> None:
        before = 0.0
        while True:
            if _apart(self.base.odometry, goal) < 0.2:
                rate = self.base.velocity.angular
                self.swings += rate * before < -1e-3
                before = rate
            await context.clock.sleep(TICK)


@contextmanager
def unpacked() -> Iterator[None]:
    """Raise the one error of a nursery as it is."""
    try:
        yield
    except ExceptionGroup as group:
        raise group.exceptions[0] from None


def _apart(one: Pose2D, other: Pose2D) -> float:
    return math.dist((one.x, one.y), (other.x, other.y))


@pytest.mark.proves("C02")
@pytest.mark.parametrize(
    "move", [(5, 5), (8, 0), (0, 8), (10, 20), (10, -30), (25, 50), (-5, 0), (1, 0), (0, -2)]
)
def test_a_relative_move_ends_within_a_centimeter_and_a_degree(
    tmp_path: Path, move: tuple[int, int]
) -> None:
    trip = Trip(tmp_path)
    trip.drive(navigation_tasks.go_by, move)
    assert trip.worst < 0.005
    assert trip.worst_turn < math.radians(1)
    assert trip.stage.clock.now() < 7.0


@pytest.mark.proves("C02")
@pytest.mark.parametrize("robot", ["no sensors", "nine sensors"])
def test_errors_of_many_small_moves_do_not_add_up(tmp_path: Path, robot: str) -> None:
    trip = Trip(tmp_path, robot=robot)
    trip.drive(navigation_tasks.go_by, *[(5, 5)] * 8, *[(6, 0)] * 12, *[(10, 20), (10, -30)] * 3)
    assert trip.worst < 0.01
    assert trip.worst_turn < math.radians(1)
    assert not trip.base.is_touching


def test_errors_of_drive_move_delta_and_turn_delta_do_not_add_up(tmp_path: Path) -> None:
    trip = Trip(tmp_path)

    async def square(context: TaskContext) -> None:
        for _ in range(8):
            for _ in range(4):
                await tasks_2003.drive_move_delta(context, 5.0)
            for _ in range(3):
                await tasks_2003.drive_turn_delta(context, math.pi / 6)

    trip.stage.run(square)
    stands = trip.base.odometry
    assert math.hypot(stands.x, stands.y) < 0.01
    assert abs(wrapped(stands.heading)) < math.radians(1)


@pytest.mark.parametrize("centimeters", [0.5, 1.0, -1.0, 3.0])
def test_a_motion_of_a_centimeter_is_one(tmp_path: Path, centimeters: float) -> None:
    trip = Trip(tmp_path)
    trip.stage.run(tasks_2003.drive_move_delta, centimeters)
    assert trip.base.odometry.x == pytest.approx(centimeters / 100, abs=0.0035)


@pytest.mark.parametrize(
    ("x", "y", "within"),
    [
        (5.65, 3.0, 0.005),
        (5.7, 3.0, 0.1),  # here the wall is too near
        (5.5, 0.6, 0.005),
        (3.45, 3.0, 0.005),
        (3.5, 3.0, 0.1),  # here the box is
        (4.65, 3.0, 0.005),
        (4.45, 3.0, 0.1),
    ],
)
def test_near_things_it_comes_as_near_as_there_is_room_and_does_not_swing(
    tmp_path: Path, x: float, y: float, within: float
) -> None:
    trip = Trip(tmp_path, BOX)
    assert trip.go_to(x, y) <= within
    assert trip.swings == 0
    assert "bumper.pressed" not in trip.stage.names()
    assert not trip.base.is_touching


def test_a_task_takes_how_near_counts(tmp_path: Path) -> None:
    assert 0.15 < Trip(tmp_path).go_to(4.0, 3.0, near=30.0) <= 0.3
    with pytest.raises(HriError, match=r"at least 0\.005 m"):
        Trip(tmp_path).go_to(4.0, 3.0, near=0.1)


def test_what_must_be_exact_fails_where_there_is_no_room(tmp_path: Path) -> None:
    trip = Trip(tmp_path)
    with pytest.raises(TaskFailed, match="did not get to"):
        trip.go_to(5.76, 3.0, near=1.0)
    assert not trip.base.is_touching


def test_a_move_of_a_robot_that_was_carried_starts_where_it_stands() -> None:
    board, goal, stood = Board(), Pose2D(1.0, 0.0), Pose2D(0.997, 0.001)
    assert nominal_pose(board, stood) == stood
    note_arrival(board, goal, stood, 1.0)
    assert nominal_pose(board, stood) == goal
    for elsewhere in (replace(stood, x=0.98), replace(stood, heading=0.1)):
        assert nominal_pose(board, elsewhere) == elsewhere


def test_a_move_after_one_that_did_not_get_to_its_place_starts_where_it_ended(
    tmp_path: Path,
) -> None:
    trip = Trip(tmp_path)
    trip.go_to(4.0, 3.0, near=30.0)
    stands = trip.base.odometry.x
    trip.stage.run(tasks_2003.drive_move_delta, 10.0)
    assert trip.base.odometry.x == pytest.approx(stands + 0.1, abs=0.005)


@given(
    st.floats(0.01, 2.0),
    st.floats(-math.pi, math.pi),
    st.floats(-math.pi, math.pi),
    st.sampled_from((0.05, 0.1)),
)
def test_from_anywhere_the_end_is_exact_and_rest(
    distance: float, bearing: float, heading: float, tick: float
) -> None:
    goal = Pose2D(distance * math.cos(bearing), distance * math.sin(bearing), heading)
    manner, pose = Manner(near=0.01, aim=0.003), Pose2D()
    arrival = Arrival(goal, 0.0)
    for step in range(round(40 / tick)):
        is_there = is_reached(pose, goal, manner)
        twist = straight_to(pose, goal, manner)
        if arrival.is_at(step * tick, pose, is_reached=is_there, is_open=True):
            twist = arrival.turn(step * tick, pose, 1.0)
            if twist == REST:
                break
        pose = along_arc(pose, twist.linear * tick, twist.angular * tick)
    assert _apart(pose, goal) <= 0.01
    assert abs(wrapped(pose.heading - heading)) <= 0.011


@given(st.floats(-math.pi, math.pi), st.sampled_from((0.02, 0.05, 0.1)))
def test_a_turn_does_not_go_beyond_its_heading(heading: float, tick: float) -> None:
    pose, side = Pose2D(), math.copysign(1.0, heading)
    while (twist := turn_to(pose, heading, 1.0, 0.01)) != REST:
        assert twist.angular * side > 0
        pose = along_arc(pose, 0.0, twist.angular * tick)
    assert abs(wrapped(heading - pose.heading)) <= 0.01


def test_a_base_that_gets_no_nearer_has_arrived_where_that_is_allowed() -> None:
    goal, stands = Pose2D(), Pose2D(0.06)
    for close, expected in ((0.1, [False, True]), (0.0, [False, False])):
        arrival = Arrival(goal, close)
        seen = [
            arrival.is_at(now, stands, is_reached=False, is_open=True) for now in (0.0, 1.0, 3.5)
        ]
        assert [seen[1], seen[2]] == expected
