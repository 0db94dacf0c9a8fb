import math
from pathlib import Path

import pytest

from hri.behavior.network_file import load_network
from hri.behavior.ports import OutputPort
from hri.core.signals import RangeReading, Twist
from hri.drive.behaviors import COMMAND
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.tasks import move
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.task.context import TaskContext
from tests.drive.course import TICK, Course
from tests.task.stage import Stage


def ask(course: Course, twist: Twist, seconds: float) -> None:
    """Write a command to the board at 10 Hz, the way a task does."""
    slot = course.context.board.slot(COMMAND)
    for _ in range(round(seconds / 0.1)):
        slot.set(twist, course.clock.now())
        course.tick_for(0.1)


def test_the_base_follows_commands_and_stops_when_they_end() -> None:
    course = Course()
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity.linear == pytest.approx(0.3)
    assert course.gate.is_moving
    course.tick_for(0.4)
    assert course.base.velocity.linear == pytest.approx(0.3), "0.5 s are not over yet"
    course.tick_for(1.0)
    assert course.base.velocity == Twist()
    assert course.reasons() == ["timeout"]
    assert not course.gate.is_moving


def test_a_motion_is_announced_once_and_its_end_too() -> None:
    course = Course()
    ask(course, Twist(0.3, 0.1), 2.0)
    ask(course, Twist(), 1.0)
    assert [(e.name, e.properties) for e in course.events] == [
        ("drive.commanded", {"linear": 0.3, "angular": 0.1}),
        ("drive.stopped", {"reason": "done"}),
    ]


def test_a_command_that_keeps_changing_is_announced_twice_a_second() -> None:
    course = Course()
    for tick in range(100):
        course.asks.value = Twist(0.2 + 0.2 * math.sin(tick), 0.0)
        course.tick_for(TICK)
    assert 2 <= len(course.events) <= 5


@pytest.mark.parametrize("wall", [0.5, 1.0, 3.0])
def test_it_never_drives_into_a_wall(wall: float) -> None:
    course = Course(wall=wall)
    ask(course, Twist(0.4), wall / 0.4 + 4.0)
    room = wall - course.base.pose.x - 0.2
    assert 0.2 < room < 0.35
    assert not course.base.is_touching
    assert course.reasons() == (["obstacle"] if course.events else [])


def test_at_a_wall_it_can_still_turn_away() -> None:
    course = Course(wall=0.4)
    ask(course, Twist(0.3, 0.8), 1.0)
    assert course.base.pose.heading > 0.3
    assert course.base.pose.x == pytest.approx(0.0)


def test_somebody_who_steps_in_front_is_not_hit() -> None:
    course = Course()
    ask(course, Twist(0.3), 3.0)
    course.wall = course.base.pose.x + 0.2 + 0.4
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity == Twist()
    assert not course.base.is_touching
    course.wall = math.inf
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity.linear == pytest.approx(0.3)


def test_a_sensor_that_falls_silent_is_not_trusted() -> None:
    course = Course()
    ask(course, Twist(0.3), 1.0)
    silent = RangeReading("front", math.inf, course.clock.now())
    for _ in range(100):
        course.gate.range.sources[0].value = silent
        course.context.board.slot(COMMAND).set(Twist(0.3), course.clock.now())
        course.gate.compute(course.clock.now(), TICK)
        course.clock.advance(TICK)
    assert not course.gate.is_moving


def test_a_sensor_that_says_nothing_any_more_is_an_obstacle() -> None:
    course = Course()
    ask(course, Twist(0.3), 2.0)
    course.sensor_speaks = False
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity == Twist()
    assert course.reasons() == ["obstacle"]
    ask(course, Twist(-0.1), 1.0)
    assert course.base.velocity.linear == pytest.approx(-0.1), "it may still back off"
    course.sensor_speaks = True
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity.linear == pytest.approx(0.3)


def test_a_sensor_that_has_never_said_anything_is_an_obstacle() -> None:
    course = Course()
    course.sensor_speaks = False
    ask(course, Twist(0.3), 2.0)
    assert course.base.pose.x == 0.0


def test_one_sensor_that_speaks_does_not_stand_in_for_another() -> None:
    course = Course()
    course.gate.range.sources.append(OutputPort())
    ask(course, Twist(0.3), 2.0)
    assert course.base.pose.x == 0.0


