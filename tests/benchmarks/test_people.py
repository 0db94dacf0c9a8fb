import math

from benchmarks import people
from hri.simulation.collisions import Collision
from hri.simulation.navigation_trips import Trip


def collision(speed: float, sensors: tuple[str, ...]) -> Collision:
    return Collision(3.0, speed, speed, 1.0, math.pi / 2, sensors, 0.3)


def trips(*collisions: Collision, arrive: int = 10) -> list[Trip]:
    found = [
        Trip(seed, "full", "three sensors", is_there=seed < arrive, time=40.0) for seed in range(10)
    ]
    found[4].collisions.extend(collisions)
    return found


BEFORE = people.Before(reached=0.9, seconds=30.0)


def test_one_collision_with_somebody_covered_fails_the_row_and_is_told() -> None:
    driven = trips(collision(0.2, ("left",)), collision(0.0, ("left",)), collision(0.2, ()))
    covered, others, arrived, time = people.told("rooms", driven, BEFORE)
    assert covered["value"] == 1
    assert not covered["passed"]
    assert covered["each"][0]["room"] == 4
    assert others["causes"] == {
        "a person walked into the standing robot, left": 1,
        "the robot moved toward a person who walked, covered by no sensor, left": 1,
    }
    assert arrived["passed"]
    assert time["passed"]


def test_trips_that_take_longer_or_do_not_arrive_fail() -> None:
    *_, arrived, time = people.told("rooms", trips(arrive=8), BEFORE)
    assert not arrived["passed"]
    assert arrived["not_there"] == [8, 9]
    *_, time = people.told("rooms", trips(), people.Before(reached=0.9, seconds=20.0))
    assert not time["passed"]
