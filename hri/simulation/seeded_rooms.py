"""Seeded rooms: furniture, a start, a goal that can be reached, and people who walk about.

A room is a world file like any other (`text`), so it can be kept, edited and driven in. Its people
are moved by a `Crowd`: they stroll between free places, stand there for a while, and look where
they go: someone who is `heedful` stops for a robot that stands in the next steps; someone who is
not stops when they run into it. Nobody looks behind or to the side, so a robot that drives into
someone's flank has only itself to blame.

Meters, radians, seconds.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from hri.simulation.people.person import RADIUS as PERSON, SimulatedPerson
from hri.simulation.room import Box, Circle, Obstacle, Room, Wall
from hri.simulation.world import SimulatedWorld

Point = tuple[float, float]

ROBOT = 0.2
"""Radius of the robot that a room is made for."""
PASSAGE = 0.15
"""Free on each side of it along a way to the goal: a door of 70 cm."""
CELL = 0.1
"""Of the grid on which a way is looked for."""
MOST_PIECES, WALKERS = 12, 3
PIECES = ((1.9, 0.85), (1.4, 0.8), (0.8, 0.8), (1.2, 0.4), (0.9, 0.35), (0.5, 0.5))
"""Length and width of sofas, tables, shelves, chairs."""
ROUNDS = (0.45, 0.3, 0.2, 0.15)
"""Radii of round tables, stools, plants."""
LOOKS_AHEAD = 0.6
"""How far a heedful person looks along their way."""
POLITE = 0.1
"""What they keep free between themselves and the robot."""
STAND_S = (1.0, 6.0)
"""Least and most seconds that someone stands at a place."""
_TRIES = 400


@dataclass(frozen=True)
class Furnished:
    """A room with what is in it, where the robot starts and where it is to go."""

    seed: int
    length: float
    width: float
    obstacles: tuple[Obstacle, ...]
    start: Point
    heading: float
    goal: Point
    people: tuple[Point, ...]

    @cached_property
    def room(self) -> Room:
        """All that stands still."""
        return Room(self.obstacles)

    @property
    def text(self) -> str:
        """The room as a world file."""
        lines = [
            f'about = "A furnished room, made of the seed {self.seed}."',
            "[robot]",
            f"start = [{self.start[0]:.3f}, {self.start[1]:.3f}]",
            f"heading = {self.heading:.4f}",
            f"radius = {ROBOT}",
        ]
        for number, (x, y) in enumerate(self.people, 1):
            lines += ["[[person]]", f'name = "walker {number}"', f"at = [{x:.3f}, {y:.3f}]"]
        for obstacle in self.obstacles:
            lines += _told(obstacle)
        return "\n".join([*lines, ""])


def furnished(seed: int) -> Furnished:
    """The room of a seed: MOST_PIECES of furniture at most, WALKERS people."""
    for attempt in range(_TRIES):
        dice = random.Random(f"room {seed}/{attempt}")
        length, width = dice.uniform(5.5, 8.0), dice.uniform(4.5, 6.5)
        obstacles = [*_walls(length, width), *_furniture(dice, length, width)]
        room = Room(obstacles)
        found = _start_and_goal(dice, room, length, width)
        if found is None:
            continue
        start, goal = found
        people: list[Point] = []
        while len(people) < WALKERS:
            place = _free_place(dice, room, length, width, PERSON + 0.1)
            if math.dist(place, start) > 1.5:
                people.append(place)
        heading = round(dice.uniform(-math.pi, math.pi), 4)
        things = tuple(obstacles)
        return Furnished(seed, length, width, things, start, heading, goal, tuple(people))
    raise ValueError(f"no room of seed {seed} has a way through - take another seed")


class Crowd:
    """The people of a room, who walk about in its world."""

    def __init__(self, room: Furnished, world: SimulatedWorld, *, heedful: bool = True) -> None:
        self._room, self._world, self._is_heedful = room, world, heedful
        self._walkers = [
            _Walker(person, random.Random(f"walker {room.seed}/{number}"))
            for number, person in enumerate(world.people)
        ]

    def step(self, now: float) -> None:
        """Let everyone decide; to be called some ten times a second."""
        for walker in self._walkers:
            walker.step(now, self)

    def is_held_up(self, place: Point, goal: Point) -> bool:
        """Whether a heedful person sees the robot on their next steps; another one runs into it."""
        if not self._is_heedful:
            return self._runs_into(place, goal)
        way = math.dist(place, goal)
        part = min(1.0, LOOKS_AHEAD / way) if way else 0.0
        ahead = tuple(a + (b - a) * part for a, b in zip(place, goal, strict=True))
        base = self._world.base
        robot = Room([_step(place, ahead)]).clearance(base.pose.x, base.pose.y)
        return robot < base.limits.radius + PERSON + POLITE

    def _runs_into(self, place: Point, goal: Point) -> bool:
        """Whether they touch the robot, and their way leads into it."""
        base = self._world.base
        x, y = base.pose.x - place[0], base.pose.y - place[1]
        touches = math.hypot(x, y) < base.limits.radius + PERSON
        return touches and x * (goal[0] - place[0]) + y * (goal[1] - place[1]) > 0

    def next_goal(self, place: Point, dice: random.Random) -> Point:
        """A free place that can be walked to straight on."""
        room, others = self._room, [w.person for w in self._walkers]
        for _ in range(30):
            goal = _free_place(dice, room.room, room.length, room.width, PERSON + 0.1)
            is_taken = any(math.dist(goal, (o.x, o.y)) < 2 * PERSON for o in others)
            if not is_taken and _is_clear(room.room, place, goal, PERSON + 0.05):
                return goal
        return place


class _Walker:
    """One of them."""

    def __init__(self, person: SimulatedPerson, dice: random.Random) -> None:
        self.person, self._dice = person, dice
        self._goal: Point | None = None
        self._stands_until = dice.uniform(0.0, STAND_S[1])

    def step(self, now: float, crowd: Crowd) -> None:
        place = self.person.place(now)
        if self._goal is not None:
            is_there = math.dist(place, self._goal) < 0.02
            if is_there or crowd.is_held_up(place, self._goal):
                self._stand(place, now)
        elif now >= self._stands_until:
            goal = crowd.next_goal(place, self._dice)
            if goal == place or crowd.is_held_up(place, goal):
                self._stand(place, now)
            else:
                self._goal = goal
                self.person.go(*goal, now)

    def _stand(self, place: Point, now: float) -> None:
        if self._goal is not None:
            self.person.go(*place, now)
        self._goal = None
        self._stands_until = now + self._dice.uniform(*STAND_S)


def _step(place: Point, ahead: tuple[float, ...]) -> Obstacle:
    if math.dist(place, ahead) < 1e-6:
        return Circle(*place, 0.0)
    return Wall(*place, *ahead)


def _walls(length: float, width: float) -> list[Obstacle]:
    return [
        Wall(0.0, 0.0, length, 0.0),
        Wall(length, 0.0, length, width),
        Wall(length, width, 0.0, width),
        Wall(0.0, width, 0.0, 0.0),
    ]


def _furniture(dice: random.Random, length: float, width: float) -> list[Obstacle]:
    """Some at the walls, some in the room, at any angle; some may touch each other."""
    found: list[Obstacle] = []
    for _ in range(dice.randint(2 * MOST_PIECES // 3, MOST_PIECES)):
        x, y = dice.uniform(0.3, length - 0.3), dice.uniform(0.3, width - 0.3)
        if dice.random() < 0.35:
            found.append(Circle(x, y, dice.choice(ROUNDS)))
        else:
            heading = dice.choice((0.0, 0.0, math.pi / 2, math.pi / 2, dice.uniform(0, math.pi)))
            found.append(Box(x, y, *dice.choice(PIECES), heading))
    return found


def _start_and_goal(
    dice: random.Random, room: Room, length: float, width: float
) -> tuple[Point, Point] | None:
    """Two free places far apart with a way between them."""
    margin = ROBOT + PASSAGE + 0.1
    for _ in range(20):
        start = _free_place(dice, room, length, width, margin)
        goal = _free_place(dice, room, length, width, margin)
        if math.dist(start, goal) > 0.55 * length:
            return (start, goal) if _is_reachable(room, start, goal, length, width) else None
    return None


def _is_reachable(room: Room, start: Point, goal: Point, length: float, width: float) -> bool:
    """Whether a grid of free cells leads from one to the other."""
    columns, rows = math.ceil(length / CELL), math.ceil(width / CELL)
    seen = {_cell(start)}
    edge = [_cell(start)]
    while edge:
        cell = edge.pop()
        if cell == _cell(goal):
            return True
        for column, row in _neighbors(cell):
            if not (0 <= column < columns and 0 <= row < rows) or (column, row) in seen:
                continue
            seen.add((column, row))
            if _is_open(room, (column + 0.5) * CELL, (row + 0.5) * CELL, ROBOT + PASSAGE):
                edge.append((column, row))
    return False


def _cell(point: Point) -> tuple[int, int]:
    return int(point[0] / CELL), int(point[1] / CELL)


def _neighbors(cell: tuple[int, int]) -> Iterator[tuple[int, int]]:
    column, row = cell
    for right, up in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        yield column + right, row + up


def _free_place(
    dice: random.Random, room: Room, length: float, width: float, margin: float
) -> Point:
    """A place with this much room around it, or else the least crowded of many."""
    tries: list[Point] = []
    for _ in range(_TRIES):
        tries.append((dice.uniform(0, length), dice.uniform(0, width)))
        if _is_open(room, *tries[-1], margin):
            return tries[-1]
    return max(tries, key=lambda point: room.clearance(*point))


def _is_open(room: Room, x: float, y: float, margin: float) -> bool:
    """Whether a point keeps its distance and lies in no box."""
    return room.clearance(x, y) > margin and not any(
        _is_inside(box, x, y) for box in room.obstacles if isinstance(box, Box)
    )


def _is_inside(box: Box, x: float, y: float) -> bool:
    cos, sin = math.cos(box.heading), math.sin(box.heading)
    u, v = cos * (x - box.x) + sin * (y - box.y), cos * (y - box.y) - sin * (x - box.x)
    return abs(u) < box.length / 2 and abs(v) < box.width / 2


def _is_clear(room: Room, start: Point, goal: Point, margin: float) -> bool:
    """Whether someone can walk straight from one place to the other."""
    count = max(1, math.ceil(math.dist(start, goal) / CELL))
    parts = (number / count for number in range(count + 1))
    return all(
        room.clearance(start[0] + (goal[0] - start[0]) * p, start[1] + (goal[1] - start[1]) * p)
        > margin
        for p in parts
    )


def _told(obstacle: Obstacle) -> list[str]:
    """An obstacle as a table of a world file."""
    match obstacle:
        case Wall(x1, y1, x2, y2):
            ends = f"from = [{x1:.3f}, {y1:.3f}]", f"to = [{x2:.3f}, {y2:.3f}]"
            return ["[[wall]]", *ends]
        case Circle(x, y, radius):
            return ["[[circle]]", f"center = [{x:.3f}, {y:.3f}]", f"radius = {radius}"]
        case Box(x, y, length, width, heading):
            size = f"length = {length}", f"width = {width}", f"heading = {heading:.4f}"
            return ["[[box]]", f"center = [{x:.3f}, {y:.3f}]", *size]
