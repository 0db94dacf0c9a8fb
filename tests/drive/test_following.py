import itertools
import math

import pytest
from hypothesis import given, strategies as st

from hri.core.geometry import along_arc, seen_from
from hri.core.signals import HeadPose, People, Person, Pose2D
from hri.drive.avoidance import Manner as Going, straight_to, turn_to
from hri.drive.following import Following, FollowingManner, Pursuit, sight_of
from hri.drive.wandering import Wandering

TICK = 0.05


class Chase:
    """A robot that follows at once, and somebody whom it sees, or not."""

    def __init__(self, x: float, y: float) -> None:
        self.following = Following(FollowingManner(distance=1.2))
        self.pose, self.now = Pose2D(), 0.0
        self.target = (x, y)
        self.is_seen = True
        self.turned = 0.0

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self.now += TICK
            if self.is_seen:
                x, y = seen_from(self.pose, *self.target)
                self.following.see(self.now, self.pose, math.atan2(y, x), math.hypot(x, y))
            goal = self.following.goal(self.now, self.pose)
            if goal is None:
                continue
            twist = straight_to(self.pose, goal, Going(near=0.05))
            if math.dist((goal.x, goal.y), (self.pose.x, self.pose.y)) <= 0.05:
                twist = turn_to(self.pose, goal.heading, 1.0)
            self.turned += twist.angular * TICK
            self.pose = along_arc(self.pose, twist.linear * TICK, twist.angular * TICK)

    @property
    def apart(self) -> float:
        return math.dist((self.pose.x, self.pose.y), self.target)

    @property
    def facing(self) -> float:
        x, y = seen_from(self.pose, *self.target)
        return math.atan2(y, x)


@pytest.mark.parametrize("place", [(3.0, 0.0), (2.0, 2.0), (-2.0, 1.0)])
def test_it_keeps_its_distance_and_faces(place: tuple[float, float]) -> None:
    chase = Chase(*place)
    chase.run(20.0)
    assert chase.apart == pytest.approx(1.2, abs=0.25)
    assert chase.facing == pytest.approx(0.0, abs=0.1)
    assert chase.following.pursuit is Pursuit.FOLLOWING


def test_it_follows_somebody_who_walks_on() -> None:
    chase = Chase(2.0, 0.0)
    for step in range(100):
        chase.target = (2.0 + step * 0.02, step * 0.01)
        chase.run(0.1)
    chase.run(5.0)
    assert chase.apart == pytest.approx(1.2, abs=0.3)


def test_somebody_who_comes_near_is_faced_from_where_it_stands() -> None:
    chase = Chase(0.6, 0.4)
    chase.run(5.0)
    assert (chase.pose.x, chase.pose.y) == pytest.approx((0.0, 0.0), abs=0.01)
    assert chase.facing == pytest.approx(0.0, abs=0.1)


def test_a_lost_target_is_looked_for_where_it_was_then_around_then_given_up() -> None:
    chase = Chase(3.0, 0.5)
    chase.run(3.0)
    chase.is_seen = False
    chase.run(3.0)
    assert chase.following.pursuit is Pursuit.SEARCHING
    chase.run(16.9)
    assert chase.apart < 1.5, "it went to where the target was"
    assert abs(chase.turned) > 2.0, "it looked around"
    chase.run(5.0)
    assert chase.following.pursuit is Pursuit.LOST
    before = chase.pose
    chase.run(2.0)
    assert chase.pose == before


def test_it_looks_first_to_the_side_on_which_the_target_went() -> None:
    chase = Chase(0.8, -0.6)
    chase.run(0.1)
    chase.is_seen = False
    chase.run(3.0)
    assert chase.pose.heading < -0.5


def test_whoever_walks_out_of_sight_is_looked_for_where_they_walk() -> None:
    chase = Chase(2.0, 0.0)
    for step in range(40):
        chase.target = (2.0, 0.02 * step)
        chase.run(TICK)
    chase.is_seen = False
    for step in range(40, 70):
        chase.target = (2.0, 0.02 * step)
        chase.run(TICK)
    assert abs(chase.facing) < 0.25


def test_a_target_that_is_found_again_is_followed() -> None:
    chase = Chase(3.0, 0.0)
    chase.run(2.0)
    chase.is_seen = False
    chase.run(2.0)
    chase.is_seen = True
    chase.run(10.0)
    assert chase.following.pursuit is Pursuit.FOLLOWING
    assert chase.apart == pytest.approx(1.2, abs=0.25)


