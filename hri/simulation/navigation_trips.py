"""Trips through seeded rooms: the real networks on the simulated robot, in fake time."""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.geometry import placed, seen_from
from hri.core.signals import Pose2D
from hri.drive.goal_behaviors import PEOPLE
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.shape import Shape
from hri.simulation.collisions import CONTACT, MOVING, Collision, Witness, hit_by
from hri.simulation.people.person import RADIUS as PERSON
from hri.simulation.seeded_rooms import ROBOT, Crowd, Furnished, Point
from hri.simulation.simulated_tracker import Lookout
from hri.simulation.world import SimulatedWorld

POLICIES = {
    "none": "go_straight",
    "StopCrash only": "go_stop_crash",
    "full": "go",
}
"""Networks of `config/networks` by the name of the policy."""
DEFAULT_POLICY = "full"
SENSORS: Mapping[str, Mapping[str, tuple[float, float, float]]] = {
    "three sensors": {
        "range_front": (18, 0, 0),
        "range_left": (13, 13, math.pi / 4),
        "range_right": (13, -13, -math.pi / 4),
    },
    "nine sensors": {
        f"range_{number}": (
            18 * math.cos(math.radians(degrees)),
            18 * math.sin(math.radians(degrees)),
            math.radians(degrees),
        )
        for number, degrees in enumerate((0, 20, -20, 45, -45, 75, -75, 110, -110))
    },
}
"""Robots by their range sensors: x and y in cm, yaw, as in a configuration."""
BODY = Shape(lx=0.36, ly=0.36, lz=0.6)
"""The box of `resource-config.xml`."""
GOAL = "drive.goal"
"""The board slot that the networks take their goal from."""
TICK = 0.05
LONGEST_S = 180.0
GIVES_UP_S = 30.0
"""Seconds in which a robot that gets nowhere, or touches something all the time, gives up."""


@dataclass
class Trip:
    """What happened on the way to one goal; meters and seconds."""

    seed: int
    policy: str
    robot: str
    is_there: bool = False
    time: float = 0.0
    way: float = 0.0
    hits: int = 0
    """Times it drove into a thing."""
    collisions: list[Collision] = field(default_factory=list)
    """Touches between it and people, by time."""
    person_gap: float = math.inf
    """Smallest distance between the robot's body and a person's."""
    person_gap_moving: float = math.inf
    """The same while the robot moved."""
    person_gap_approached: float = math.inf
    """The same to those whom the camera saw, while the robot drove nearer to them without braking:
    who comes into the picture all of a sudden may be nearer than it likes already."""
    track: list[dict[str, Any]] = field(default_factory=list)

    def write(self, path: Path, room: Furnished) -> None:
        """Write the run as a file for `hri drive replay`."""
        title = f"room {self.seed}, {self.policy}, {self.robot}"
        first = {"world": room.text, "goal": room.goal, "radius": ROBOT, "title": title}
        lines = [json.dumps(line) for line in (first, *self.track)]
        path.write_text("\n".join([*lines, ""]), encoding="utf-8")

    @property
    def people_hit(self) -> int:
        """Times it touched someone while it moved."""
        return sum(collision.is_moving for collision in self.collisions)

    @property
    def people_met(self) -> int:
        """Times someone touched it while it stood."""
        return len(self.collisions) - self.people_hit

    @property
    def is_clean(self) -> bool:
        """Whether it got there without driving into anything or anyone."""
        return self.is_there and self.hits == self.people_hit == 0


