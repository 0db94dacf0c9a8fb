"""World files: where the walls and the furniture are, where the robot and the people start."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.errors import Place, did_you_mean
from hri.core.signals import Pose2D
from hri.core.toml import Table, load_toml
from hri.hal.drivers.image_size import picture_size
from hri.simulation.people.actors import ACTORS
from hri.simulation.people.appearance import DEFAULT_ACTOR
from hri.simulation.people.person import RADIUS
from hri.simulation.room import Box, Circle, Obstacle, Room, Wall
from hri.vision.markers.families import DEFAULT, FAMILIES
from hri.vision.markers.marker_reader import SIDE
from hri.vision.objects.printed_label import WIDTH

KIND = "config/worlds"
MOST_OBSTACLES = 500
MOST_PEOPLE = 8
CLEAR_VOICE, CLEAR_RATE = "en-us+m5", 125.0
"""The voice and words a minute that were heard best of 18 that were tried."""
COLORS: Mapping[str, tuple[int, int, int]] = {
    "red": (205, 38, 34),
    "green": (40, 150, 60),
    "blue": (36, 84, 190),
    "yellow": (232, 200, 40),
    "orange": (235, 128, 30),
    "purple": (126, 52, 150),
}
"""Of balls: red, green, blue."""
_FARTHEST = 100.0
_SMALLEST = 0.01


@dataclass(frozen=True)
class RobotStart:
    """The robot as the file gives it."""

    pose: Pose2D
    """Where it is switched on, in the coordinates of the room."""
    radius: float
    """Of its round body, meters."""
    slip: float
    """Standard deviation of a wheel's slip after one meter, as a part of the way."""


@dataclass(frozen=True)
class PersonStart:
    """A person as the file gives it."""

    x: float
    y: float
    name: str
    """What a visit calls them; empty for the only one."""
    actor: str
    """Their look; a key of `actors.ACTORS`."""
    voice: str
    """A voice of espeak-ng."""
    words_per_minute: float
    voice_place: Place


@dataclass(frozen=True)
class Item:
    """A thing that can be recognized by its look; it is not an obstacle."""

    name: str
    x: float
    y: float
    width: float = WIDTH
    """Meters."""
    picture: Path | None = None
    """What it looks like; without one it has a label with its name."""
    color: str = ""
    """Of a ball, a key of `COLORS`; a thing that is not a ball has none."""
    marker: int | None = None
    """Id of the AprilTag 36h11 on a card; `width` is that of its black square."""
    heading: float | None = None
    """Where a card faces in the room, radians; one without it is turned to the camera."""


@dataclass(frozen=True)
class WorldLayout:
    """What a world file says."""

    room: Room
    robot: RobotStart
    people: tuple[PersonStart, ...]
    """The camera follows the first; none in a bare room."""
    noise_db: float
    """Level of the room's noise against full scale."""
    items: tuple[Item, ...] = ()
    drops: tuple[Circle, ...] = ()
    """Where the floor ends: stairs, the edge of a table."""


def find_layout(name: str) -> Path:
    """The file of a world: a path, or the name of one in `config/worlds`, without its suffix."""
    return paths.find(KIND, name if Path(name).suffix else f"{name}.toml")


def load_layout(path: Path) -> WorldLayout:
    """Read a world file. Raises AuthoringError with the place of what is wrong."""
    root = load_toml(path, "world file")
    root.string("about", "")
    obstacles = _obstacles(root)
    layout = WorldLayout(
        room=Room(obstacles),
        robot=_robot(root.table("robot")),
        people=tuple(_person(table) for table in _people(root)),
        noise_db=float(root.number("noise_db", -62.0, minimum=-120.0, maximum=-20.0)),
        items=tuple(_item(table) for table in root.array("object")),
        drops=tuple(_drop(table) for table in root.array("drop")),
    )
    root.finish()
    _check_start(layout, root)
    return layout


def _obstacles(root: Table) -> list[Obstacle]:
    found: list[Obstacle] = []
    for kind, read in _READERS.items():
        for table in root.array(kind):
            if len(found) == MOST_OBSTACLES:
                what = f"more than {MOST_OBSTACLES} obstacles"
                raise table.error(None, what, "leave some of them out")
            table.string("name", "")
            found.append(read(table))
            table.finish()
    return found


