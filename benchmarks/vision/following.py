"""Following someone from behind: trips through a simulated room with passers-by.

    python -m benchmarks.vision.following [--trips 50] [--first 0]

Everyone is drawn, and seen by the detectors of a robot: a camera of 640x480 pixels that looks
ahead, at the height of the eyes. The guide faces the robot for a moment, turns around, and walks 20
m without ever looking back. Passers-by walk through between the two, and beside the guide, in
clothes that were drawn by lot as those of the guide. What is drawn has no folds and no shadows, and
a room without things that are as colorful as clothes: this does not prove how it goes outside.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from benchmarks.progress import progress
from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.bench.table import Row, at_least, share
from hri.bench.threads import one_thread
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event, People, Person
from hri.drive.goal_behaviors import PEOPLE
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.navigation_trips import BODY, SENSORS, devices
from hri.simulation.people.actors import ACTORS
from hri.simulation.people.appearance import Outfit
from hri.simulation.people.person import SimulatedPerson
from hri.simulation.world import SimulatedWorld
from hri.vision.face_models import find_face_models

SEED = 610_000
TRIPS, QUICK_TRIPS = 50, 2
ARRIVE = 0.95
"""Share of the trips that must end with the right person."""
WAY = 20.0
"""Meters that the guide walks."""
LEGS = (3.0, 6.0)
"""Meters from one turn to the next."""
TURN = 1.4
"""Radians to each side that they turn: nobody walks back through the robot."""
LENGTH, WIDTH, EDGE = 14.0, 10.0, 1.8
"""Of the room, and how near the guide comes to its walls; meters."""
SPEED = (0.22, 0.28)
"""Meters a second of the guide: the robot does 0.3."""
PASSING = (0.7, 1.2)
"""The same of a passer-by."""
ACROSS = 3.0
"""Meters from where a passer-by comes in to where they pass between the two."""
WAITS = (4.0, 9.0)
"""Seconds from one passer-by to the next."""
GREETING = 3.0
"""Seconds in which the guide faces the robot."""
NEAR = 2.5
"""Meters to the guide at the end: arrived."""
AFTER = 6.0
"""Seconds that the robot has to catch up."""
RATE = 15
"""Pictures, and ticks, a second."""
SEEING = """<BehaviorNetwork name="seeing" invocation_interval="1/15">
  <Behavior id="camera" type="Hri.Camera"/>
  <Behavior id="tracker" type="Hri.PersonTracker"/>
  <Link from="camera.raw_image" to="tracker.image"/>
  <Link from="tracker.people" to="board.people"/>
