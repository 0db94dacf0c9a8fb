"""The simulated world: a room, a base in it, people, what sounds, and a battery.

It is a bus of the configuration; the simulated devices sit on it. Its parameters are `file` (a
world of `config/worlds`), `seed`, `battery` (0 to 1 at the start) and `voice`, the id of the
synthesizer that speaks for the people (by default the world has its own).
"""

from __future__ import annotations

import math
import os
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from hri.core import registry
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.geometry import seen_from
from hri.core.signals import Pose2D, Twist
from hri.hal.resource import Description, Resource
from hri.hal.synthesizer import Synthesizer
from hri.simulation.acoustics import Sound
from hri.simulation.axle import Axle
from hri.simulation.base import Base, HardwareLimits
from hri.simulation.beams import Beams
from hri.simulation.object_visibility import Sighting, seen
from hri.simulation.people.person import RADIUS, SimulatedPerson, Spoken
from hri.simulation.room import Circle, Room
from hri.simulation.world_file import Item, PersonStart, WorldLayout, find_layout, load_layout

PRESS_TIME = 0.3
"""Seconds for which someone presses a button."""
BUMP_TIME = 0.3
"""Seconds that someone who pushes against the base presses the bumper."""
_NEAREST = 1.0
"""Meters; someone who is nearer speaks more softly, so the voice gets no louder."""
MOST_ITEMS = 100
"""Objects, and obstacles, that can be put into the room."""
OBSTACLE = 0.15
"""Meters; radius of an obstacle that is put into the room."""
BATTERY_LIFE = 4 * 3600.0
"""Seconds a full battery lasts when the robot only listens."""
BATTERY_RANGE = 3000.0
"""Meters the wheels turn on a full battery."""


@dataclass(frozen=True, slots=True)
class Charge:
    """The charge of the battery at a moment, from which later charges follow."""

    level: float
    """0 (empty) to 1 (full)."""
    time: float = 0.0
    """Seconds."""
    way: float = 0.0
    """Meters the wheels had turned by then."""

    def level_at(self, time: float, way: float) -> float:
        """0 to 1, after standing and driving until then."""
        used = (time - self.time) / BATTERY_LIFE + (way - self.way) / BATTERY_RANGE
        return min(1.0, max(0.0, self.level - used))


