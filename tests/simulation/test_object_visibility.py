import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError
from hri.core.signals import Pose2D
from hri.simulation.object_visibility import seen
from hri.simulation.room import Room, Wall
from hri.simulation.world_file import Item, load_layout

EMPTY = Room()
ORIGIN = Pose2D()


def names(items, room=EMPTY, camera=ORIGIN, field_of_view=0.6):
    return [sighting.name for sighting in seen(items, room, camera, field_of_view)]


def test_the_nearest_comes_first_with_its_distance() -> None:
    cup, key = Item("cup", 2.0, 0.0), Item("key", 0.9, 0.1)
    assert names([cup, key]) == ["key", "cup"]
    assert seen([cup], EMPTY, Pose2D(1.0, 0.0, 0.0), 0.6)[0].distance == pytest.approx(1.0)


def test_a_wall_hides_what_is_behind_it() -> None:
    wall = Room([Wall(1.0, -1.0, 1.0, 1.0)])
    assert names([Item("far", 1.5, 0.0), Item("near", 0.5, 0.0)], wall) == ["near"]


@given(
    bearing=st.floats(-math.pi, math.pi),
    heading=st.floats(-7, 7),
    field_of_view=st.floats(0.1, 3.0),
)
def test_only_what_lies_within_the_field_of_view_is_seen(bearing, heading, field_of_view) -> None:
    angle = heading + bearing
    item = Item("cup", 1.0 + 2 * math.cos(angle), 2 * math.sin(angle))
    is_seen = bool(names([item], camera=Pose2D(1.0, 0.0, heading), field_of_view=field_of_view))
    if abs(abs(bearing) - field_of_view / 2) > 1e-6:
        assert is_seen == (abs(bearing) < field_of_view / 2)


def test_a_world_file_says_where_objects_are(tmp_path) -> None:
    path = tmp_path / "world.toml"
    head = "[robot]\nstart = [0, 0]\n[person]\nat = [1, 1]\n[[object]]\n"
    path.write_text(head + 'name = "cup"\nat = [1, 2]\n')
    assert load_layout(path).items == (Item("cup", 1.0, 2.0),)
    path.write_text(head + "at = [1, 2]\n")
    with pytest.raises(AuthoringError, match='"name" is missing'):
        load_layout(path)
    path.write_text(head + 'name = "cup"\nat = [1, 2]\nwidth = 0.1\ncolor = "red"\n')
    assert load_layout(path).items == (Item("cup", 1.0, 2.0, 0.1, None, "red"),)
    for line, error in (
        ('color = "rde"', 'unknown color "rde" - did you mean "red"'),
        ('picture = "junk.png"', r"junk\.png is not a picture - name a JPEG or PNG"),
        ("size = 1", 'unknown key "size"'),
    ):
        path.write_text(head + f'name = "cup"\nat = [1, 2]\n{line}\n')
        with pytest.raises(AuthoringError, match=error):
            load_layout(path)
