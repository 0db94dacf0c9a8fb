import math
from dataclasses import replace

import pytest
from hypothesis import given, settings, strategies as st

from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.geometry import along_arc, seen_from
from hri.core.signals import HeadPose, People, Person, Pose2D, RangeReading, Twist
from hri.drive.approach_detector import ApproachDetector
from hri.drive.avoidance import Avoidance, Manner, straight_to, turn_to
from hri.drive.contact_release import WAITS_S
from hri.drive.mechanics import Mechanics, mechanics_of, swept_radius
from hri.drive.progress import Progress
from hri.hal.configuration import load_configuration
from hri.hal.motion import REST
from hri.hal.resource_manager import ResourceManager
from hri.hal.shape import Shape
from hri.simulation.room import Box, Circle, Room, Wall

MECHANICS = Mechanics(
    0.25,
    {
        "front": Pose2D(0.18, 0.0, 0.0),
        "left": Pose2D(0.13, 0.13, math.pi / 4),
        "right": Pose2D(0.13, -0.13, -math.pi / 4),
    },
)
RADIUS = 0.2
"""Of the body that must not touch."""
TICK = 0.05


class Trial:
    """A robot that follows at once, in a room, with the three beams of MECHANICS."""

    def __init__(self, room: Room, people: tuple[tuple[float, float], ...] = ()) -> None:
        self.room, self.people = room, people
        self.avoidance = Avoidance(MECHANICS)
        self.pose, self.now = Pose2D(), 0.0
        self.closest = math.inf
        self.closest_person = math.inf
        self.fastest = 0.0
        self.path = [self.pose]

    def go(self, goal: Pose2D, seconds: float) -> bool:
        for _ in range(round(seconds / TICK)):
            if math.dist((self.pose.x, self.pose.y), (goal.x, goal.y)) <= 0.1:
                return True
            self.tick(goal)
        return False

    def tick(self, goal: Pose2D) -> Twist:
        self.now += TICK
        self.avoidance.see(self.now, self.pose, self.readings(), self.sights())
        twist = self.avoidance.steer(self.now, self.pose, goal)
        self.pose = along_arc(self.pose, twist.linear * TICK, twist.angular * TICK)
        self.path.append(self.pose)
        self.fastest = max(self.fastest, abs(twist.linear))
        here = (self.pose.x, self.pose.y)
        self.closest = min(self.closest, self.room.clearance(*here) - RADIUS)
        for person in self.people:
            self.closest_person = min(self.closest_person, math.dist(here, person) - RADIUS - 0.25)
        return twist

    def sights(self) -> People:
        """What a camera says that sees everybody."""
        found = []
        for number, place in enumerate(self.people):
            x, y = seen_from(self.pose, *place)
            where = {"distance": math.hypot(x, y), "bearing": math.atan2(y, x)}
            found.append(Person(f"p{number}", HeadPose(self.now, 0, 0), **where))
        return People(self.now, tuple(found))

    def readings(self) -> dict[str, RangeReading]:
        found = {}
        for id, mount in MECHANICS.mounts.items():
            cos, sin = math.cos(self.pose.heading), math.sin(self.pose.heading)
            x = self.pose.x + cos * mount.x - sin * mount.y
            y = self.pose.y + sin * mount.x + cos * mount.y
            length = float(self.room.cast(x, y, self.pose.heading + mount.heading))
            found[id] = RangeReading(id, length if length < 0.8 else math.inf, self.now)
        return found


def test_in_an_empty_room_it_goes_straight_to_the_goal() -> None:
    trial = Trial(Room())
    assert trial.go(Pose2D(3.0, 0.0), 3.0 / 0.3 + 3.0)
    assert max(abs(pose.y) for pose in trial.path) < 0.2
    assert trial.fastest == pytest.approx(0.3, abs=0.01)


