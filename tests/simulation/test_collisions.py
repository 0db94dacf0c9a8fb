import math

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import Pose2D
from hri.simulation.collisions import Collision, Witness, hit_by
from hri.simulation.people.person import RADIUS

BODY = 0.2
TOUCH = BODY + RADIUS


def walked_into(
    speed: float, bearing: float, seen_at: tuple[float, ...] = (), walk: float = 1.0
) -> list[Collision]:
    """Somebody comes at `walk` m/s from a bearing and touches the robot at 2 s."""
    witness = Witness(BODY)
    for tick in range(60):
        now = tick * 0.05
        if any(abs(now - time) < 0.01 for time in seen_at):
            witness.see(now, "front", [0])
        away = TOUCH + max(0.0, 2.0 - now) * walk
        place = away * math.cos(bearing), away * math.sin(bearing)
        witness.watch(now, Pose2D(), speed, [place])
    return witness.collisions


@given(st.floats(-math.pi, math.pi), st.floats(0.0, 0.3))
def test_each_touch_is_one_collision_with_one_cause(bearing: float, speed: float) -> None:
    (collision,) = walked_into(speed, bearing)
    assert collision.side in collision.cause
    assert collision.is_moving == (speed > 0.01)
    assert abs(math.remainder(collision.bearing - bearing, math.tau)) < 1e-6


def test_whoever_walks_into_a_robot_that_stands_is_the_cause() -> None:
    (collision,) = walked_into(0.0, 0.0, (1.9,))
    assert collision.cause == "a person walked into the standing robot, ahead"


@pytest.mark.parametrize(("seen_at", "is_covered"), [((1.2,), False), ((1.6,), True)])
def test_a_sight_of_the_last_half_second_counts(seen_at: tuple[float], is_covered: bool) -> None:
    (collision,) = walked_into(0.2, math.pi / 2, seen_at)
    assert bool(collision.covered_by) == is_covered
    words = "covered by a sensor" if is_covered else "covered by no sensor"
    assert (
        collision.cause == f"the robot moved along or away from a person who walked, {words}, left"
    )
    assert collision.warning == pytest.approx(0.4 if is_covered else 0.0, abs=0.06)


def test_a_touch_that_lasts_counts_once_and_the_next_again() -> None:
    witness = Witness(BODY)
    for now, away in ((0.0, 1.0), (0.1, TOUCH), (0.2, TOUCH - 0.01), (0.3, 1.0), (0.4, TOUCH)):
        witness.watch(now, Pose2D(), 0.1, [(-away, 0.0)])
    assert [collision.side for collision in witness.collisions] == ["behind", "behind"]


def test_a_beam_covers_whom_it_ends_at() -> None:
    people = [(1.0, 0.0), (0.0, 2.0)]
    ends = {"front": (1.0 - RADIUS, 0.0), "left": (0.5, 0.5)}
    assert hit_by(ends, people) == {"front": [0], "left": []}
