"""A Create 2 of a configuration, in the simulated world: the whole chain in fake time."""

from __future__ import annotations

import math
from typing import Any

import pytest

from hri.behavior.behavior import Context
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError, NotAvailable
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Twist
from hri.drive.bases.protocol import Note
from hri.drive.supervisor.announcement import announced
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor.base_devices import (
    BaseBattery,
    BaseBumper,
    BaseCliffSensor,
    BaseOdometry,
    BaseRangeSensor,
)
from hri.drive.supervisor.base_drive import BaseDrive
from hri.hal.drive import PATIENCE
from hri.hal.pending import Interrupted
from hri.hal.rank import Outranked
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.bases.body import RoomBody
from hri.simulation.bases.emulated_base import ArduinoLine, Create2Line
from hri.simulation.world import SimulatedWorld

GO = Twist(0.3)


class Robot:
    """All that a program holds of its base, and what it cannot see."""

    def __init__(self, manager: ResourceManager) -> None:
        self.clock = manager.clock
        self.bus = manager.obtain("base", BaseBus)
        self.drive = manager.obtain("drive", BaseDrive)
        self.odometry = manager.obtain("odometry", BaseOdometry)
        self.world = manager.obtain("world", SimulatedWorld)
        line = manager.obtain("base_line", Create2Line)
        self.port, self.base = line.port, line.port.line.emulator
        self.events: list[Event] = []
        events = EventBus(self.clock)
        events.subscribe("*", self.events.append)
        announced(self.bus, Context(self.clock, events, manager))

    @property
    def body(self) -> RoomBody:
        return self.base.body

    def unlatched(self) -> Robot:
        self.bus.unlatch()
        self.clock.advance(0.5)
        assert not self.bus.state.is_latched
        return self

    def go(self, seconds: float, twist: Twist = GO) -> None:
        """As a program does: a velocity every 20 ms."""
        for _ in range(round(seconds / 0.02)):
            self.drive.set_velocity(twist, self.clock.now())
            self.clock.advance(0.02)

    def told(self) -> list[tuple[str, Any]]:
        return [(event.name, event.properties.get("reason")) for event in self.events]


@pytest.fixture
def robot(manager) -> Robot:
    return Robot(manager)


def test_who_opens_its_drive_may_drive_a_base_that_is_well(manager) -> None:
    bus = manager.obtain("base", BaseBus)
    assert bus.is_latched
    assert "switched on" in bus.explain()
    robot = Robot(manager)
    robot.go(1.2)
    assert robot.world.base.velocity.linear == pytest.approx(0.3, abs=0.002)


def test_a_base_whose_wheel_hangs_in_the_air_is_not_released_by_opening_its_drive(manager) -> None:
    manager.obtain("base", BaseBus)
    line = manager.obtain("base_line", Create2Line)
    line.port.line.emulator.body.hanging.add("left")
    manager.clock.advance(0.5)
    robot = Robot(manager)
    robot.body.hanging.clear()
    robot.go(1.0)
    assert robot.world.base.velocity == Twist()
    assert "left wheel hangs in the air" in robot.bus.explain()


def test_a_stop_outlasts_the_closing_of_the_base(manager) -> None:
    drive = manager.obtain("drive", BaseDrive)
    drive.stop_latched("you said stop")
    manager.release(drive)
    assert not manager.opened(BaseBus)
    robot = Robot(manager)
    robot.go(1.0)
    assert robot.world.base.velocity == Twist()
    assert robot.bus.explain() == "I stopped because you said stop"
    robot.unlatched().go(1.2)
    assert robot.world.base.velocity.linear == pytest.approx(0.3, abs=0.002)


@pytest.mark.parametrize("distance", [0.5, -0.3])
def test_a_motion_ends_where_it_should(robot, distance) -> None:
    robot.unlatched()
    robot.drive.move_delta(distance, 0.3, 0.4).wait(20)
    assert robot.odometry.pose(robot.clock.now()).x == pytest.approx(distance, abs=0.003)
    assert robot.world.base.odometry.x == pytest.approx(distance, abs=0.003)