@pytest.mark.parametrize(
    "thing",
    [
        Circle(1.5, 0.05, 0.2),
        Circle(1.5, -0.3, 0.4),
        Box(1.5, 0.0, 0.5, 1.8),
        Box(1.5, 0.2, 0.8, 0.8, 0.7),
    ],
)
def test_it_goes_around_a_thing_without_touching_it(thing: Circle | Box) -> None:
    trial = Trial(Room([thing]))
    assert trial.go(Pose2D(3.0, 0.0), 40.0)
    assert trial.closest > 0.0


def test_it_gets_out_of_a_dead_end() -> None:
    walls = [
        Wall(0.5, -0.9, 1.6, -0.9),
        Wall(1.6, -0.9, 1.6, 0.9),
        Wall(1.6, 0.9, 0.5, 0.9),
    ]
    trial = Trial(Room(walls))
    assert trial.go(Pose2D(3.0, 0.0), 120.0)
    assert trial.closest > 0.0


def test_before_a_wall_without_an_end_it_does_not_touch() -> None:
    trial = Trial(Room([Wall(1.5, -50, 1.5, 50)]))
    assert not trial.go(Pose2D(3.0, 0.0), 20.0)
    assert trial.closest > 0.0


def test_it_keeps_half_a_meter_to_people_it_knows_of() -> None:
    trial = Trial(Room([Circle(1.5, 0.0, 0.22)]), people=((1.5, 0.0),))
    assert trial.go(Pose2D(3.5, 0.0), 40.0)
    assert trial.closest_person > 0.45


def watched(watch: float, seconds: float) -> Trial:
    """Someone crosses close to a robot, which goes to someone far ahead."""
    trial = Trial(Room())
    trial.avoidance = Avoidance(MECHANICS, Manner(watch=watch))
    for step in range(round(seconds / TICK)):
        trial.people = ((1.0 + 0.3 * step * TICK, 1.0 - step * TICK),)
        trial.tick(Pose2D(5.0, 0.0, 0.0))
    return trial


def test_whoever_is_watched_stays_in_sight_while_another_one_crosses() -> None:
    trial = watched(0.35, 8.0)
    assert max(abs(pose.heading) for pose in trial.path) < 0.45
    assert trial.pose.x > 1.0, "it waits no longer than it must"
    heedless = watched(math.inf, 8.0)
    assert max(abs(pose.heading) for pose in heedless.path) > 0.6


def test_what_does_not_go_away_is_gone_around_though_someone_is_watched() -> None:
    trial = Trial(Room([Box(1.5, 0.0, 0.5, 1.8)]))
    trial.avoidance = Avoidance(MECHANICS, Manner(watch=0.35))
    assert trial.go(Pose2D(3.5, 0.0, 0.0), 60.0)
    assert trial.closest > 0


def test_it_keeps_to_one_side() -> None:
    trial = Trial(Room([Box(1.5, 0.0, 0.5, 1.8)]))
    sides = []
    while trial.pose.x < 1.5:
        trial.tick(Pose2D(3.0, 0.0))
        sides.append(trial.avoidance.side)
    ys = [pose.y for pose in trial.path]
    assert min(ys) > -0.25 or max(ys) < 0.25
    assert len(set(sides) - {0}) == 1


def test_without_range_sensors_it_goes_slowly_and_straight() -> None:
    avoidance = Avoidance(Mechanics(0.25))
    speeds = []
    for tick in range(20):
        avoidance.see(tick * TICK, Pose2D(), {})
        speeds.append(avoidance.steer(tick * TICK, Pose2D(), Pose2D(3.0, 0.0)))
    assert all(0.14 < twist.linear <= 0.15 for twist in speeds)
    assert all(abs(twist.angular) < 0.1 for twist in speeds)


