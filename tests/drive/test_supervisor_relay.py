"""The guard of a base: an emulated Create 2, its supervisor, and whoever says stop."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

from hri.behavior.behavior import Context
from hri.behavior.ports import OutputPort
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event, HeadPose, People, Person, Twist
from hri.drive.behaviors import COMMAND, MOTION
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor_relay import SupervisorRelay, nearest
from hri.hal.drive import DriveSystem
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld

WORLD = Description("world", "Hri.SimulatedWorld")
BASE = Description("base", "Hri.Create2", {"port": "simulated"})
DRIVE = Description("drive", "Hri.BaseDrive", bus="base")
OTHER = Description("other", "Hri.ArduinoBridge", {"port": "simulated"})
TICK = 0.05


class Guarded:
    """A guard, its base, and what was told."""

    def __init__(self, resources: ResourceManager, base_id: str = "") -> None:
        self.clock, self.resources = resources.clock, resources
        self.events = EventBus(self.clock)
        self.told: list[Event] = []
        self.events.subscribe("drive.*", self.told.append)
        self.context = Context(self.clock, self.events, resources)
        self.sees = OutputPort[People]()
        self.guard = SupervisorRelay("guard", base_id=base_id)
        self.guard.people.sources.append(self.sees)

    def started(self) -> Guarded:
        self.guard.start(self.context)
        self.wait(0.5)
        return self

    def released(self) -> Guarded:
        self.started().guard.release()
        self.wait(0.5)
        assert not self.guard.must_wait
        return self

    def wait(self, seconds: float, twist: Twist | None = None) -> None:
        """Let the guard look, and a network drive."""
        drive = self.resources.obtain("drive", DriveSystem) if twist else None
        for _ in range(round(seconds / TICK)):
            self.guard.compute(self.clock.now(), TICK)
            if drive is not None and twist is not None:
                drive.set_velocity(twist, self.clock.now())
            self.clock.advance(TICK)

    def see(self, *distances: float) -> None:
        now = self.clock.now()
        people = (
            Person(f"p{number}", HeadPose(now, 0, 0), distance=distance, bearing=0.0)
            for number, distance in enumerate(distances)
        )
        self.sees.value = People(now, tuple(people))

    def stopped(self) -> list[str]:
        return [e.properties["words"] for e in self.told if e.name == "drive.stopped"]

    @property
    def speed(self) -> float:
        world = self.resources.obtain("world", SimulatedWorld)
        return world.base.velocity.linear


@pytest.fixture
def resources() -> Iterator[ResourceManager]:
    with ResourceManager([WORLD, BASE, DRIVE], FakeClock()) as resources:
        yield resources


def test_nothing_moves_after_a_stop_until_a_person_releases_the_base(
    resources: ResourceManager,
) -> None:
    guarded = Guarded(resources).started()
    guarded.guard.halt()
    guarded.wait(TICK)
    assert guarded.guard.must_wait
    assert guarded.guard.is_latched.value is True
    guarded.wait(1.0, Twist(0.2))
    assert guarded.speed == 0.0
    guarded.guard.release()
    guarded.wait(1.0, Twist(0.2))
    assert guarded.guard.is_latched.value is False
    assert guarded.speed > 0.05


@pytest.mark.parametrize(
    ("event", "properties", "words"),
    [
        ("speech.heard", {"rule": "stop"}, "someone said stop"),
        ("drive.halt", {"because": "the red button is pressed"}, "the red button is pressed"),
        ("drive.halt", {}, "I was told to"),
    ],
)
def test_who_says_stop_latches_the_base_and_hears_why(
    resources: ResourceManager, event: str, properties: dict[str, str], words: str
) -> None:
    guarded = Guarded(resources).released()
    guarded.wait(1.0, Twist(0.2))
    guarded.events.raise_event(event, **properties)
    guarded.wait(2.0, Twist(0.2))
    assert guarded.speed == 0.0
    assert guarded.guard.must_wait
    assert guarded.guard.explain() == f"I stopped because {words}"
    assert guarded.guard.explain() in guarded.stopped()


def test_a_stop_ends_what_tasks_asked_for_and_nothing_goes_on_after_the_release(
    resources: ResourceManager,
) -> None:
    guarded = Guarded(resources).released()
    motion, command = (guarded.context.board.slot(name) for name in (MOTION, COMMAND))
    motion.set(object(), guarded.clock.now())
    command.set(Twist(0.2), guarded.clock.now())
    guarded.events.raise_event("drive.halt")
    assert motion.value is None
    assert command.value is None


def test_another_rule_that_was_heard_stops_nothing(resources: ResourceManager) -> None:
    guarded = Guarded(resources).released()
    guarded.events.raise_event("speech.heard", rule="hello")
    guarded.wait(0.5)
    assert not guarded.guard.must_wait


def test_it_drives_faster_where_the_camera_sees_that_nobody_is_near(
    resources: ResourceManager,
) -> None:
    guarded, speeds = Guarded(resources).released(), []
    for distances in ((), (0.5,)):
        for _ in range(15):
            guarded.see(*distances)
            guarded.wait(0.1, Twist(0.4))
        speeds.append(guarded.speed)
    assert speeds[0] > speeds[1] > 0.0


def test_a_camera_that_has_stopped_says_nothing_of_people(resources: ResourceManager) -> None:
    guarded = Guarded(resources).released()
    for _ in range(15):
        guarded.see()
        guarded.wait(0.1, Twist(0.4))
    free = guarded.speed
    guarded.wait(4.0, Twist(0.4))  # the last look stays where it was
    assert guarded.speed < free


def test_a_guard_that_was_stopped_hears_and_tells_no_more(resources: ResourceManager) -> None:
    base = resources.obtain("base", BaseBus)
    guarded = Guarded(resources).released()
    guarded.guard.stop()
    guarded.told.clear()
    guarded.events.raise_event("drive.halt")
    assert not base.state.is_latched
    base.stop_latched("a test says so")
    guarded.clock.advance(0.5)
    assert base.state.is_latched
    assert [event.name for event in guarded.told] == ["drive.halt"]
    assert not guarded.guard.must_wait
    guarded.guard.stop()


def test_a_guard_that_was_started_again_tells_each_stop_once(resources: ResourceManager) -> None:
    resources.obtain("base", BaseBus)
    guarded = Guarded(resources).released()
    guarded.guard.stop()
    guarded.released()
    guarded.told.clear()
    guarded.guard.halt("a test says so")
    guarded.wait(0.5)
    assert guarded.stopped() == ["I stopped because a test says so"]


def test_a_base_is_guarded_by_its_name_where_there_are_several() -> None:
    with ResourceManager([WORLD, BASE, DRIVE, OTHER], FakeClock()) as resources:
        with pytest.raises(HriError, match="several bases: base, other"):
            Guarded(resources).started()
        with pytest.raises(HriError, match='"wheels" is not a base'):
            Guarded(resources, "wheels").started()
        assert Guarded(resources, "base").released().guard.explain()


def test_without_a_base_there_is_nothing_to_guard() -> None:
    with ResourceManager([WORLD], FakeClock()) as resources:
        guarded = Guarded(resources).started()
        guarded.events.raise_event("drive.halt")
        guarded.guard.release()
        assert not guarded.guard.must_wait
        assert guarded.guard.is_latched.value is None
        assert guarded.guard.explain() == ""
        guarded.guard.stop()


def test_a_base_that_is_not_there_keeps_nothing_from_starting() -> None:
    base = Description("base", "Hri.Create2", {"port": "/dev/null/none"})
    with ResourceManager([WORLD, base], FakeClock()) as resources:
        assert not Guarded(resources).started().guard.must_wait


@pytest.mark.parametrize(
    ("distances", "expected"),
    [((), math.inf), ((2.0, 1.0), 1.0), ((1.0, math.nan), math.nan)],
)
def test_the_nearest_is_unknown_where_one_of_them_is(
    distances: tuple[float, ...], expected: float
) -> None:
    who = tuple(Person("p", HeadPose(0.0, 0, 0), distance=d, bearing=0.0) for d in distances)
    assert nearest(People(0.0, who)) == pytest.approx(expected, nan_ok=True)


# --- a base without a supervisor ---


@pytest.fixture
def simulated() -> Iterator[ResourceManager]:
    drive = Description("drive", "Hri.SimulatedDrive")
    with ResourceManager([WORLD, drive], FakeClock()) as resources:
        yield resources


def test_the_simulated_base_begins_released(simulated: ResourceManager) -> None:
    guarded = Guarded(simulated).started()
    assert not guarded.guard.must_wait
    assert guarded.guard.is_latched.value is False
    assert guarded.guard.explain() == "I have not stopped"
    guarded.wait(1.0, Twist(0.2))
    assert guarded.speed == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("event", "properties", "words"),
    [
        ("speech.heard", {"rule": "stop"}, "someone said stop"),
        ("drive.halt", {"because": "the red button is pressed"}, "the red button is pressed"),
        ("drive.halt", {}, "I was told to"),
    ],
)
def test_the_simulated_base_latches_a_stop_until_a_person_releases_it(
    simulated: ResourceManager, event: str, properties: dict[str, str], words: str
) -> None:
    guarded = Guarded(simulated).started()
    guarded.wait(1.0, Twist(0.2))
    guarded.events.raise_event(event, **properties)
    guarded.wait(2.0, Twist(0.2))
    assert guarded.speed == 0.0
    assert guarded.guard.is_latched.value is True
    assert guarded.guard.explain() == f"I stopped because {words}"
    assert guarded.stopped() == [f"I stopped because {words}"]
    guarded.guard.release()
    guarded.wait(1.0, Twist(0.2))
    assert guarded.speed == pytest.approx(0.2)


def test_a_latched_simulated_base_refuses_motions_and_says_why(simulated: ResourceManager) -> None:
    guarded = Guarded(simulated).started()
    drive = simulated.obtain("drive", DriveSystem)
    going = drive.move_delta(2.0, 0.2, 0.4)
    guarded.wait(1.0)
    guarded.guard.halt("you said stop")
    assert going.is_done
    for begun in (drive.move_delta(0.5, 0.2, 0.4), drive.turn_delta(1.0, 1.0, 1.0)):
        with pytest.raises(HriError, match="I stopped because you said stop - unlatch"):
            begun.result()
    with pytest.raises(HriError, match="you said stop"):
        drive.move_and_turn(0.2, 0.4, 0.0, 1.0)
    drive.halt().wait(2)
    assert guarded.speed == 0.0


def test_closing_and_opening_the_drive_does_not_open_its_latch(simulated: ResourceManager) -> None:
    guarded = Guarded(simulated).started()
    guarded.guard.halt()
    guarded.guard.stop()
    assert not guarded.guard.must_wait
    assert Guarded(simulated).started().guard.must_wait


def test_where_the_base_is_not_there_its_stand_in_is_guarded() -> None:
    base = Description("base", "Hri.Create2", {"port": "/dev/null/none"})
    drive = Description("drive", "Hri.BaseDrive", {"stand_in": "simulated_drive"}, bus="base")
    simulated = Description("simulated_drive", "Hri.SimulatedDrive")
    with ResourceManager([WORLD, base, drive, simulated], FakeClock()) as resources:
        guarded = Guarded(resources).started()
        guarded.events.raise_event("speech.heard", rule="stop")
        guarded.wait(1.0, Twist(0.2))
        assert guarded.guard.must_wait
        assert guarded.speed == 0.0
