"""A room seen from above: its obstacles, and the paths of the robot and people."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np

from hri.core.quoting import escaped
from hri.core.signals import Image, Pose2D
from hri.simulation.people.person import RADIUS as PERSON_RADIUS
from hri.simulation.room import Box, Circle, Obstacle, Wall

Point = tuple[float, float]
Color = tuple[int, int, int]

PAPER: Color = (250, 250, 247)
THING: Color = (205, 200, 190)
EDGE: Color = (96, 92, 86)
WAY: Color = (32, 104, 176)
ROBOT: Color = (32, 104, 176)
PERSON: Color = (212, 112, 62)
PERSON_WAY: Color = (237, 204, 187)
GOAL: Color = (44, 138, 84)
SEEN: Color = (176, 48, 72)
INK: Color = (40, 40, 40)
MARGIN = 0.3
"""Margin in meters."""
FINE = 4
"""Fractional bits of OpenCV's pixel coordinates."""
LARGEST = 1400
"""Largest width in pixels."""
ROW, LETTER, SIGN = 24, 9, 26
"""Pixels of a row of the legend, of its widest letter, and of the sign before its words."""
WORDS = cv2.FONT_HERSHEY_SIMPLEX, 0.5, INK, 1, cv2.LINE_AA


@dataclass(frozen=True, slots=True)
class Moment:
    """Where everyone was at a time, seconds; meters and radians in the room."""

    time: float
    robot: Pose2D
    people: tuple[Point, ...] = ()
    seen: tuple[Point, ...] = ()
    """Points that the beams hit."""


@dataclass(frozen=True)
class Run:
    """A recorded run."""

    moments: Sequence[Moment]
    obstacles: Sequence[Obstacle] = ()
    goal: Point | None = None
    radius: float = 0.2
    """Of the robot, meters."""
    title: str = ""