@pytest.mark.parametrize("length", [math.nan, -1.0, None])
def test_with_a_sensor_that_says_nothing_it_does_not_go_ahead(length: float | None) -> None:
    avoidance = Avoidance(MECHANICS)
    readings = {id: RangeReading(id, math.inf, 0.0) for id in ("front", "left")}
    if length is not None:
        readings["right"] = RangeReading("right", length, 0.0)
    avoidance.see(0.0, Pose2D(), readings)
    assert avoidance.steer(0.0, Pose2D(), Pose2D(3.0, 0.0)).linear == 0.0


def test_with_a_reading_that_is_old_it_does_not_go_ahead() -> None:
    avoidance = Avoidance(MECHANICS)
    readings = {id: RangeReading(id, math.inf, 0.0) for id in MECHANICS.mounts}
    avoidance.see(0.4, Pose2D(), readings)
    assert avoidance.steer(0.4, Pose2D(), Pose2D(3.0, 0.0)).linear > 0.0
    avoidance.see(0.6, Pose2D(), readings)
    assert avoidance.steer(0.6, Pose2D(), Pose2D(3.0, 0.0)).linear == 0.0


def test_a_goal_that_moves_is_followed_at_once() -> None:
    trial = Trial(Room([Box(1.5, 0.0, 0.5, 1.8)]))
    trial.go(Pose2D(3.0, 0.0), 5.0)
    assert trial.go(Pose2D(0.0, 1.0), 10.0)


def test_a_touch_makes_it_back_off_and_go_around() -> None:
    trial = Trial(Room())
    trial.go(Pose2D(3.0, 0.0), 2.0)
    before = trial.pose.x
    trial.avoidance.touch(trial.now, trial.pose, True)
    assert trial.tick(Pose2D(3.0, 0.0)) == REST
    trial.go(Pose2D(3.0, 0.0), 0.3)
    assert trial.tick(Pose2D(3.0, 0.0)).linear < 0
    trial.go(Pose2D(3.0, 0.0), 1.0)
    assert trial.pose.x < before
    trial.avoidance.touch(trial.now, trial.pose, False)
    assert trial.go(Pose2D(3.0, 0.0), 40.0)
    assert max(abs(pose.y) for pose in trial.path) > 0.25


def _leaned_on(*leaning: Circle) -> Trial:
    """A robot that stands, and on which somebody leans."""
    trial = Trial(Room(leaning))
    for _ in range(10):
        trial.avoidance.see(trial.now, trial.pose, trial.readings())
    return trial


def _let_go(trial: Trial) -> float:
    """Seconds until nobody leans on the robot any more; it drives away from them, never on."""
    begun = trial.now
    while (clearance := trial.room.clearance(trial.pose.x, trial.pose.y) - RADIUS) < 0.01:
        trial.avoidance.touch(trial.now, trial.pose, clearance < 0.01)
        before = trial.pose
        assert trial.tick(Pose2D(3.0, 0.0)).linear <= 0.0
        if trial.room.clearance(trial.pose.x, trial.pose.y) < RADIUS - 0.005:
            trial.pose = replace(before, heading=trial.pose.heading)  # they do not give way
        assert trial.now - begun < 30.0
    return trial.now - begun


@pytest.mark.parametrize("bearing", [0.0, 90.0, 180.0, 250.0])
def test_who_leans_on_a_robot_that_stands_is_waited_for_then_backed_off_from(
    bearing: float,
) -> None:
    x, y = 0.41 * math.cos(math.radians(bearing)), 0.41 * math.sin(math.radians(bearing))
    trial = _leaned_on(Circle(x, y, 0.21))
    assert WAITS_S <= _let_go(trial) < WAITS_S + 10.0


def test_who_goes_by_themselves_is_not_backed_off_from() -> None:
    trial = _leaned_on(Circle(0.0, 0.41, 0.21))
    while trial.now < WAITS_S - 0.5:
        trial.avoidance.touch(trial.now, trial.pose, True)
        assert trial.tick(Pose2D(3.0, 0.0)).linear == 0.0
    trial.room = Room()
    trial.avoidance.touch(trial.now, trial.pose, False)
    assert trial.go(Pose2D(3.0, 0.0), 30.0)
    assert min(pose.x for pose in trial.path) > -0.01


