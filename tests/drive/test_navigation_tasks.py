"""The verbs and behaviors of getting about, in the simulated world and through the real gate."""

import math
import re
from collections.abc import Awaitable, Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import trio

from hri.behavior.device_behaviors import BumperSwitch
from hri.behavior.drive_command import DriveCommand
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.ports import OutputPort
from hri.core import paths
from hri.core.errors import HriError
from hri.core.geometry import seen_from
from hri.core.signals import HeadPose, People, Person, Pose2D, Twist
from hri.drive import navigation_tasks
from hri.drive.behaviors import CommandGate
from hri.drive.following import Ending, Reason
from hri.drive.goal_behaviors import DeadReckoning, FollowTarget, ObstacleAvoidance
from hri.simulation.navigation_trips import BODY, SENSORS, Journey, devices
from hri.simulation.people.person import RADIUS
from hri.simulation.seeded_rooms import furnished
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext, TaskFailed
from tests.task.stage import Stage

ROOM = """
[robot]
start = [1, 2]
[person]
at = [4.5, 2.0]
[[wall]]
from = [0, 0]
to = [6, 0]
[[wall]]
from = [0, 4]
to = [6, 4]
[[box]]
center = [2.6, 2.0]
length = 0.4
width = 0.9
"""


class Set(Stage):
    """A robot with three range sensors in ROOM, whose gate drives."""

    def __init__(self, folder: Path, text: str = ROOM, robot: str = "three sensors") -> None:
        path = folder / "room.toml"
        path.write_text(text)
        super().__init__(*devices(path, 0, SENSORS.get(robot, {})))
        self.context.resources.dimensions = BODY
        self.world = self.context.resources.obtain("world", SimulatedWorld)
        gate, drive, bumper = CommandGate("gate"), DriveCommand("drive"), BumperSwitch("bumper")
        drive.velocity.sources.append(gate.velocity)
        gate.bump.sources.append(bumper.is_pressed)
        self.context.networks.start(Network("moving", 0.05, behaviors=[bumper, gate, drive]))
        self.gate = gate
        self.field_of_view = math.tau

    def see(self) -> None:
        """Let the board say where the person is, ten times a second, as a camera would."""
        now = self.clock.now()
        x, y = seen_from(self.world.base.pose, *self.world.person.place(now))
        if abs(math.atan2(y, x)) > self.field_of_view / 2:
            return
        who = Person("p1", HeadPose(now, 0, 0), distance=math.hypot(x, y), bearing=math.atan2(y, x))
        self.context.board.slot("people").set(People(now, (who,), "p1"), now)

    async def watching(self, job: Callable[[TaskContext], Awaitable[Any]], context: Any) -> Any:
        """Do something while the camera sees the person."""
        results = []

        async def look() -> None:
            while True:
                self.see()
                await self.clock.sleep(0.1)

        async with trio.open_nursery() as nursery:
            nursery.start_soon(look)
            results.append(await job(context))
            nursery.cancel_scope.cancel()
        return results[0]

    @property
    def place(self) -> tuple[float, float]:
        return self.world.base.pose.x, self.world.base.pose.y


