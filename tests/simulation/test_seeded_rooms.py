import math
from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.hal.resource_manager import ResourceManager
from hri.simulation.navigation_trips import SENSORS, devices
from hri.simulation.people.person import RADIUS
from hri.simulation.room import Wall
from hri.simulation.seeded_rooms import ROBOT, Crowd, furnished
from hri.simulation.world import SimulatedWorld
from hri.simulation.world_file import load_layout


@pytest.mark.parametrize("seed", range(4))
def test_a_room_has_furniture_a_start_and_a_goal_far_away(seed: int) -> None:
    room = furnished(seed)
    assert math.dist(room.start, room.goal) > 3.0
    assert sum(not isinstance(thing, Wall) for thing in room.obstacles) >= 8
    for place in (room.start, room.goal):
        assert room.room.clearance(*place) > ROBOT + 0.1


def test_a_seed_makes_the_same_room_again_and_others_make_others() -> None:
    assert furnished(3).text == furnished(3).text != furnished(4).text


def test_a_room_is_a_world_file(tmp_path: Path) -> None:
    path = tmp_path / "room.toml"
    room = furnished(1)
    path.write_text(room.text)
    layout = load_layout(path)
    assert len(layout.room.obstacles) == len(room.obstacles)
    for person, place in zip(layout.people, room.people, strict=True):
        assert (person.x, person.y) == pytest.approx(place, abs=1e-3)


def walked(folder: Path, heedful: bool, seconds: float) -> tuple[float, float, list[float]]:
    """Meters walked, nearest to things, and gaps to a robot that stands in the way."""
    room = furnished(5)
    path = folder / f"room{heedful}.toml"
    path.write_text(room.text)
    clock = FakeClock()
    with ResourceManager(devices(path, 5, SENSORS["three sensors"]), clock) as resources:
        world = resources.obtain("world", SimulatedWorld)
        crowd = Crowd(room, world, heedful=heedful)
        way, nearest, gaps = 0.0, math.inf, []
        places = [person.place(0.0) for person in world.people]
        for _ in range(round(seconds * 10)):
            clock.advance(0.1)
            crowd.step(clock.now())
            after = [person.place(clock.now()) for person in world.people]
            way += sum(map(math.dist, places, after))
            nearest = min(nearest, *(room.room.clearance(*place) - RADIUS for place in after))
            here = world.base.pose.x, world.base.pose.y
            gaps += [math.dist(place, here) - RADIUS - ROBOT for place in after]
            places = after
    return way, nearest, gaps


def test_people_stroll_about_and_walk_through_nothing(tmp_path: Path) -> None:
    way, nearest, _ = walked(tmp_path, heedful=True, seconds=60.0)
    assert way > 20.0
    assert nearest > 0.0


def test_people_who_look_where_they_go_touch_no_robot_that_stands(tmp_path: Path) -> None:
    *_, gaps = walked(tmp_path, heedful=True, seconds=120.0)
    assert min(gaps) > 0.0


def test_people_who_look_at_nothing_run_into_a_robot_but_not_through_it(tmp_path: Path) -> None:
    *_, gaps = walked(tmp_path, heedful=False, seconds=120.0)
    assert -0.15 < min(gaps) < 0.0
