import pytest

from hri.bench.chain import LINKS, combinations, words
from hri.bench.drive import measure, rooms, wheels, world
from hri.core.errors import HriError
from hri.testing.collisions import Collision
from hri.testing.trips import Trip


def trips(clean: int, of: int) -> list[Trip]:
    return [
        Trip(seed, "full", "three sensors", is_there=seed < clean, time=20.0, way=5.0)
        for seed in range(of)
    ]


def test_rooms_that_were_not_reached_are_named_and_fail_the_row() -> None:
    reached, people = rooms.told("full", trips(8, 10), is_limited=True)
    assert not reached["passed"]
    assert reached["not_clean"] == [8, 9]
    assert people["passed"]


def test_one_collision_with_somebody_fails_a_row() -> None:
    found = trips(10, 10)
    found[3].collisions.append(Collision(3.0, 0.2, 0.2, 1.0, 0.0, (), 0.0))
    reached, people = rooms.told("full", found, is_limited=True)
    assert (reached["count"], people["value"]) == (9, 1)
    assert not people["passed"]


def test_policies_to_compare_with_have_no_limit() -> None:
    rows = list(rooms.told("none", trips(0, 10), is_limited=False))
    assert all("passed" not in row for row in rows)


def test_arcs_end_where_the_closed_form_says() -> None:
    (row,) = wheels.rows()
    assert row["passed"]


def test_the_speed_of_the_world_is_measured() -> None:
    (row,) = world.rows(quick=True)
    assert row["unit"] == "times real time"
    assert row["value"] > 20


def test_each_combination_of_dead_links_leaves_one_alive_and_is_measured_once() -> None:
    found = combinations()
    assert len({words(done) for done in found}) == 3**3 - 2**3 - 1
    assert all(0 < len(done) < len(LINKS) for done in found)


def test_one_part_can_be_measured_alone_and_a_misspelt_one_is_refused() -> None:
    assert len(measure(only="odometry")["rows"]) == 1
    with pytest.raises(HriError, match='did you mean "chain"'):
        measure(only="chian")