@dataclass
class Plan:
    """The picture of a run; its room is drawn once."""

    run: Run
    _ground: Image = field(init=False)

    def __post_init__(self) -> None:
        left, bottom, right, top = _bounds(self.run)
        self._left, self._top = left, top
        across = max(right - left, top - bottom)
        self._scale = min(140.0, LARGEST / across)
        width, height = (
            math.ceil(way * self._scale / 2) * 2 for way in (right - left, top - bottom)
        )
        self._legend = legend(self.run, width)
        rows = 1 + max((row for _, _, row in self._legend), default=0)
        self._ground = np.empty((height + rows * ROW, width, 3), np.uint8)
        self._ground[:] = PAPER
        for name, x, row in self._legend:
            self._explain(name, x, height + row * ROW + ROW // 2)
        for obstacle in self.run.obstacles:
            self._obstacle(self._ground, obstacle)

    def whole(self) -> Image:
        """The whole run in one picture: paths, seen points, and the final positions."""
        picture = self._ground.copy()
        self._history(picture, self.run.moments)
        return self._titled(picture, self.run.moments[-1].time)

    def at(self, index: int) -> Image:
        """The run so far, at one of its moments."""
        picture = self._ground.copy()
        self._history(picture, self.run.moments[: index + 1])
        return self._titled(picture, self.run.moments[index].time)

    def _history(self, picture: Image, moments: Sequence[Moment]) -> None:
        last = moments[-1]
        for number in range(len(last.people)):
            way = [moment.people[number] for moment in moments if len(moment.people) > number]
            self._line(picture, way, PERSON_WAY, 1)
        for moment in moments:
            for point in moment.seen:
                self._disc(picture, point, 0.012, SEEN)
        self._line(picture, [(m.robot.x, m.robot.y) for m in moments], WAY, 2)
        for person in last.people:
            self._disc(picture, person, PERSON_RADIUS, PERSON)
        first = moments[0].robot
        self._ring(picture, (first.x, first.y), self.run.radius, WAY)
        self._robot(picture, last.robot)
        if self.run.goal is not None:
            self._cross(picture, self.run.goal)

    def _robot(self, picture: Image, pose: Pose2D) -> None:
        radius = self.run.radius
        self._disc(picture, (pose.x, pose.y), radius, ROBOT)
        nose = (pose.x + radius * math.cos(pose.heading), pose.y + radius * math.sin(pose.heading))
        self._line(picture, [(pose.x, pose.y), nose], PAPER, 2)

    def _explain(self, name: str, x: int, y: int) -> None:
        """A sign of the picture, and its meaning."""
        picture, middle = self._ground, (x + SIGN // 2, y)
        match name:
            case "robot" | "person":
                color = ROBOT if name == "robot" else PERSON
                cv2.circle(picture, middle, 7, color, -1, cv2.LINE_AA)
            case "start":
                cv2.circle(picture, middle, 7, WAY, 1, cv2.LINE_AA)
            case "goal":
                for way in (6, -6):
                    start, end = (middle[0] - 6, y - way), (middle[0] + 6, y + way)
                    cv2.line(picture, start, end, GOAL, 2, cv2.LINE_AA)
            case "seen":
                for step in (4, 9, 13, 18, 22):
                    cv2.circle(picture, (x + step, y), 1, SEEN, -1, cv2.LINE_AA)
            case "thing":
                cv2.rectangle(picture, (x + 5, y - 7), (x + 20, y + 7), THING, -1)
                cv2.rectangle(picture, (x + 5, y - 7), (x + 20, y + 7), EDGE, 1)
            case _:
                color, thick = (WAY, 2) if name == "robot's way" else (PERSON_WAY, 1)
                cv2.line(picture, (x + 3, y), (x + SIGN - 4, y), color, thick, cv2.LINE_AA)
        cv2.putText(picture, escaped(MEANING.get(name, name)), (x + SIGN, y + 5), *WORDS)

    def _titled(self, picture: Image, time: float) -> Image:
        text = f"{self.run.title}   {time:.1f} s".strip()
        cv2.putText(picture, escaped(text), (8, 18), *WORDS)
        return picture

    def _obstacle(self, picture: Image, obstacle: Obstacle) -> None:
        match obstacle:
            case Wall(x1, y1, x2, y2):
                self._line(picture, [(x1, y1), (x2, y2)], EDGE, 3)
            case Circle(x, y, radius):
                self._disc(picture, (x, y), radius, THING)
                self._ring(picture, (x, y), radius, EDGE)
            case Box():
                corners = [self._pixels((side.x1, side.y1)) for side in obstacle.sides()]
                outline = [np.array(corners, np.int32)]
                cv2.fillPoly(picture, outline, THING, cv2.LINE_AA, FINE)
                cv2.polylines(picture, outline, True, EDGE, 1, cv2.LINE_AA, FINE)

    def _cross(self, picture: Image, point: Point) -> None:
        x, y = point
        for way in (0.12, -0.12):
            self._line(picture, [(x - 0.12, y - way), (x + 0.12, y + way)], GOAL, 3)

    def _disc(self, picture: Image, point: Point, radius: float, color: Color) -> None:
        size = round(radius * self._scale * 2**FINE)
        cv2.circle(picture, self._pixels(point), size, color, -1, cv2.LINE_AA, FINE)

    def _ring(self, picture: Image, point: Point, radius: float, color: Color) -> None:
        size = round(radius * self._scale * 2**FINE)
        cv2.circle(picture, self._pixels(point), size, color, 1, cv2.LINE_AA, FINE)

    def _line(
        self, picture: Image, points: Sequence[Point], color: Iterable[int], thick: int
    ) -> None:
        pixels = np.array([self._pixels(point) for point in points], np.int32)
        if len(pixels) > 1:
            shade = tuple(color)
            cv2.polylines(picture, [pixels], False, shade, thick, cv2.LINE_AA, FINE)

    def _pixels(self, point: Point) -> tuple[int, int]:
        x, y = (point[0] - self._left) * self._scale, (self._top - point[1]) * self._scale
        return round(x * 2**FINE), round(y * 2**FINE)


MEANING = {"seen": "points its sensors saw"}
"""Signs with another name in the legend."""


def legend(run: Run, width: int) -> list[tuple[str, int, int]]:
    """The legend of a picture with that many columns of pixels: each sign with the pixel at which
    it begins, and its row.
    """
    has_people = any(moment.people for moment in run.moments)
    signs = {
        "robot": True,
        "robot's way": True,
        "start": True,
        "goal": run.goal is not None,
        "person": has_people,
        "person's way": has_people,
        "seen": any(moment.seen for moment in run.moments),
        "thing": any(not isinstance(obstacle, Wall) for obstacle in run.obstacles),
    }
    places, x, row = [], 8, 0
    for name in (name for name, is_shown in signs.items() if is_shown):
        length = SIGN + LETTER * (len(MEANING.get(name, name)) + 1)
        if x + length > width and x > 8:
            x, row = 8, row + 1
        places.append((name, x, row))
        x += length
    return places


def _bounds(run: Run) -> tuple[float, float, float, float]:
    """Left, bottom, right and top of everything shown."""
    points = [(m.robot.x, m.robot.y) for m in run.moments]
    points += [person for m in run.moments for person in m.people]
    points += [run.goal] if run.goal is not None else []
    for obstacle in run.obstacles:
        match obstacle:
            case Wall(x1, y1, x2, y2):
                points += [(x1, y1), (x2, y2)]
            case Circle(x, y, radius):
                points += [(x - radius, y - radius), (x + radius, y + radius)]
            case Box():
                points += [(side.x1, side.y1) for side in obstacle.sides()]
    xs, ys = zip(*points, strict=True)
    room = MARGIN + run.radius
    return min(xs) - room, min(ys) - room, max(xs) + room, max(ys) + room