@pytest.mark.parametrize("degrees", [190, -45])
def test_a_turn_ends_where_it_should(robot, degrees) -> None:
    robot.unlatched()
    robot.drive.turn_delta(math.radians(degrees), 1.0, 1.0).wait(20)
    turned = robot.bus.report().rolled.angular
    assert math.degrees(turned) == pytest.approx(degrees, abs=0.5)


def test_a_motion_of_a_latched_base_says_why_it_does_not_begin(robot) -> None:
    robot.clock.advance(0.5)
    robot.bus.stop_latched("you said stop")
    pending = robot.drive.move_delta(0.5, 0.3, 0.4)
    with pytest.raises(HriError, match="I stopped because you said stop - unlatch"):
        pending.result()


def test_an_emergency_stop_ends_a_motion_and_stays(robot) -> None:
    robot.unlatched()
    pending = robot.drive.move_delta(1.0, 0.3, 0.4)
    robot.clock.advance(1.0)
    robot.bus.stop_latched("you pressed the key")
    robot.clock.advance(0.3)
    assert robot.world.base.velocity == Twist()
    with pytest.raises(HriError, match="you pressed the key"):
        pending.result()
    robot.go(1.0)
    assert robot.world.base.velocity == Twist()
    assert ("drive.stopped", "e-stop") in robot.told()


def test_a_halt_of_a_base_that_was_stopped_ends_well(robot) -> None:
    robot.unlatched().go(1.0)
    robot.bus.stop_latched("you said stop")
    robot.drive.halt().wait(2)
    assert robot.world.base.velocity == Twist()


def test_a_release_that_waits_is_void_when_a_stop_comes_after_it(robot) -> None:
    robot.bus.unlatch()
    robot.bus.stop_latched("you said stop")
    robot.clock.advance(6.0)
    assert robot.bus.state.is_latched


def test_a_stop_before_the_supervisor_has_answered_to_a_release_is_not_lost(
    robot, monkeypatch
) -> None:
    robot.unlatched().bus.stop_latched("you pressed the key")
    with monkeypatch.context() as late:
        late.setattr(robot.bus._connection, "_hear", lambda state: None)
        robot.bus.unlatch()
        robot.bus.stop_latched("you pressed the key")
    robot.clock.advance(0.5)
    assert robot.bus.state.is_latched


def test_a_motion_goes_no_faster_than_is_allowed_whoever_comes_near(robot) -> None:
    robot.unlatched()
    robot.bus.hear_person(5.0)
    pending = robot.drive.move_delta(0.6, 0.5, 0.5)
    for _ in range(50):
        robot.bus.hear_person(5.0)
        robot.clock.advance(0.02)
        assert robot.bus.state.velocity.linear <= 0.31
    pending.wait(20)
    assert robot.odometry.pose(0.0).x == pytest.approx(0.6, abs=0.003)


def test_an_emergency_stop_is_said_until_it_is_heard(robot, monkeypatch) -> None:
    robot.unlatched().go(1.0)
    say = robot.bus._connection.say
    monkeypatch.setattr(robot.bus._connection, "say", lambda order: None)  # the line is full
    robot.bus.stop_latched("you said stop " + "and so on " * 50)
    robot.go(0.1)
    monkeypatch.setattr(robot.bus._connection, "say", say)
    robot.go(0.3)
    assert robot.bus.state.is_latched
    assert "you said stop" in robot.bus.explain()
    assert robot.world.base.velocity == Twist()
    robot.unlatched().go(1.2)
    assert robot.world.base.velocity.linear == pytest.approx(0.3, abs=0.002)