@given(st.floats(allow_nan=True), st.floats(allow_nan=True))
def test_a_sight_that_is_no_place_is_none(bearing: float, distance: float) -> None:
    following = Following()
    following.see(0.0, Pose2D(), bearing, distance)
    goal = following.goal(0.1, Pose2D())
    assert goal is None or all(map(math.isfinite, (goal.x, goal.y, goal.heading)))


def person(id: str, distance: float, is_visible: bool = True) -> Person:
    return Person(id, HeadPose(0.0, 0.0, 0.0), distance=distance, is_visible=is_visible)


def test_of_several_the_attended_one_is_followed_else_the_nearest() -> None:
    persons = (person("p1", 2.0), person("p2", 1.0), person("p3", math.nan))

    def sight(attended: str = "", id: str = "", now: float = 0.0) -> str:
        found = sight_of(People(0.0, persons, attended), id, now)
        return found.id if found else ""

    assert sight() == "p2"
    assert sight(attended="p1") == "p1"
    assert sight(attended="p1", id="p2") == "p2"
    assert sight(id="p3") == "", "how far they are is not known"
    assert sight(now=2.0) == "", "nobody has looked for two seconds"


def test_what_was_seen_before_a_turn_is_not_seen_again_after_it() -> None:
    following, people = Following(), People(0.0, (person("p1", 2.0),))
    assert following.look(0.0, Pose2D(), people, "") is not None
    turned = Pose2D(0.0, 0.0, 1.5)
    assert following.look(0.5, turned, people, "") is None
    goal = following.goal(0.5, turned)
    assert goal is not None
    assert goal.heading == pytest.approx(0.0, abs=1e-9)
    following.goal(1.1, turned)
    assert following.pursuit is Pursuit.SEARCHING, "a second after it was seen"


def test_wandering_goes_on_and_repeats_with_its_seed() -> None:
    def places(seed: int) -> list[Pose2D]:
        wandering, pose, found = Wandering(seed), Pose2D(), []
        for step in range(10):
            pose = wandering.goal(step * 1.0, pose)
            found.append(pose)
        return found

    assert places(1) == places(1) != places(2)
    ways = [math.dist((a.x, a.y), (b.x, b.y)) for a, b in itertools.pairwise(places(1))]
    assert min(ways) >= 1.0


def test_a_place_that_cannot_be_reached_is_given_up() -> None:
    wandering = Wandering()
    first = wandering.goal(0.0, Pose2D())
    assert wandering.goal(10.0, Pose2D()) == first
    assert wandering.goal(16.0, Pose2D()) != first


def sighting(time: float, *who: tuple[str, float, float], attended: str) -> People:
    """People by their id, bearing and distance."""
    persons = (
        Person(id, HeadPose(time, 0, 0), bearing=bearing, distance=distance)
        for id, bearing, distance in who
    )
    return People(time, tuple(persons), attended)


def test_whoever_is_followed_stays_it_though_another_one_is_attended_to():
    following, pose = Following(), Pose2D()
    following.look(0.0, pose, sighting(0.0, ("p1", 0.0, 2.0), attended="p1"), "")
    both = sighting(0.1, ("p1", 0.0, 2.0), ("p2", 0.5, 1.0), attended="p2")
    following.look(0.1, pose, both, "")
    assert following.person == "p1"
    assert following.target == pytest.approx((2.0, 0.0))
    alone = sighting(0.2, ("p2", 0.5, 1.0), attended="p2")
    assert following.look(0.2, pose, alone, "") is None
    assert following.target == pytest.approx((2.0, 0.0))


def test_after_giving_up_it_may_follow_another_one():
    following, pose = Following(FollowingManner(patience_s=1.5)), Pose2D()
    following.look(0.0, pose, sighting(0.0, ("p1", 0.0, 2.0), attended="p1"), "")
    for tick in range(60):
        following.goal(tick * TICK, pose)
    assert following.pursuit is Pursuit.LOST
    following.look(3.1, pose, sighting(3.1, ("p2", 0.5, 1.0), attended="p2"), "")
    assert following.person == "p2"
    assert following.pursuit is Pursuit.FOLLOWING


def test_who_was_seen_is_where_the_robot_saw_them_from_when_the_picture_was_taken():
    following = Following()
    for tick in range(5):
        following.look(tick * TICK, Pose2D(0.0, 0.0, 0.1 * tick), None, "")
    people = sighting(0.05, ("p1", 0.3, 1.0), attended="p1")
    following.look(0.25, Pose2D(0.0, 0.0, 0.5), people, "")
    assert following.target == pytest.approx((math.cos(0.4), math.sin(0.4)))
