from collections.abc import Callable
from pathlib import Path

import pytest

from hri.core.errors import AuthoringError, HriError
from hri.simulation.room import Circle
from hri.simulation.world_file import MOST_OBSTACLES, find_layout, load_layout

Write = Callable[[str], Path]
START = "[robot]\nstart = [0, 0]\n[person]\nat = [1, 1]\n"


def test_home_has_twelve_meters_free_ahead_and_the_person_leaves_the_lane_free() -> None:
    layout = load_layout(find_layout("home"))
    person = Circle(layout.people[0].x, layout.people[0].y, 0.22)
    room = layout.room.with_more([person])
    start, radius = layout.robot.pose, layout.robot.radius
    assert all(room.clearance(start.x + x / 10, start.y) > radius + 0.1 for x in range(120))
    assert room.cast(start.x, start.y, start.heading) > 12


def test_a_name_works_with_and_without_suffix_and_as_a_path(write: Write) -> None:
    assert find_layout("home") == find_layout("home.toml")
    path = write(START)
    assert find_layout(str(path)) == path
    with pytest.raises(HriError, match='did you mean "home"'):
        find_layout("hom")


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("", 1, '"robot" is missing'),
        ("bxo = []\n" + START, 1, 'did you mean "box"'),
        (START + "[[box]]\ncenter = [1, 2]\nlength = 0\nwidth = 1\n", 7, "length is 0"),
        (
            START + "[[circle]]\ncenter = [1, nan]\nradius = 1\n",
            6,
            "center holds something that is not a number",
        ),
        (START + "[[circle]]\ncenter = [1, 2, 3]\nradius = 1\n", 6, "center has 3 numbers"),
        (START + "[[wall]]\nfrom = [1, 2]\nto = [1, 2]\n", 7, "no length"),
        (START + "[[wall]]\nfrom = [1, 2]\ntoo = [1, 3]\n", 5, 'rename "too"'),
        (START + "[[circle]]\ncenter = [0.1, 0.3]\nradius = 0.2\n", 2, "inside an obstacle"),
        (START.replace("[1, 1]", "[0.1, 0.2]"), 4, "inside the robot"),
        (START.replace("[0, 0]", "[0, 500]"), 2, "from -100 to 100"),
        ("noise_db = 3\n" + START, 1, "from -120 to -20"),
    ],
)
def test_a_wrong_file_is_refused_at_its_line(write: Write, text: str, line: int, said: str) -> None:
    with pytest.raises(AuthoringError) as caught:
        load_layout(write(text))
    assert said in str(caught.value)
    assert caught.value.place.line == line


def test_too_many_obstacles_are_refused(write: Write) -> None:
    circle = "[[circle]]\ncenter = [9, 9]\nradius = 0.1\n"
    with pytest.raises(AuthoringError, match="leave some of them out"):
        load_layout(write(START + circle * (MOST_OBSTACLES + 1)))


def test_a_bare_room_has_nobody_in_it(write: Write) -> None:
    assert load_layout(write("[robot]\nstart = [0, 0]\n")).people == ()