def test_a_velocity_and_a_motion_replace_each_other(robot) -> None:
    robot.unlatched().go(1.0, Twist(0.0, 0.5))
    pending = robot.drive.move_delta(0.3, 0.3, 0.4)
    robot.clock.advance(0.1)
    assert robot.bus.state.velocity.angular < 0.45  # it lets go of the turn at once
    robot.go(0.1, Twist(0.0, -0.5))
    with pytest.raises(Interrupted):
        pending.result()
    assert robot.bus.state.level == "tasks"


def test_teleoperation_goes_before_the_network_and_lets_go_by_itself(robot) -> None:
    robot.unlatched()
    for _ in range(50):
        robot.bus.teleop(Twist(-0.1))
        with pytest.raises(Outranked, match=r"someone steers it \(rank teleop\)"):
            robot.go(0.02)
        robot.clock.advance(0.02)
    assert robot.world.base.velocity.linear < 0
    robot.clock.advance(PATIENCE)
    robot.go(2.0)
    assert robot.world.base.velocity.linear == pytest.approx(0.3, abs=0.002)


def test_with_nobody_near_it_is_allowed_more(robot) -> None:
    robot.unlatched()
    assert robot.bus.state.allowed.forward == pytest.approx(0.3)
    robot.bus.hear_person(4.0)
    robot.clock.advance(0.1)
    assert robot.bus.state.allowed.forward == pytest.approx(0.5)
    robot.clock.advance(1.2)
    assert robot.bus.state.allowed.forward == pytest.approx(0.3)


def test_a_wall_ahead_slows_it_down_before_it_touches(robot) -> None:
    robot.unlatched()
    robot.body.near |= {"center_left": 0.6}
    for _ in range(150):
        robot.body.near["center_left"] = 0.6 - robot.world.base.travelled
        robot.go(0.02)
    assert robot.world.base.velocity == Twist()
    assert robot.body.near["center_left"] > 0.08
    assert ("drive.stopped", "obstacle") in robot.told()


def test_the_sensors_tell_what_the_base_feels(robot, manager) -> None:
    robot.unlatched()
    bumper, cliff = (
        manager.obtain("bumper", BaseBumper),
        manager.obtain("cliff_left", BaseCliffSensor),
    )
    distance = manager.obtain("range_front", BaseRangeSensor)
    battery = manager.obtain("battery", BaseBattery)
    now = robot.clock.now()
    assert not bumper.is_pressed(now)
    assert not cliff.is_cliff(now)
    assert distance.read(now).distance == math.inf
    assert battery.level(now) == pytest.approx(1.0, abs=0.01)
    assert 12 < battery.voltage(now) < 17
    robot.body.pressed.add("right")
    robot.body.over_edge.add("left")
    robot.body.near["center_left"] = 0.2
    robot.clock.advance(0.1)
    now = robot.clock.now()
    assert bumper.is_pressed(now)
    assert cliff.is_cliff(now)
    assert distance.read(now).distance == pytest.approx(0.2, abs=0.01)
    assert now - distance.read(now).time < 0.1


def test_sensors_of_a_base_that_is_gone_count_as_hazards(robot, manager) -> None:
    robot.unlatched()
    robot.port.is_plugged = False
    robot.clock.advance(1.0)
    now = robot.clock.now()
    assert manager.obtain("bumper", BaseBumper).is_pressed(now)
    assert manager.obtain("cliff_left", BaseCliffSensor).is_cliff(now)
    assert now - manager.obtain("range_front", BaseRangeSensor).read(now).time > 0.5
    assert ("drive.stopped", "lost port") in robot.told()


def test_a_battery_whose_base_is_gone_or_talks_nonsense_is_not_known(robot, manager) -> None:
    battery, clock = manager.obtain("battery", BaseBattery), robot.clock
    robot.clock.advance(1.0)
    assert battery.level(clock.now()) == pytest.approx(1.0, abs=0.01)
    robot.base.overrides[25] = 65_529
    clock.advance(0.1)
    assert battery.level(clock.now()) is None
    assert 12 < battery.voltage(clock.now()) < 17
    assert robot.bus.state.faults == ("my battery says 65529 of 2696 mAh, which cannot be",)
    robot.base.overrides.clear()
    clock.advance(0.1)
    assert battery.level(clock.now()) == pytest.approx(1.0, abs=0.01)
    robot.port.is_plugged = False
    clock.advance(1.0)
    assert battery.level(clock.now()) is None
    assert battery.voltage(clock.now()) is None
    robot.port.is_plugged = True
    clock.advance(2.0)
    assert battery.level(clock.now()) == pytest.approx(1.0, abs=0.01)