</BehaviorNetwork>
"""
SHIRTS = (
    (176, 48, 44),
    (44, 84, 160),
    (58, 120, 70),
    (222, 196, 92),
    (232, 230, 224),
    (40, 40, 46),
    (120, 74, 130),
    (214, 120, 52),
    (110, 150, 176),
    (140, 112, 84),
    (196, 120, 140),
)
TROUSERS = ((52, 54, 70), (60, 82, 130), (150, 132, 104), (96, 92, 90), (36, 36, 38))
STRIPES = (0.0, 0.0, 0.0, 0.3, 0.5)
PASSERS = 4
AWAY, FLYING = (-70.0, -70.0), 1e6
"""Where passers-by are when they are nowhere near, meters, and how fast they get here, m/s."""


@dataclass
class Verdict:
    """What became of one trip."""

    number: int
    is_there: bool = False
    """Whether the robot was near the guide in the end, and followed them."""
    changes: int = 0
    """Pictures in which whom it followed was seen where someone else was."""
    lost: int = 0
    """Times it said that it had lost the guide."""
    gave_up: bool = False
    seen: int = 0
    """Pictures in which the guide was seen."""
    pictures: int = 0


def rows(quick: bool) -> Iterator[Row]:
    """All trips, on one core."""
    find_face_models()
    yield from _rows(range(QUICK_TRIPS if quick else TRIPS))


def _rows(numbers: range) -> Iterator[Row]:
    with one_thread():
        trips = [judge(n) for n in progress(numbers, len(numbers), "following from behind")]
    told = {
        "changed_to_another": sum(trip.changes > 0 for trip in trips),
        "lost_and_said": sum(trip.gave_up for trip in trips),
        "lost_for_a_moment": sum(trip.lost for trip in trips),
        "seen": round(sum(t.seen for t in trips) / max(1, sum(t.pictures for t in trips)), 3),
    }
    what = f"{WAY:g} m behind someone who never looks back, past others: there with them"
    yield share(what, sum(trip.is_there for trip in trips), len(trips), at_least(ARRIVE)) | told


def judge(number: int) -> Verdict:
    """The trip of a number."""
    return _Trip(number).run()


class _Trip:
    """One guide, some passers-by, and a robot with a camera."""

    def __init__(self, number: int) -> None:
        self._dice = random.Random(SEED + number)
        self._verdict = Verdict(number)
        self._clock = FakeClock()
        self._points = _way(self._dice)
        (x, y), (to_x, to_y) = self._points[:2]
        heading = math.atan2(to_y - y, to_x - x)
        back = x - 1.2 * math.cos(heading), y - 1.2 * math.sin(heading)
        actors = self._dice.sample(list(ACTORS), 1 + PASSERS)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "room.toml"
            path.write_text(_room(back, heading, (x, y), actors), encoding="utf-8")
            eyes = Path(folder) / "seeing.xml"
            eyes.write_text(SEEING, encoding="utf-8")
            seeing = load_network(eyes)
            simulated = devices(path, SEED + number, SENSORS["nine sensors"])
            camera = {"width": "640", "height": "480", "rate": str(RATE), "field_of_view": "1.05"}
            simulated.append(Description("camera", "Hri.SimulatedCamera", camera, bus="world"))
            self._resources = ResourceManager(simulated, self._clock, shapes=[BODY])
            self._world = self._resources.obtain("world", SimulatedWorld)
        self._guide, *self._others = self._world.people
        for person in self._world.people:
            person.outfit = _outfit(self._dice)
        self._camera = self._resources.obtain("camera", Camera)
        self._camera.look_ahead(True)
        self._events = EventBus(self._clock)
        self._events.subscribe("target.lost", self._lose)
        context = Context(self._clock, self._events, self._resources, seed=SEED + number)
        self._people = context.board.slot(PEOPLE)
        network = load_network(paths.find("config/networks", "follow.xml"))
        self._runners = [Runner(each, context) for each in (seeing, network)]
        self._next_passer = 0.0
        self._busy: dict[int, float] = {}
        self._id = ""
        self._judged = -math.inf

    def run(self) -> Verdict:
        """The trip, until the guide has been there for a while."""
        ends = self._walk()
        for runner in self._runners:
            runner.start()
        try:
            while self._clock.now() < ends + AFTER and not self._verdict.gave_up:
                self._clock.advance(1 / RATE)
                self._tick(self._clock.now(), ends)
        finally:
            for runner in self._runners:
                runner.stop()
            self._camera.look_ahead(False)
            self._resources.close()
        return self._verdict

    def _walk(self) -> float:
        """Let the guide walk their way; when they are there."""
        time, speed = GREETING, self._dice.uniform(*SPEED)
        for x, y in self._points[1:]:
            time = self._guide.go(x, y, time, speed=speed, looks_ahead=True)
        self._next_passer = GREETING + self._dice.uniform(*WAITS)
        return time

    def _tick(self, now: float, ends: float) -> None:
        if now >= self._next_passer and now < ends - 2.0:
            self._next_passer = now + self._dice.uniform(*WAITS)
            self._pass_by(now)
        for runner in self._runners:
            runner.tick(now)
        people = self._people.value
        if isinstance(people, People) and people.time > self._judged:
            self._judged = people.time
            self._judge(people)
        self._world.advance(now)
        pose = self._world.base.pose
        away = math.dist((pose.x, pose.y), self._guide.place(now))
        self._verdict.is_there = away < NEAR and not self._verdict.gave_up

    def _pass_by(self, now: float) -> None:
        """Send someone through between robot and guide, or along beside the guide."""
        free = [n for n in range(len(self._others)) if self._busy.get(n, 0.0) <= now]
        if not free:
            return
        number = self._dice.choice(free)
        pose, (x, y) = self._world.base.pose, self._guide.place(now)
        ahead = math.atan2(y - pose.y, x - pose.x)
        side = self._dice.choice((-1, 1))
        speed = self._dice.uniform(*PASSING)
        if self._dice.random() < 0.6:
            part = self._dice.uniform(0.45, 0.65)
            # Between the two when they get there, not where the robot will be by then.
            later = self._guide.place(now + ACROSS / speed)
            walked = later[0] - x, later[1] - y
            middle = (
                pose.x + part * (x - pose.x) + walked[0],
                pose.y + part * (y - pose.y) + walked[1],
            )
            across = ahead + side * math.pi / 2
            start, goal = (_moved(middle, across, far) for far in (-ACROSS, 3.5))
        else:
            beside = _moved((x, y), ahead + side * math.pi / 2, self._dice.uniform(0.7, 1.1))
            start, goal = _moved(beside, ahead, -2.5), _moved(beside, ahead, 5.0)
            speed = self._dice.uniform(0.4, 0.8)
        other = self._others[number]
        other.go(*start, now, speed=FLYING)
        self._busy[number] = other.go(*goal, now + 0.1, speed=speed, looks_ahead=True)
        other.go(*AWAY, self._busy[number], speed=FLYING)

    def _judge(self, people: People) -> None:
        """Whether whom the robot follows is the guide."""
        self._id = self._id or people.attended
        followed, verdict = people.person(self._id), self._verdict
        if followed is not None and not followed.is_visible:
            followed = None
        if people.time >= GREETING:
            verdict.pictures += 1
            verdict.seen += followed is not None
        if followed is None:
            return
        bearings = [self._off(person, followed, people.time) for person in self._world.people]
        if bearings[0] > 0.12 and min(bearings[1:]) < 0.08:
            verdict.changes += 1

    def _off(self, person: SimulatedPerson, seen: Person, time: float) -> float:
        bearing = self._world.bearing_of(person, time)
        return abs(math.remainder(bearing - seen.bearing, math.tau))

    def _lose(self, event: Event) -> None:
        self._verdict.lost += not event.properties["given_up"]
        self._verdict.gave_up |= event.properties["given_up"]


def _outfit(dice: random.Random) -> Outfit:
    return Outfit(dice.choice(SHIRTS), dice.choice(TROUSERS), dice.choice(STRIPES))


def _way(dice: random.Random) -> list[tuple[float, float]]:
    """Where the guide walks: WAY meters with turns, away from the walls."""
    while True:
        points = [(dice.uniform(EDGE, LENGTH - EDGE), dice.uniform(EDGE, WIDTH - EDGE))]
        heading, rest = dice.uniform(-math.pi, math.pi), WAY
        while rest > 0 and _is_inside(points[-1]):
            far = rest if rest < LEGS[1] else dice.uniform(*LEGS)
            points.append(_moved(points[-1], heading, far))
            heading += dice.uniform(-TURN, TURN)
            rest -= far
        if rest <= 0 and _is_inside(points[-1]):
            return points


def _is_inside(point: tuple[float, float]) -> bool:
    return EDGE < point[0] < LENGTH - EDGE and EDGE < point[1] < WIDTH - EDGE


def _moved(point: tuple[float, float], heading: float, far: float) -> tuple[float, float]:
    return point[0] + far * math.cos(heading), point[1] + far * math.sin(heading)


def _room(
    robot: tuple[float, float], heading: float, guide: tuple[float, float], actors: list[str]
) -> str:
    """A world file: an empty room, the robot, the guide before it, and the others outside."""
    places = [guide, *(AWAY for _ in actors[1:])]
    lines = ["[robot]", f"start = [{robot[0]:.3f}, {robot[1]:.3f}]", f"heading = {heading:.4f}"]
    for number, (actor, (x, y)) in enumerate(zip(actors, places, strict=True)):
        lines += ["[[person]]", f'name = "n{number}"', f'actor = "{actor}"']
        lines += [f"at = [{x:.3f}, {y:.3f}]"]
    corners = [(0, 0), (LENGTH, 0), (LENGTH, WIDTH), (0, WIDTH)]
    for (x, y), (to_x, to_y) in zip(corners, [*corners[1:], corners[0]], strict=True):
        lines += ["[[wall]]", f"from = [{x}, {y}]", f"to = [{to_x}, {to_y}]"]
    return "\n".join([*lines, ""])


def main(arguments: list[str] | None = None) -> int:
    """Play trips and print what became of each."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.vision.following")
    parser.add_argument("--trips", type=int, default=TRIPS, help="how many")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    chosen = parser.parse_args(arguments)
    for row in _rows(range(chosen.first, chosen.first + chosen.trips)):
        print(row)
    return 0


if __name__ == "__main__":
    sys.exit(main())