def _item(table: Table) -> Item:
    x, y = _point(table, "at")
    name, picture = str(table.string("name")), str(table.string("picture", ""))
    marker = _marker(table) if "marker" in table else None
    usual = WIDTH if marker is None else SIDE
    width = float(table.number("width", usual, minimum=_SMALLEST, maximum=3.0))
    heading = _angle(table, "heading") if "heading" in table and marker is not None else None
    color = str(table.string("color", ""))
    if color and color not in COLORS:
        raise table.error("color", f'unknown color "{color}"', did_you_mean(color, COLORS))
    path = table.place("picture").path.parent / picture if picture else None
    if path is not None and (not paths.is_file(path) or picture_size(path) is None):
        raise table.error("picture", f"{path} is not a picture", "name a JPEG or PNG beside it")
    table.finish()
    return Item(name, x, y, width, path, color, marker, heading)


def _marker(table: Table) -> int:
    """The id of a marker. Raises AuthoringError for one that there is not."""
    id, last = float(table.number("marker")), FAMILIES[DEFAULT].count - 1
    if not (id.is_integer() and 0 <= id <= last):
        remedy = f"write a whole number from 0 to {last}"
        raise table.error("marker", f"marker is {id:g}", remedy)
    return int(id)


def _drop(table: Table) -> Circle:
    table.string("name", "")
    drop = _circle(table)
    table.finish()
    return drop


def _wall(table: Table) -> Wall:
    (x1, y1), (x2, y2) = _point(table, "from"), _point(table, "to")
    if math.hypot(x2 - x1, y2 - y1) < _SMALLEST:
        raise table.error("to", "this wall has no length", "move one of its ends")
    return Wall(x1, y1, x2, y2)


def _box(table: Table) -> Box:
    x, y = _point(table, "center")
    length, width = _size(table, "length"), _size(table, "width")
    return Box(x, y, length, width, _angle(table, "heading"))


def _circle(table: Table) -> Circle:
    x, y = _point(table, "center")
    return Circle(x, y, _size(table, "radius"))


_READERS: dict[str, Callable[[Table], Obstacle]] = {
    "wall": _wall,
    "box": _box,
    "circle": _circle,
}


def _robot(table: Table) -> RobotStart:
    x, y = _point(table, "start")
    start = RobotStart(
        pose=Pose2D(x, y, _angle(table, "heading")),
        radius=float(table.number("radius", 0.2, minimum=0.05, maximum=1.0)),
        slip=float(table.number("slip", 0.002, minimum=0.0, maximum=0.2)),
    )
    table.finish()
    return start


def _people(root: Table) -> list[Table]:
    """`[person]`, or `[[person]]` for each of several; none for a room without people."""
    if "person" not in root:
        return list(root.array("person"))
    if not isinstance(root.data.get("person"), list):
        return [root.table("person")]
    tables = root.array("person")
    if not 1 <= len(tables) <= MOST_PEOPLE:
        raise root.error("person", f"{len(tables)} people", f"write 1 to {MOST_PEOPLE}")
    names = [table.data.get("name", "") for table in tables]
    for number, (name, table) in enumerate(zip(names, tables, strict=True)):
        if len(tables) > 1 and name in ("", *names[:number]):
            what = f'another person is named "{name}"' if name else "this person has no name"
            raise table.error("name", what, "give each of them a different name")
    return tables


def _person(table: Table) -> PersonStart:
    x, y = _point(table, "at")
    start = PersonStart(
        x,
        y,
        name=str(table.string("name", "")),
        actor=str(table.string("actor", DEFAULT_ACTOR, among=tuple(ACTORS))),
        voice=str(table.string("voice", CLEAR_VOICE)),
        words_per_minute=float(
            table.number("words_per_minute", CLEAR_RATE, minimum=80, maximum=450)
        ),
        voice_place=table.place("voice"),
    )
    table.finish()
    return start


def _point(table: Table, name: str) -> tuple[float, float]:
    x, y = table.numbers(name, count=2)
    if not (abs(x) <= _FARTHEST and abs(y) <= _FARTHEST):  # also refuses nan
        what = f"{name} is {x:g}, {y:g}"
        raise table.error(name, what, f"write meters from -{_FARTHEST:g} to {_FARTHEST:g}")
    return x, y


def _size(table: Table, name: str) -> float:
    return float(table.number(name, minimum=_SMALLEST, maximum=_FARTHEST))


def _angle(table: Table, name: str) -> float:
    return float(table.number(name, 0.0, minimum=-2 * math.pi, maximum=2 * math.pi))


def _check_start(layout: WorldLayout, root: Table) -> None:
    pose, radius = layout.robot.pose, layout.robot.radius
    if layout.room.clearance(pose.x, pose.y) <= radius:
        remedy = "move the robot's start or what stands there"
        raise root.table("robot").error("start", "the robot starts inside an obstacle", remedy)
    for person, table in zip(layout.people, _people(root), strict=True):
        if math.dist((pose.x, pose.y), (person.x, person.y)) <= radius + RADIUS:
            remedy = "move the person away from the robot's start"
            raise table.error("at", "the person stands inside the robot", remedy)