def test_it_sings_lights_its_lamps_and_goes_to_its_dock_by_name(robot) -> None:
    robot.unlatched()
    robot.bus.song([Note(60, 0.25), Note(64, 0.5)])
    robot.bus.leds(1.0, is_dock_lit=True)
    assert robot.base.played == [0]
    assert robot.base.songs[0] == bytes([60, 16, 64, 32])
    assert robot.base.leds == (4, 255, 255)
    with pytest.raises(HriError, match="pitch of 3"):
        robot.bus.song([Note(3, 0.25)])
    robot.bus.dock()
    robot.clock.advance(0.5)
    assert robot.base.is_rolling
    assert ("drive.stopped", "docking") in robot.told()
    robot.bus.stop_latched("you said stop")
    robot.clock.advance(0.1)
    assert not robot.base.is_rolling
    with pytest.raises(HriError, match="unlatch the base first"):
        robot.bus.dock()


def test_a_button_of_the_base_is_an_emergency_stop(robot) -> None:
    robot.unlatched().go(1.0)
    robot.body.held.add("spot")
    robot.go(0.5)
    assert robot.world.base.velocity == Twist()
    assert robot.told() == [("drive.commanded", None), ("drive.stopped", "button")]
    robot.bus.unlatch()
    robot.go(0.5)
    assert robot.bus.state.is_latched
    robot.body.held.clear()
    robot.go(0.1)
    robot.unlatched().go(1.2)
    assert robot.world.base.velocity.linear == pytest.approx(0.3, abs=0.002)


def test_every_stop_is_an_event_with_a_sentence(robot) -> None:
    robot.unlatched().go(1.0)
    robot.body.over_edge.add("left")
    robot.go(0.5)
    commanded, event = robot.events
    assert commanded.name == "drive.commanded"
    assert event.name == "drive.stopped"
    assert event.properties == {
        "reason": "cliff",
        "words": "I stopped because my left cliff sensor sees an edge",
    }
    assert robot.bus.explain() == event.properties["words"]


def test_the_stops_of_a_base_that_was_opened_again_are_events_too(manager) -> None:
    events = EventBus(manager.clock)
    reasons: list[str] = []
    events.subscribe("drive.stopped", lambda event: reasons.append(event.properties["reason"]))
    context = Context(manager.clock, events, manager)
    for _ in range(2):
        bus = manager.obtain("base", BaseBus)
        announcer = announced(bus, context)
        bus.unlatch()
        manager.clock.advance(0.1)
        bus.stop_latched("you said stop")
        manager.clock.advance(0.1)
        announcer.stop()
        manager.release(bus)
    assert reasons == ["e-stop", "e-stop"]


def test_what_is_refused_is_an_event_too(robot) -> None:
    robot.unlatched().go(0.2, Twist(math.nan))
    assert robot.told().count(("drive.refused", None)) == 1
    assert robot.world.base.velocity == Twist()


def test_two_runs_are_equal_bit_by_bit(manager) -> None:
    def run() -> list[Any]:
        clock = FakeClock()
        resources = ResourceManager(manager.descriptions.values(), clock)
        robot = Robot(resources).unlatched()
        robot.go(1.0, Twist(0.2, 0.3))
        robot.body.pressed.add("left")
        robot.go(0.5)
        robot.body.pressed.clear()
        robot.go(2.0)
        result = [robot.world.base.pose, robot.odometry.pose(clock.now()), robot.told()]
        resources.close()
        return result

    assert run() == run()