class Journey:
    """One trip, tick by tick."""

    def __init__(
        self,
        room: Furnished,
        policy: str,
        robot: str = "three sensors",
        *,
        heedful: bool = True,
        sees: bool = False,
        keeps_track: bool = False,
    ) -> None:
        """`heedful`: people look where they go; `sees`: the robot has a camera that sees people."""
        self.trip = Trip(room.seed, policy, robot)
        self.room = room
        self._keeps_track = keeps_track
        self._sensors = SENSORS[robot]
        self._clock = FakeClock()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "room.toml"
            path.write_text(room.text, encoding="utf-8")
            simulated = devices(path, room.seed, SENSORS[robot])
            self._resources = ResourceManager(simulated, self._clock, shapes=[BODY])
            self.world = self._resources.obtain("world", SimulatedWorld)
        self._crowd = Crowd(room, self.world, heedful=heedful)
        self._lookout = Lookout(self.world, room.seed) if sees else None
        context = Context(self._clock, EventBus(self._clock), self._resources, seed=room.seed)
        start = self.world.base.pose
        goal = Pose2D(*seen_from(start, *room.goal))
        context.board.slot(GOAL).set(goal, 0.0)
        self._people = context.board.slot(PEOPLE)
        network = load_network(paths.find("config/networks", f"{POLICIES[policy]}.xml"))
        self._runner = Runner(network, context)
        self._witness = Witness(ROBOT)
        self.trip.collisions = self._witness.collisions
        self._touches_thing = False
        self._spot, self._moved_at = start, 0.0

    def run(self, longest: float = LONGEST_S) -> Trip:
        """The trip, until arrival, giving up, or a time limit in seconds."""
        trip = self.trip
        self._runner.start()
        try:
            while not self._is_over(longest):
                self._clock.advance(TICK)
                self._tick(self._clock.now())
        finally:
            self._runner.stop()
            self._resources.close()
        trip.time = self._clock.now()
        return trip

    def _tick(self, now: float) -> None:
        before = self.world.base.pose
        before_velocity = self.world.base.velocity.linear
        before_speed = abs(before_velocity)
        if round(now / TICK) % 2 == 0:
            self._crowd.step(now)
        if self._lookout is not None and (people := self._lookout.look(now)) is not None:
            self._people.set(people, now)
        self._testify(now, before)
        self._runner.tick(now)
        self.world.advance(now)
        after = self.world.base.pose
        self.trip.way += math.hypot(after.x - before.x, after.y - before.y)
        after_speed = abs(self.world.base.velocity.linear)
        self._judge(now, after, max(before_velocity, self.world.base.velocity.linear, key=abs))
        if after_speed >= before_speed:
            self._judge_approach(now, before, after)
        if math.hypot(after.x - self._spot.x, after.y - self._spot.y) > 0.2:
            self._spot, self._moved_at = after, now
        if self._keeps_track:
            self._note(now, after)

    def _is_over(self, longest: float) -> bool:
        now, pose = self._clock.now(), self.world.base.pose
        stands = abs(self.world.base.velocity.linear) < MOVING
        self.trip.is_there = stands and math.dist((pose.x, pose.y), self.room.goal) < 0.25
        return self.trip.is_there or now > longest or now - self._moved_at > GIVES_UP_S

    def _judge(self, now: float, pose: Pose2D, speed: float) -> None:
        trip, places = self.trip, [person.place(now) for person in self.world.people]
        gap = min(math.dist((pose.x, pose.y), place) for place in places) - ROBOT - PERSON
        trip.person_gap = min(trip.person_gap, gap)
        if abs(speed) > MOVING:
            trip.person_gap_moving = min(trip.person_gap_moving, gap)
        self._witness.watch(now, pose, speed, places)
        clearance = self.room.room.clearance(pose.x, pose.y) - ROBOT
        touches = clearance < CONTACT if not self._touches_thing else clearance < 3 * CONTACT
        trip.hits += touches and not self._touches_thing
        self._touches_thing = touches

    def _testify(self, now: float, pose: Pose2D) -> None:
        """Note which people each sensor covers now."""
        places = [person.place(now) for person in self.world.people]
        for sensor, people in hit_by(dict(self._ends(now, pose)), places).items():
            self._witness.see(now, sensor, people)
        if self._lookout is not None:
            self._witness.see(now, "camera", sorted(self._lookout.covered))

    def _judge_approach(self, now: float, before: Pose2D, after: Pose2D) -> None:
        for number in self._lookout.in_sight if self._lookout is not None else ():
            place = self.world.people[number].place(now)
            far, near = (math.dist((pose.x, pose.y), place) for pose in (before, after))
            if far - near > MOVING * TICK:
                gap = near - ROBOT - PERSON
                self.trip.person_gap_approached = min(self.trip.person_gap_approached, gap)

    def _note(self, now: float, pose: Pose2D) -> None:
        people = [person.place(now) for person in self.world.people if person.is_present(now)]
        told = {
            "t": round(now, 2),
            "robot": _rounded((pose.x, pose.y, pose.heading)),
            "people": [_rounded(place) for place in people],
            "seen": [_rounded(point) for _, point in self._ends(now, pose)],
        }
        self.trip.track.append(told)

    def _ends(self, now: float, pose: Pose2D) -> Iterator[tuple[str, Point]]:
        """Where the beams end that hit something, by the ids of the sensors."""
        for id in self._sensors:
            sensor = self._resources.obtain(id, RangeSensor)
            distance = sensor.read(now).distance
            self._resources.release(sensor)
            if math.isfinite(distance):
                mount = self._resources.pose_of(id)
                way = (
                    mount.x + distance * math.cos(mount.yaw),
                    mount.y + distance * math.sin(mount.yaw),
                )
                yield id, placed(pose, *way)


def _rounded(values: Sequence[float]) -> list[float]:
    return [round(value, 3) for value in values]


def devices(
    world: Path, seed: int, sensors: Mapping[str, tuple[float, float, float]]
) -> list[Description]:
    """A simulated robot in the world of a file; the sensors are as in SENSORS."""
    simulated = {"file": str(world), "seed": str(seed), "voice": "silent_voice"}
    return [
        Description("silent_voice", "Hri.SilentVoice"),
        Description("world", "Hri.SimulatedWorld", simulated),
        Description("drive", "Hri.SimulatedDrive", bus="world"),
        Description("odometry", "Hri.SimulatedOdometry", bus="world"),
        Description("bumper", "Hri.SimulatedBumper", bus="world"),
        *(
            Description(
                id,
                "Hri.SimulatedRangeSensor",
                {"x": f"{x:.3f}", "y": f"{y:.3f}", "yaw": f"{yaw:.5f}"},
                bus="world",
            )
            for id, (x, y, yaw) in sensors.items()
        ),
    ]
