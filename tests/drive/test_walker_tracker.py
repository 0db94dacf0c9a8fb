import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.geometry import seen_from
from hri.core.signals import HeadPose, People, Person, Pose2D
from hri.drive.walker_tracker import REMEMBERED_S, SEEN_S, WalkerTracker

TICK = 0.1


def sight(time: float, pose: Pose2D, place: tuple[float, float], **more: float) -> People:
    """What a camera says of somebody at a place."""
    x, y = seen_from(pose, *place)
    where = {"distance": math.hypot(x, y), "bearing": math.atan2(y, x), **more}
    return People(time, (Person("p1", HeadPose(time, 0, 0), **where),))


def test_somebody_who_stands_is_where_they_were_seen_whatever_the_robot_does() -> None:
    tracker = WalkerTracker()
    place = (2.0, 1.0)
    for tick in range(10):
        pose = Pose2D(0.03 * tick, 0.0, 0.1 * tick)
        (found,) = tracker.see(tick * TICK, pose, sight(tick * TICK, pose, place))
        assert found == pytest.approx(place)
    (still,) = tracker.see(1.5, Pose2D(0.3, 0.0, 3.0), None)
    assert still == pytest.approx(place)


def test_what_is_told_late_is_placed_by_the_pose_of_the_picture() -> None:
    tracker, place = WalkerTracker(), (2.0, 1.0)
    poses = [Pose2D(heading=0.15 * tick) for tick in range(10)]
    for tick in range(2, 10):
        late = sight((tick - 2) * TICK, poses[tick - 2], place)
        tracker.see(tick * TICK - 2 * TICK, poses[tick - 2], None)
        tracker.see(tick * TICK - TICK, poses[tick - 1], None)
        (found,) = tracker.see(tick * TICK, poses[tick], late)
        assert found == pytest.approx(place)


def test_somebody_who_walks_out_of_the_picture_is_taken_to_walk_on() -> None:
    tracker = WalkerTracker()
    for tick in range(11):
        now = tick * TICK
        tracker.see(now, Pose2D(), sight(now, Pose2D(), (2.0, -1.0 + 0.8 * now)))
    (gone,) = tracker.see(2.0, Pose2D(), People(2.0))
    assert gone == pytest.approx((2.0, 0.6), abs=0.05)
    assert tracker.see(1.0 + REMEMBERED_S + 0.1, Pose2D(), None) == []


def test_an_error_of_the_distance_is_no_walk() -> None:
    tracker = WalkerTracker()
    for tick in range(20):
        now, error = tick * TICK, 0.05 * (-1) ** tick
        tracker.see(now, Pose2D(), sight(now, Pose2D(), (2.0 + error, 0.0)))
    (found,) = tracker.see(3.0, Pose2D(), None)
    assert found == pytest.approx((2.0, 0.0), abs=0.06)


def test_what_was_said_long_ago_is_in_nobodys_way() -> None:
    tracker = WalkerTracker()
    old = sight(0.0, Pose2D(), (1.0, 0.0))
    assert tracker.see(SEEN_S + 0.1, Pose2D(), old) == []


@pytest.mark.parametrize("distance", [math.nan, math.inf])
def test_who_is_at_no_known_distance_is_nowhere(distance: float) -> None:
    people = sight(0.0, Pose2D(), (1.0, 0.0), distance=distance)
    assert WalkerTracker().see(0.0, Pose2D(), people) == []


numbers = st.floats(-1e6, 1e6)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(0, 5), numbers, numbers), max_size=12))
def test_whatever_the_camera_says_places_are_numbers(
    told: list[tuple[float, float, float]],
) -> None:
    tracker = WalkerTracker()
    for tick, (time, x, y) in enumerate(told):
        for place in tracker.see(tick * TICK, Pose2D(), sight(time, Pose2D(), (x, y))):
            assert all(map(math.isfinite, place))