def test_closing_stops_the_base(robot, manager) -> None:
    robot.unlatched().go(1.0)
    manager.close()
    assert not robot.base.is_rolling


def test_a_serial_port_is_not_opened_in_fake_time(clock) -> None:
    manager = ResourceManager([Description("base", "Hri.Create2", {"port": "/dev/null"})], clock)
    with pytest.raises(NotAvailable, match="needs real time"):
        manager.obtain("base", BaseBus)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "no port is given"),
        ({"port": "simulated", "prot": "1"}, 'no parameter "prot"'),
        ({"port": "simulated", "forward": "-1"}, "forward is -1"),
        ({"port": "simulated", "light_at_10_cm": "0"}, "light_at_10_cm"),
    ],
)
def test_what_is_written_wrong_is_refused_with_its_place(clock, parameters, message) -> None:
    manager = ResourceManager([Description("base", "Hri.Create2", parameters)], clock)
    with pytest.raises(AuthoringError, match=message):
        manager.check()


def test_a_sensor_that_the_base_does_not_have_is_refused(manager) -> None:
    manager.declare(Description("cliff", "Hri.BaseCliffSensor", {"sensor": "lift"}, bus="base"))
    with pytest.raises(AuthoringError, match=r'no sensor "lift".*did you mean "left"'):
        manager.obtain("cliff", BaseCliffSensor)


def test_a_program_that_stood_still_finds_its_simulated_base_where_it_would_be(robot) -> None:
    robot.unlatched().go(1.2)
    begun = robot.world.base.travelled
    robot.clock._now += 2.0  # no timer runs meanwhile
    robot.clock.advance(0.1)
    # It went on until the command was too old, and is ready for the next one.
    assert robot.world.base.travelled - begun == pytest.approx(0.3 * 0.2 + 0.3**2 / 4, abs=0.02)
    assert not robot.bus.state.is_latched


def test_a_simulated_base_reports_as_soon_as_it_is_open(robot, manager) -> None:
    assert robot.clock.now() == 0.0
    assert not manager.obtain("bumper", BaseBumper).is_pressed(0.0)
    assert manager.obtain("battery", BaseBattery).level(0.0) > 0.9
    assert manager.obtain("range_front", BaseRangeSensor).read(0.0).distance == math.inf
    assert not robot.bus.is_latched


def test_a_program_that_stood_still_does_not_take_its_supervisor_for_mute(robot) -> None:
    robot.unlatched()
    robot.clock._now += 2.0
    robot.drive.set_velocity(GO, robot.clock.now())


def test_an_arduino_is_driven_by_the_same_devices(clock) -> None:
    wiring = {"port": "simulated", "bumps": "left:7 right:8", "sonars": "front:4"}
    wiring["buttons"] = "stop:12"
    devices = (
        Description("base", "Hri.ArduinoBridge", wiring),
        Description("drive", "Hri.BaseDrive", bus="base"),
        Description("bumper", "Hri.BaseBumper", bus="base"),
        Description("sonar", "Hri.BaseRangeSensor", {"sensor": "front", "x": "12"}, bus="base"),
    )
    with ResourceManager(devices, clock) as manager:
        bus, drive = manager.obtain("base", BaseBus), manager.obtain("drive", BaseDrive)
        bus.unlatch()
        clock.advance(3.5)
        assert not bus.state.faults
        drive.move_delta(0.3, 0.3, 0.4).wait(20)
        assert bus.report().rolled.linear == pytest.approx(0.3, abs=0.005)
        assert manager.obtain("sonar", BaseRangeSensor).read(clock.now()).distance > 0.3
        assert not manager.obtain("bumper", BaseBumper).is_pressed(clock.now())
        with pytest.raises(NotAvailable, match="no loudspeaker"):
            bus.song([Note(60, 0.25)])
        manager.obtain("base_line", ArduinoLine).port.line.emulator.body.held.add("stop")
        clock.advance(0.1)
        assert bus.explain() == "I stopped because someone pressed my stop button"