def test_go_to_gets_there_around_a_thing_and_faces(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    goal = Pose2D(3.0, 0.6, 1.0)
    assert stage.run(_go, goal)
    assert stage.place == pytest.approx((4.0, 2.6), abs=0.2)
    assert stage.world.base.pose.heading == pytest.approx(1.0, abs=0.15)
    assert not stage.world.base.is_touching


def test_where_it_stands_it_is_at_once(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    assert stage.run(_go, Pose2D())
    assert stage.clock.now() < 0.5
    assert stage.place == (1.0, 2.0)


def test_a_goal_far_beyond_the_grid_is_gone_to_around_a_thing(tmp_path: Path) -> None:
    far = (
        ROOM.replace("[6, 0]", "[16, 0]").replace("[6, 4]", "[16, 4]").replace("4.5, 2.0", "1, 3.5")
    )
    stage = Set(tmp_path, f"{far}[[box]]\ncenter = [7.0, 2.0]\nlength = 0.8\nwidth = 1.6\n")
    assert stage.run(_go, Pose2D(13.0, 0.0))
    assert stage.place == pytest.approx((14.0, 2.0), abs=0.5)
    assert not stage.world.base.is_touching


def test_a_goal_inside_a_thing_is_given_up_in_time_with_a_sentence(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    with pytest.raises(TaskFailed, match="did not get to"):
        stage.run(navigation_tasks.go_to_task, 160.0, 0.0)
    assert stage.clock.now() < 4.0 / 0.3 + navigation_tasks.PATIENCE_S
    assert "bumper.pressed" not in stage.names()
    assert not stage.world.base.is_touching


DOOR = """
[robot]
start = [1, 2]
[person]
at = [4.8, 3.0]
[[wall]]
from = [6, 0.6]
to = [6, 3.4]
[[wall]]
from = [0, 0.6]
to = [6, 0.6]
[[wall]]
from = [0, 3.4]
to = [6, 3.4]
[[wall]]
from = [0, 0.6]
to = [0, 3.4]
[[wall]]
from = [2.5, 0.6]
to = [2.5, 1.775]
[[wall]]
from = [2.5, 2.225]
to = [2.5, 3.4]
"""


def test_who_cannot_pass_a_door_says_how_wide_it_is_and_must_be(tmp_path: Path) -> None:
    stage = Set(tmp_path, DOOR)
    with pytest.raises(TaskFailed, match=r"0\.61 m - widen it, or") as why:
        stage.run(navigation_tasks.go_to_task, 300.0, 0.0)
    width = float(re.search(r"about ([\d.]+) m", str(why.value))[1])
    assert width == pytest.approx(0.45, abs=0.1)
    assert not stage.world.base.is_touching


def test_without_range_sensors_it_goes_slowly_until_its_bumper_ends_the_motion(
    tmp_path: Path,
) -> None:
    stage = Set(tmp_path, robot="no sensors")
    fastest = [0.0]

    async def watched(context: TaskContext) -> bool:
        async with trio.open_nursery() as nursery:

            async def watch() -> None:
                while True:
                    fastest.append(stage.world.base.velocity.linear)
                    await context.clock.sleep(0.05)

            nursery.start_soon(watch)
            is_there = await navigation_tasks.go_to(context, Pose2D(3.0, 0.0))
            nursery.cancel_scope.cancel()
        return is_there

    assert stage.run(watched) is False
    assert max(fastest) == pytest.approx(0.15, abs=0.01)
    assert stage.world.base.is_touching
    assert stage.clock.now() < 15.0


async def _go(context: TaskContext, goal: Pose2D) -> bool:
    return await navigation_tasks.go_to(context, goal, faces=True)


def test_a_goal_that_is_no_place_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="finite"):
        Set(tmp_path).run(_go, Pose2D(math.nan, 0.0))


def test_going_ends_when_it_is_cancelled(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def cancelled(context: TaskContext) -> None:
        with context.clock.move_on_after(2.0):
            await navigation_tasks.go_to(context, Pose2D(3.0, 0.0))
        await context.clock.sleep(1.0)

    stage.run(cancelled)
    assert stage.world.base.velocity.linear == 0.0
    assert 0.2 < math.dist(stage.place, (1.0, 2.0)) < 1.0


def test_a_halt_ends_going(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def halted(context: TaskContext) -> bool:
        context.clock.call_at(2.0, stage.gate.halt)
        return await navigation_tasks.go_to(context, Pose2D(3.0, 0.0))

    assert stage.run(halted) is False
    assert stage.clock.now() < 5.0


def test_another_motion_takes_the_drive(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def both(context: TaskContext) -> list[bool]:
        results = []

        async def far() -> None:
            results.append(await navigation_tasks.go_to(context, Pose2D(3.0, 0.6)))

        async with trio.open_nursery() as nursery:
            nursery.start_soon(far)
            await context.clock.sleep(2.0)
            results.append(await navigation_tasks.go_to(context, Pose2D(0.2, 0.0)))
        return results

    assert stage.run(both) == [False, True]


def test_go_by_uses_the_frame_of_the_robot_and_the_units_of_tasks(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    stage.run(navigation_tasks.go_by, 60.0, -60.0)
    assert stage.place == pytest.approx((1.6, 1.4), abs=0.15)
    assert stage.world.base.pose.heading == pytest.approx(-math.pi / 4, abs=0.15)


@pytest.mark.proves("R06", "B25")
def test_come_here_stops_before_the_person_and_faces(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    assert stage.run(lambda context: stage.watching(navigation_tasks.come_here, context))
    assert math.dist(stage.place, (4.5, 2.0)) == pytest.approx(1.2, abs=0.25)
    x, y = seen_from(stage.world.base.pose, 4.5, 2.0)
    assert math.atan2(y, x) == pytest.approx(0.0, abs=0.15)


def test_who_asks_it_to_come_too_near_gets_it_as_near_as_it_may(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    come = partial(navigation_tasks.come_here, distance=0.4)
    assert stage.run(lambda context: stage.watching(come, context))
    assert 1.0 < math.dist(stage.place, (4.5, 2.0)) < 1.4


def test_come_here_gives_up_where_nobody_is_seen_all_around(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    assert stage.run(navigation_tasks.come_here) is False
    assert stage.place == pytest.approx((1.0, 2.0), abs=0.05)
    assert abs(stage.world.base.pose.heading) > math.radians(340)


def test_who_calls_from_behind_is_looked_for(tmp_path: Path) -> None:
    stage = Set(tmp_path, ROOM.replace("start = [1, 2]", "start = [1, 1]\nheading = 3.14"))
    stage.field_of_view = math.radians(60)
    assert stage.run(lambda context: stage.watching(navigation_tasks.come_here, context))
    assert math.dist(stage.place, (4.5, 2.0)) == pytest.approx(1.2, abs=0.25)


@pytest.mark.proves("R06", "B25")
def test_follow_keeps_up_with_somebody_who_walks(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    stage.world.person.go(4.5, 0.8, 4.0)
    followed = stage.run(
        lambda context: stage.watching(
            lambda context: navigation_tasks.follow(context, seconds=30.0), context
        )
    )
    assert followed
    assert math.dist(stage.place, (4.5, 0.8)) == pytest.approx(1.2, abs=0.35)
    assert "target.found" in stage.names()


def test_follow_tells_when_it_has_lost_somebody(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def lost(context: TaskContext) -> bool:
        stage.see()
        return await navigation_tasks.follow(context)

    assert stage.run(lost) is False
    assert [e.properties["given_up"] for e in stage.events if e.name == "target.lost"] == [
        False,
        True,
    ]


def test_wandering_touches_nothing(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    stage.run(lambda context: navigation_tasks.wander(context, 15.0))
    assert stage.world.base.way > 1.5
    assert "bumper.pressed" not in stage.names()
    assert not stage.world.base.is_touching


@pytest.mark.proves("B26")
@pytest.mark.parametrize("robot", SENSORS)
def test_the_same_behavior_drives_two_robots(robot: str) -> None:
    trip = Journey(furnished(2), "full", robot).run()
    assert trip.is_clean


def test_who_is_seen_is_not_driven_up_to() -> None:
    trip = Journey(furnished(3), "full", sees=True).run()
    assert trip.is_clean
    assert trip.person_gap_approached > 0.4


def test_the_gate_brakes_for_somebody_who_walks_up_whatever_it_is_asked(tmp_path: Path) -> None:
    stage = Set(tmp_path, "[robot]\nstart = [1, 2]\n[person]\nat = [4.0, 2.0]")
    asks = OutputPort[Twist]()
    asks.value = Twist(0.3)
    stage.gate.twist.sources.append(asks)
    base, person = stage.world.base, stage.world.person
    speeds = []

    async def touch(context: TaskContext) -> None:
        person.go(1.0, 2.0, stage.clock.now())
        while stage.world.distance_to(person, stage.clock.now()) > 0.2 + RADIUS:
            speeds.append(base.velocity.linear)
            await stage.clock.sleep(0.05)

    stage.run(touch)
    assert max(speeds) > 0.25
    assert base.velocity.linear == 0.0


def test_after_somebody_has_run_into_it_it_goes_on() -> None:
    trip = Journey(furnished(5), "full", heedful=False).run()
    assert trip.people_hit + trip.people_met
    assert trip.is_there


def test_without_avoidance_it_stands_before_things_and_so_does_stop_crash() -> None:
    straight = Journey(furnished(2), "none").run(20.0)
    assert not straight.is_there
    assert not straight.hits
    standing = Journey(furnished(2), "StopCrash only").run(20.0)
    assert not standing.is_there
    assert not standing.hits


def test_a_run_repeats_to_the_last_bit() -> None:
    one, other = (Journey(furnished(2), "full", keeps_track=True).run(8.0).track for _ in range(2))
    assert one == other


def test_following_networks_load() -> None:
    for name in ("go", "go_straight", "go_stop_crash", "follow", "roam"):
        load_network(paths.find("config/networks", f"{name}.xml")).check()


def test_dead_reckoning_sends_how_sure_it_is(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    reckoning = DeadReckoning("reckoning")
    stage.context.networks.start(Network("reckoning", 0.05, behaviors=[reckoning]))
    stage.run(_go, Pose2D(0.8, 0.0))
    covariance = reckoning.covariance.value
    assert covariance is not None
    assert len(covariance) == 9
    assert 0.0 < (reckoning.deviation.value or 0.0) < 0.1


@pytest.mark.proves("B25")
def test_a_given_place_is_followed_like_a_person(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    follow = FollowTarget("follow")
    follow.start(stage.context)
    follow.target.sources.append(OutputPort(Pose2D(0.0, 3.0)))
    follow.compute(0.0, 0.0)
    goal = follow.goal.value
    assert goal is not None
    assert (goal.x, goal.y) == pytest.approx((0.0, 1.8), abs=1e-6)
    assert goal.heading == pytest.approx(math.pi / 2)


def test_where_somebody_was_long_ago_is_in_nobodys_way(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def later(context: TaskContext) -> bool:
        who = Person("p1", HeadPose(0.0, 0, 0), distance=0.6, bearing=0.0)
        context.board.slot("people").set(People(0.0, (who,), "p1"), 0.0)
        await context.clock.sleep(2.0)
        return await navigation_tasks.go_to(context, Pose2D(0.6, 0.8))

    assert stage.run(later)


@pytest.mark.parametrize(
    "verb",
    [
        partial(navigation_tasks.follow, distance=math.nan),
        partial(navigation_tasks.follow, seconds=math.nan),
        partial(navigation_tasks.come_here, distance=math.nan),
        partial(navigation_tasks.wander, seconds=math.nan),
    ],
)
def test_what_is_no_number_moves_nothing(tmp_path: Path, verb: Callable[..., Any]) -> None:
    stage = Set(tmp_path)
    with pytest.raises(ValueError, match="give numbers"):
        stage.run(verb)
    assert stage.place == (1.0, 2.0)


def test_a_task_refuses_what_is_no_number_as_the_mistake_of_its_caller(tmp_path: Path) -> None:
    with pytest.raises(HriError, match="finite"):
        Set(tmp_path).run(navigation_tasks.go_to_task, math.nan, 0.0)


def test_a_goal_of_the_network_that_is_no_place_is_refused(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    avoidance = ObstacleAvoidance("avoidance")
    avoidance.start(stage.context)
    avoidance.goal.sources.append(OutputPort(Pose2D(math.nan, 0.0)))
    with pytest.raises(HriError, match="finite"):
        avoidance.compute(0.0, 0.0)
    assert avoidance.velocity.value is None


def test_at_its_goal_it_rests_after_a_touch_before_it_turns_on(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    avoidance = ObstacleAvoidance("avoidance", faces=True)
    avoidance.start(stage.context)
    avoidance.goal.sources.append(OutputPort(Pose2D(0.0, 0.0, 1.0)))
    avoidance.bump.sources.append(press := OutputPort(False))

    def turning(now: float) -> float:
        avoidance.compute(now, 0.05)
        twist = avoidance.velocity.value
        assert twist is not None
        return twist.angular

    assert turning(0.0) > 0
    press.send(True)
    assert turning(0.05) == 0.0
    press.send(False)
    assert turning(0.1) == 0.0, "a gate hears only who has rested"
    assert turning(0.5) > 0


def _end(stage: Set, **arguments: Any) -> Ending:
    """How following somebody whom the camera sees ended."""
    job = partial(navigation_tasks.follow_person, **arguments)
    ending: Ending = stage.run(lambda context: stage.watching(job, context))
    left = next(event for event in stage.events if event.name == "target.left")
    assert left.properties["reason"] == ending.reason.value
    assert left.properties["text"] == str(ending)
    return ending


def test_following_says_who_was_followed_until_the_time_was_over(tmp_path: Path) -> None:
    ending = _end(Set(tmp_path), seconds=25.0)
    assert ending
    assert str(ending) == "followed p1, in sight at the end: the 25 s are over"


def test_following_says_that_nobody_was_seen(tmp_path: Path) -> None:
    ending = Set(tmp_path).run(navigation_tasks.follow_person, "", 0.0, 3.0)
    assert not ending
    assert str(ending).startswith("saw nobody for 3 s")


def test_following_says_whom_it_lost(tmp_path: Path) -> None:
    stage = Set(tmp_path)

    async def lost(context: TaskContext) -> Ending:
        stage.see()
        return await navigation_tasks.follow_person(context)

    ending = stage.run(lost)
    assert (ending.reason, ending.person) == (Reason.LOST, "p1")
    assert "lost sight of p1" in str(ending)


@pytest.mark.slow
def test_following_says_that_the_way_is_blocked(tmp_path: Path) -> None:
    walls = "".join(f"[[wall]]\nfrom = [{x}, 0]\nto = [{x}, 4]\n" for x in (0, 3.2))
    ending = _end(Set(tmp_path, ROOM + walls))
    assert (ending.reason, ending.person) == (Reason.BLOCKED, "p1")
    assert "clear the way" in str(ending)


def test_following_says_that_it_was_stopped(tmp_path: Path) -> None:
    stage = Set(tmp_path)
    stage.clock.call_at(3.0, stage.gate.halt)
    ending = _end(stage)
    assert str(ending) == "followed p1 until a stop ended it"
