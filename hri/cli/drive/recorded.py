"""Reads a recorded run, or drives one through a seeded room, to draw it. A run is a file of JSON
lines. The first describes the place: `world` (the text of a world file), `goal`, `radius`, `title`;
each of the others a moment: `t`, `robot` [x, y, heading], `people` [[x, y]], `seen` [[x, y]], all
in meters and radians in the room. From a robot's recording (`hri run --record`) the events named
`odometry` are read.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from hri.cli.drive.plan import Moment, Point, Run
from hri.core.errors import HriError
from hri.core.event_log import LARGEST_LOG, LONGEST_LINE
from hri.core.reading import parse_json, read_lines
from hri.core.recorded import EVENTS
from hri.core.signals import Pose2D
from hri.simulation.navigation_trips import Journey
from hri.simulation.seeded_rooms import furnished
from hri.simulation.world_file import load_layout

MOST_ROOMS = 100_000
FARTHEST = 1e4
"""Meters from the origin; farther positions are errors."""
MOST_RADIUS = 10.0
"""Meters of a robot."""
LONGEST_S = 86_400.0
"""Longest run, seconds."""
UNREADABLE = KeyError, TypeError, ValueError, IndexError, OverflowError
"""Exceptions that a malformed line may raise."""


def read_run(name: str, policy: str) -> Run:
    """The run of a file or folder, or one through the room of that number. Raises HriError."""
    if name.isdecimal():
        return _driven(int(name), policy)
    path = Path(name)
    if path.is_dir():
        path = path / EVENTS
    lines = list(_lines(path))
    is_recording = any("event" in line for line in lines[:1])
    run = _of_events(path, lines) if is_recording else _of_moments(path, lines)
    if not run.moments:
        raise HriError(f"{path}: the robot did not move in it - record a run with an Hri.Odometry")
    _check_times(path, run.moments)
    return run


def _driven(number: int, policy: str) -> Run:
    if number > MOST_ROOMS:
        raise HriError(f"room {number} - give a number up to {MOST_ROOMS}")
    room = furnished(number)
    trip = Journey(room, policy, keeps_track=True).run()
    title = f"room {number}, {policy}: {'there' if trip.is_there else 'not there'}"
    moments = tuple(_moment(line) for line in trip.track)
    return Run(moments, room.obstacles, room.goal, title=title)


def _lines(path: Path) -> Iterator[Mapping[str, Any]]:
    what = "run, or number of a room"
    # A last line may have been cut off, also in the middle of a letter.
    with read_lines(path, what, LARGEST_LOG, LONGEST_LINE, errors="surrogateescape") as rows:
        for number, row in enumerate(rows, 1):
            try:
                line = parse_json(row)
            except ValueError as error:
                if number > 1 and not row.endswith("\n"):
                    return
                why = f"not JSON: {error} - give a file of a run"
                raise HriError(f"{path}:{number}: {why}") from error
            if not isinstance(line, dict):
                raise HriError(f"{path}:{number}: not a JSON object - give a file of a run")
            yield line


def _of_events(path: Path, lines: list[Mapping[str, Any]]) -> Run:
    moments = []
    for number, line in enumerate(lines, 1):
        if line.get("event") != "odometry":
            continue
        try:
            x, y = float(line["x_cm"]) / 100, float(line["y_cm"]) / 100
            moments.append(_at(line["t"], (x, y, line["heading_rad"])))
        except UNREADABLE as error:
            raise HriError(f"{path}:{number}: bad pose: {error} - record it again") from error
    return Run(tuple(moments), title=path.parent.name)


def _of_moments(path: Path, lines: list[Mapping[str, Any]]) -> Run:
    if not lines:
        raise HriError(f"{path}: empty - give a file of a run")
    first, moments = lines[0], []
    for number, line in enumerate(lines[1:], 2):
        try:
            moments.append(_moment(line))
        except UNREADABLE as error:
            raise HriError(f"{path}:{number}: bad moment: {error} - record it again") from error
    goal = first.get("goal")
    try:
        obstacles = _obstacles(path, str(first["world"])) if first.get("world") else ()
        place = None if goal is None else _points([goal])[0]
        radius = float(first.get("radius", 0.2))
        if not 0 < radius <= MOST_RADIUS:
            raise ValueError(f"a radius of {radius} m")
    except UNREADABLE as error:
        raise HriError(f"{path}:1: bad description: {error} - record it again") from error
    return Run(tuple(moments), obstacles, place, radius, str(first.get("title", "")))


def _obstacles(run: Path, text: str) -> tuple[Any, ...]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.toml"
        path.write_text(text, encoding="utf-8")
        try:
            return load_layout(path).room.obstacles
        except HriError as error:
            where = str(error).removeprefix(f"{folder}/")
            raise HriError(f"{run}:1: in its world: {where}") from error


def _moment(line: Mapping[str, Any]) -> Moment:
    people, seen = (_points(line.get(name, ())) for name in ("people", "seen"))
    return _at(line["t"], line["robot"], people, seen)


def _at(
    time: Any, robot: Any, people: tuple[Point, ...] = (), seen: tuple[Point, ...] = ()
) -> Moment:
    x, y, heading = (float(value) for value in robot)
    _points([(x, y)])
    if not (math.isfinite(float(time)) and math.isfinite(heading)):
        raise ValueError("a number is not finite")
    return Moment(float(time), Pose2D(x, y, heading), people, seen)


def _check_times(path: Path, moments: Sequence[Moment]) -> None:
    """Raises HriError unless times increase, and end in time."""
    times = [moment.time for moment in moments]
    if any(after < before for before, after in pairwise(times)):
        raise HriError(f"{path}: its moments are not in order of time - sort its lines by t")
    if times[-1] - times[0] > LONGEST_S:
        raise HriError(f"{path}: longer than {LONGEST_S / 3600:g} hours - give a shorter run")


def _points(values: Any) -> tuple[Point, ...]:
    points = tuple((float(value[0]), float(value[1])) for value in values)
    if not all(abs(x) < FARTHEST and abs(y) < FARTHEST for x, y in points):
        raise ValueError("a point too far away")
    return points
