from benchmarks.drive import rooms, wheels
from hri.simulation.collisions import Collision
from hri.simulation.navigation_trips import Trip


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