def test_a_sensor_may_be_slower_than_the_gate() -> None:
    course = Course(wall=2.0)
    slot = course.context.board.slot(COMMAND)
    for tick in range(500):
        course.sensor_speaks = tick % 20 == 0
        slot.set(Twist(0.3), course.clock.now())
        course.tick_for(TICK)
        if tick == 150:
            assert course.base.velocity.linear == pytest.approx(0.3)
    assert course.base.velocity == Twist()
    assert not course.base.is_touching


def test_a_reading_put_in_from_outside_counts_for_its_tick_alone() -> None:
    course = Course()
    ask(course, Twist(0.3), 2.0)
    injected = OutputPort(RangeReading("by hand", 0.0, course.clock.now()))
    course.gate.range.sources.insert(0, injected)
    course.tick_for(TICK)
    (base,) = course.resources.opened(BaseBus)
    assert base.state.velocity.linear < 0.3
    course.gate.range.sources.remove(injected)
    ask(course, Twist(0.3), 1.0)
    assert course.base.velocity.linear == pytest.approx(0.3)


def test_a_switch_that_says_nothing_counts_as_pressed() -> None:
    course = Course()
    course.asks.value = Twist(0.3)
    course.tick_for(2.0)
    course.switch_speaks = False
    course.tick_for(3.0)
    assert course.base.velocity == Twist()
    assert course.reasons() == ["bump"]
    course.asks.value = None
    course.tick_for(TICK)
    course.asks.value = Twist(-0.1)
    course.tick_for(1.0)
    assert course.base.velocity.linear == pytest.approx(-0.1)


GATED = """<BehaviorNetwork invocation_interval="0.02">
  <Behavior id="front" type="Hri.RangeSensor">
    <Parameter name="sensor_id" value="range_front"/>
  </Behavior>
  <Behavior id="gate" type="Hri.CommandGate"/>
  <Behavior id="drive" type="Hri.DriveSystem"/>
  <Link from="front.reading" to="gate.range"/>
  <Link from="gate.velocity" to="drive.velocity"/>
</BehaviorNetwork>
"""


class LooseSensor(RangeSensor):
    """Sees nothing in range until its cable comes off, after a second."""

    def read(self, now: float) -> RangeReading:
        if now > 1.0:
            raise OSError("bus error")
        return RangeReading(self.id, math.inf, now)


def test_a_network_whose_sensor_fails_drives_no_further(tmp_path: Path) -> None:
    (tmp_path / "gated.xml").write_text(GATED)
    stage = Stage(
        Description("world", "Hri.SimulatedWorld", {"voice": "mute"}),
        Description("mute", "Hri.EspeakVoice"),
        Description("drive", "Hri.SimulatedDrive"),
        Description("odometry", "Hri.SimulatedOdometry"),
    )
    resources = stage.context.resources
    sensor = LooseSensor(Description("range_front", "Test.LooseSensor"), resources)
    resources.substitute("range_front", sensor)

    async def drive(context: TaskContext) -> float:
        context.networks.start(load_network(tmp_path / "gated.xml"))
        return await move(context, 1.5)

    gone = stage.run(drive)
    # A second of driving, half a second of patience, and the way to come to rest.
    assert 0.1 < gone < 0.5


def test_a_bump_ends_the_motion() -> None:
    course = Course(wall=1.0, clearance=0.0)
    course.gate.range.sources.clear()
    course.asks.value = Twist(0.3)
    course.tick_for(6.0)
    assert course.reasons() == ["bump"]
    assert course.base.velocity == Twist()
    course.asks.value = Twist(-0.1)
    course.tick_for(1.0)
    assert course.base.velocity == Twist(), "the network has not let go yet"
    course.asks.value = None
    course.tick_for(TICK)
    course.asks.value = Twist(-0.1)
    course.tick_for(2.0)
    assert course.base.pose.x < 0.65


def test_halt_stops_at_once_and_for_good() -> None:
    course = Course()
    course.asks.value = Twist(0.3)
    course.tick_for(2.0)
    before = course.base.pose.x
    course.gate.halt()
    course.tick_for(3.0)
    assert course.base.velocity == Twist()
    # The simulated base needs 0.09 m from 0.3 m/s, and 0.1 s until it slows down evenly.
    assert course.base.pose.x - before < 0.12
    assert course.reasons() == ["halt"]


def test_bad_commands_stop_the_base() -> None:
    course = Course()
    ask(course, Twist(0.3), 1.0)
    ask(course, Twist(math.nan, 0.1), 2.0)
    assert course.base.velocity == Twist()


def test_the_speed_follows_the_factor() -> None:
    course = Course()
    course.hurries.value = 0.6
    ask(course, Twist(0.3), 2.0)
    assert course.base.velocity.linear == pytest.approx(0.18)