class SimulatedWorld(Resource):
    """All that the simulated devices measure and move."""

    parameters: ClassVar[tuple[str, ...]] = ("file", "seed", "battery", "voice")

    room: Room
    base: Base
    axle: Axle
    people: tuple[SimulatedPerson, ...]
    """The camera follows the first; none in a bare room."""
    sound: Sound
    beams: Beams
    _items: dict[str, Item]
    _obstacles: dict[str, Circle]
    """Another thread may look at both: they are replaced, never changed."""

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        _layout(description)
        _start_level(description)
        description.number("seed", 0)

    def describe(self) -> str:
        return f"simulated world {self.description.text('file', 'home')}"

    def seed_for(self, name: str) -> int:
        """A separate seed for each user of randomness."""
        seed = round(self.description.number("seed", 0))
        return zlib.crc32(f"{seed}/{name}".encode())

    def advance(self, now: float) -> None:
        """Let the world go on until `now`; a time that has passed does nothing."""
        with self._lock:
            self.base.advance(now)

    def command(self, twist: Twist, now: float) -> None:
        """What the drive asks of the base."""
        with self._lock:
            self.base.command(twist, now)

    def brake(self, now: float) -> None:
        """Stop the base as fast as it can."""
        with self._lock:
            self.base.brake(now)

    def roll_wheel(self, y: float, velocity: float, now: float) -> None:
        """What a motor asks of its wheel, meters to the left, m/s."""
        with self._lock:
            self.axle.roll(y, velocity, now)

    def brake_wheel(self, y: float, now: float) -> None:
        """Stop one wheel as fast as the base can."""
        with self._lock:
            self.axle.brake(y, now)

    def rolled(self, y: float, now: float) -> float:
        """Meters that a wheel has rolled ahead."""
        self.advance(now)
        return self.axle.rolled(y)

    def wheel_velocity(self, y: float, now: float) -> float:
        """Velocity of a wheel's rim, m/s."""
        self.advance(now)
        return self.axle.velocity(y)

    def hold(self, holder: str, is_on: bool) -> None:
        """Switch the power with which a drive holds the base in its place."""
        if is_on:
            self._holders.add(holder)
        else:
            self._holders.discard(holder)

    @property
    def is_held(self) -> bool:
        """Whether the motors keep the base from being rolled by hand."""
        return bool(self._holders) or self.axle.is_held

    def push(self, way: float, now: float) -> None:
        """Let someone roll the base by hand, meters ahead; one that is held stays."""
        with self._lock:
            if not self.is_held:
                self.base.push(way, now)

    def is_drop(self, x: float, y: float) -> bool:
        """Whether there is no floor at a point of the room."""
        return any(math.dist((x, y), (drop.x, drop.y)) < drop.radius for drop in self._drops)

    @property
    def person(self) -> SimulatedPerson:
        """The first of the people. Raises HriError in a world without any."""
        if not self.people:
            raise HriError(
                "nobody is in this world - add [person] with at = [1.2, 0.6] to its file"
            )
        return self.people[0]

    def find_person(self, name: str) -> SimulatedPerson:
        """The person of this name; without a name, the first. Raises HriError when there is
        none.
        """
        if not name:
            return self.person
        found = next((person for person in self.people if person.name == name), None)
        if found is None:
            names = [person.name for person in self.people if person.name]
            remedy = did_you_mean(name, names, "give someone this name in [[person]]")
            raise HriError(f'nobody in this world is named "{name}" - {remedy}')
        return found

    def say(self, text: str, at: float, person: SimulatedPerson | None = None) -> Spoken | None:
        """Let a person speak, or the first; it gets quieter with the distance to the robot."""
        speaker = person or self.person
        spoken = speaker.say(text, at)
        if spoken is not None:
            gain = 1.0 / max(_NEAREST, self.distance_to(speaker, at))
            self.sound.add(spoken.speech.samples, spoken.speech.rate, spoken.start, gain)
        return spoken

    def bump(self, at: float) -> None:
        """Let someone push against the base."""
        self._bumps.append(at)

    def is_bumped(self, now: float) -> bool:
        """Whether something, or someone, presses the bumper."""
        self.advance(now)
        is_pushed = any(at <= now < at + BUMP_TIME for at in self._bumps)
        return is_pushed or self.base.is_touching

    def press(self, button: str, at: float, seconds: float = PRESS_TIME) -> None:
        """Let someone hold the button of that id down for some seconds."""
        self._presses.append((button, at, at + seconds))

    def is_button_pressed(self, button: str, now: float) -> bool:
        """Whether someone presses the button of that id."""
        return any(id == button and start <= now < end for id, start, end in self._presses)

    def battery_level(self, now: float) -> float:
        """0 (empty) to 1 (full)."""
        self.advance(now)
        return self._charge.level_at(now, self.base.way)

    def set_battery(self, level: float, now: float) -> None:
        """Replace the battery by one that holds this much, 0 to 1. Raises HriError for others."""
        if not 0.0 <= level <= 1.0:
            raise HriError(f"the battery's level is {level:g} - give a number from 0 to 1")
        self.advance(now)
        self._charge = Charge(level, now, self.base.way)

    def distance_to(self, person: SimulatedPerson, now: float) -> float:
        """Meters from the middle of the robot."""
        return math.hypot(*seen_from(self.base.pose, *person.place(now)))

    def bearing_of(self, person: SimulatedPerson, now: float) -> float:
        """Radians from the robot's straight ahead to the left."""
        ahead, left = seen_from(self.base.pose, *person.place(now))
        return math.atan2(left, ahead)

    def stand_at(self, person: SimulatedPerson, distance: float, now: float) -> None:
        """Let someone walk straight until they are at a distance from the robot, meters."""
        (x, y), pose = person.place(now), self.base.pose
        part = distance / max(self.distance_to(person, now), RADIUS)
        person.go(pose.x + (x - pose.x) * part, pose.y + (y - pose.y) * part, now)

    def beam_length(self, number: int, now: float) -> float:
        """How far a beam of `beams` gets; infinity for never."""
        self.advance(now)
        return self.beams.length(number, self._room_at(now), self.base.pose)

    def place(self, name: str, x: float, y: float, color: str = "") -> None:
        """Put an object somewhere in the room, in meters; one of that name moves there.

        A new one has a label with its name, or is a ball with a color of `world_file.COLORS`.
        Raises HriError when there are too many.
        """
        _refuse_crowd(self._items, name)
        known = self._items.get(name, Item(name, x, y, color=color))
        self._items = {**self._items, name: replace(known, x=x, y=y)}

    def put_obstacle(self, name: str, x: float, y: float, now: float) -> None:
        """Put something round of radius `OBSTACLE` somewhere in the room, in meters; one of that
        name moves there. Raises HriError where the robot stands, or when there are too many.
        """
        _refuse_crowd(self._obstacles, name)
        self.advance(now)
        pose, least = self.base.pose, self.base.limits.radius + OBSTACLE
        if math.dist((pose.x, pose.y), (x, y)) <= least:
            raise HriError(f"the robot stands there - choose a place {least:.1f} m away from it")
        self._obstacles = {**self._obstacles, name: Circle(x, y, OBSTACLE)}

    @property
    def obstacles(self) -> Mapping[str, Circle]:
        """What was put into the room, by name."""
        return self._obstacles

    def take_away(self, name: str) -> None:
        """Take an object, or an obstacle that was put there, out of the room. Raises HriError."""
        names = [*self._obstacles, *self._items]
        if name not in names:
            raise HriError(f'nothing here is called "{name}" - {did_you_mean(name, names)}')
        self._obstacles = {key: one for key, one in self._obstacles.items() if key != name}
        self._items = {key: one for key, one in self._items.items() if key != name}

    @property
    def items(self) -> tuple[Item, ...]:
        """The objects in the room."""
        return tuple(self._items.values())

    def seen_items(self, pan: float, field_of_view: float, now: float) -> list[Sighting]:
        """The objects that a camera sees that is turned to the left in the middle of the base."""
        if not self._items:
            return []
        self.advance(now)
        pose = self.base.pose
        camera = Pose2D(pose.x, pose.y, pose.heading + pan)
        return seen(self._items.values(), self._room_at(now), camera, field_of_view)

    def release(self) -> None:
        """Does nothing: the world goes on until the manager closes."""

    def _open(self) -> None:
        layout = _layout(self.description)
        robot = layout.robot
        self._voices: list[Synthesizer] = []
        self.people = tuple(self._person(start) for start in layout.people)
        self.room = layout.room
        self._items = {item.name: item for item in layout.items}
        self._obstacles = {}
        self._peopled: tuple[tuple[Circle, ...], Room] = ((), self.room)
        limits = HardwareLimits(radius=robot.radius)
        self.base = Base(self._clearance, robot.pose, limits, robot.slip, self.seed_for("slip"))
        self.axle = Axle(self.base)
        self.beams = Beams()
        self._drops = layout.drops
        self._holders: set[str] = set()
        self.sound = Sound(self.seed_for("noise"), layout.noise_db)
        self._charge = Charge(_start_level(self.description))
        self._bumps: list[float] = []
        self._presses: list[tuple[str, float, float]] = []
        """Button, when it begins, when it ends."""

    def _clearance(self, x: float, y: float, time: float) -> float:
        return self._room_at(time).clearance(x, y)

    def _room_at(self, time: float) -> Room:
        people = [
            Circle(round(x, 2), round(y, 2), RADIUS)
            for person in self.people
            if person.is_present(time)
            for x, y in [person.place(time)]
        ]
        there = (*people, *self._obstacles.values())
        # The same room for the same places: what was cast in it is not cast again.
        if there != self._peopled[0]:
            self._peopled = there, self.room.with_more(there)
        return self._peopled[1]

    def _close(self) -> None:
        for voice in self._voices:
            voice.deactivate()

    def _person(self, start: PersonStart) -> SimulatedPerson:
        seed = self.seed_for(f"person {start.name}" if start.name else "person")
        voice = self._person_voice(start)
        return SimulatedPerson(start.x, start.y, voice, seed, name=start.name, actor=start.actor)

    def _person_voice(self, start: PersonStart) -> Synthesizer | None:
        """A person's voice; None (a person who cannot speak) without the library."""
        if chosen := self.description.text("voice"):
            return self.manager.obtain(chosen, Synthesizer)
        own = Description(
            "_".join(part for part in (self.id, start.name, "voice") if part),
            "Hri.EspeakVoice",
            {"voice": start.voice, "rate_wpm": str(start.words_per_minute)},
            places={"voice": start.voice_place},
        )
        try:
            voice: Synthesizer = registry.find("hri.resources", own.type)(own, self.manager)
            voice.activate()
        except NotAvailable:
            return None
        self._voices.append(voice)
        return voice


def _layout(description: Description) -> WorldLayout:
    """The layout the parameters ask for: a file beside the configuration, or a name.

    Raises AuthoringError, also for an unknown name.
    """
    name = description.text("file", "home")
    beside = description.place.path.parent / name
    try:
        path = beside if os.path.isfile(beside) else find_layout(name)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise description.error("file", what, remedy) from error
    return load_layout(path)


def _refuse_crowd(there: Mapping[str, object], name: str) -> None:
    if name not in there and len(there) >= MOST_ITEMS:
        raise HriError(f"{MOST_ITEMS} such things are in the room - take one away first")


def _start_level(description: Description) -> float:
    level = description.number("battery", 1.0)
    if not 0.0 <= level <= 1.0:
        raise description.error("battery", f"battery is {level:g}", "write a number from 0 to 1")
    return level