def test_a_robot_between_two_people_gets_away_sideways() -> None:
    trial = _leaned_on(Circle(0.0, 0.41, 0.21), Circle(0.0, -0.5, 0.21))
    _let_go(trial)
    assert abs(trial.pose.x) > abs(trial.pose.y)


@settings(max_examples=4, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.9, 3.0), st.floats(-1.5, 1.5), st.floats(0.15, 0.5)), max_size=5)
)
def test_round_things_that_stand_still_are_never_touched(
    things: list[tuple[float, float, float]],
) -> None:
    trial = Trial(Room([Circle(*thing) for thing in things]))
    trial.go(Pose2D(3.5, 0.0), 10.0)
    assert trial.closest > -0.01


numbers = st.floats(allow_nan=True, allow_infinity=True)


@settings(max_examples=15, deadline=None)
@given(st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=10))
def test_whatever_the_sensors_say_speed_stays_within_the_manner(
    lengths: list[tuple[float, float, float]],
) -> None:
    avoidance = Avoidance(MECHANICS)
    for number, values in enumerate(lengths):
        now = number * TICK
        ids = zip(MECHANICS.mounts, values, strict=True)
        avoidance.see(now, Pose2D(), {id: RangeReading(id, value, now) for id, value in ids})
        twist = avoidance.steer(now, Pose2D(), Pose2D(3.0, 1.0))
        assert -0.1 <= twist.linear <= 0.3
        assert abs(twist.angular) <= 1.0


def test_a_robot_turns_by_the_shorter_side_and_stops_when_it_faces() -> None:
    assert turn_to(Pose2D(heading=3.0), -3.0, 1.0).angular > 0
    assert turn_to(Pose2D(heading=1.0), 1.01, 1.0) == REST


def test_straight_on_it_slows_down_before_the_goal() -> None:
    manner = replace(Manner(), speed=1.0)
    far, near = (straight_to(Pose2D(), Pose2D(x), manner).linear for x in (3.0, 0.3))
    assert far == 1.0
    assert near < 0.5
    assert straight_to(Pose2D(), Pose2D(0.05), manner) == REST


def test_a_beam_that_gets_shorter_is_noticed() -> None:
    detector = ApproachDetector(MECHANICS.mounts)
    for tick in range(10):
        detector.see(tick * TICK, {"left": RangeReading("left", 0.6 - 0.02 * tick, tick * TICK)})
    assert detector.nearest == pytest.approx(0.42)
    for tick in range(10, 20):
        detector.see(tick * TICK, {"left": RangeReading("left", 0.42, tick * TICK)})
    assert detector.nearest == math.inf


def test_standing_still_is_noticed_and_turning_once_around_is_not() -> None:
    progress = Progress()
    stuck = [progress.is_stuck(t * 0.1, Pose2D(heading=t * 0.06)) for t in range(200)]
    assert not any(stuck[:90])
    assert stuck[-1], "it has turned round and round"
    progress.rest()
    assert not progress.is_stuck(20.0, Pose2D())
    assert progress.is_stuck(24.1, Pose2D())


def test_the_mechanics_are_those_of_the_configuration() -> None:
    configuration = load_configuration(paths.find("config", "resource-config"))
    resources = ResourceManager(configuration.devices, FakeClock(), shapes=configuration.shapes)
    mechanics = mechanics_of(resources, ["range_front", "range_left", "range_right"])
    assert mechanics.radius == pytest.approx(0.18 * math.sqrt(2))
    assert mechanics.mounts["range_left"].heading == pytest.approx(math.pi / 4)
    assert mechanics.mounts["range_left"].x == pytest.approx(0.13)


def test_a_body_beside_its_axle_sweeps_a_wider_circle() -> None:
    assert swept_radius(Shape(lx=0.4, ly=0.3, x=0.1)) == pytest.approx(math.hypot(0.3, 0.15))
