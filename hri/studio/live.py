"""What the page shows of a robot that runs: its newest values, its events, its pictures."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from hri.behavior.device_behaviors import CameraFrames
from hri.core.errors import HriError
from hri.core.signals import Event, Frame, Image, People, Person
from hri.emotion.behaviors import EmotionModel
from hri.hal.battery import Battery
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description, Resource
from hri.hal.screen import Screen
from hri.hal.tee import TeeScreen
from hri.robot import Robot
from hri.robot.recording import REJECTED
from hri.simulation.room import Box, Circle, Room, Wall
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener, Voice
from hri.studio.link import RobotEnd
from hri.task.context import TaskContext

API = 1
"""Version of the interface."""
EVERY = 0.1
"""Seconds between two looks at the values."""
RATES = {"face": 22.0, "camera": 10.0}
"""Pictures a second at most."""
MOST_CAUSES = 6
"""Causes of a feeling that are shown."""
FAINT = 0.02
"""An emotion of less than this is not shown."""


class Live:
    """Puts what a robot does into the link."""

    def __init__(self, robot: Robot, link: RobotEnd) -> None:
        self._robot, self._link = robot, link
        self._pictures = _Pictures(link)
        self._topics: Mapping[str, Callable[[TaskContext, float], Any]] = {
            "devices": self._devices,
            "speech": self._speech,
            "feeling": self._feeling,
            "people": self._people,
            "base": self._base,
            "world": self._world,
        }

    def join_screen(self) -> None:
        """Let the page have the face, beside the screen; before the networks start."""
        if "screen" not in self._robot.resources.descriptions:
            return
        resources = self._robot.resources
        screen = resources.obtain("screen", Screen)
        page = _PageScreen(screen, self._pictures)
        tee = TeeScreen(screen, page)
        tee.activate()
        resources.substitute("screen", tee)

    async def watch(self, context: TaskContext) -> None:
        """Look at the robot as long as it lives."""
        self._link.put("about", self._about())
        self._robot.events.subscribe("*", self._tell)
        self._watch_camera(context)
        # One after the other: the loop has other things to do in between.
        for topic, look in itertools.cycle(self._topics.items()):
            self._link.put(topic, look(context, context.clock.now()))
            await context.clock.sleep(EVERY / len(self._topics))

    def _tell(self, event: Event) -> None:
        # Words that were rejected were said to someone else: the page gets them no more than a
        # recording does.
        withheld = REJECTED.get(event.name, ())
        told = {key: value for key, value in event.properties.items() if key not in withheld}
        self._link.add_event({**told, "t": round(event.time, 3), "event": event.name})

    def _watch_camera(self, context: TaskContext) -> None:
        for name, runner in context.networks.runners.items():
            for behavior in runner.network.behaviors:
                if isinstance(behavior, CameraFrames):
                    context.networks.watch(name, behavior.id, "raw_image", self._see)
                    return

    def _see(self, frame: Frame, now: float) -> None:
        self._pictures.put("camera", frame.image, frame.time)

    # --- topics ---

    def _about(self) -> dict[str, Any]:
        world = self._world_of()
        drives = self._robot.resources.ids(EmergencyStop)
        return {
            "api": API,
            "app": self._robot.app.folder.name,
            "about": self._robot.app.about,
            "is_simulated": world is not None,
            "has_base": bool(drives),
        }

    def _devices(self, context: TaskContext, now: float) -> list[dict[str, Any]]:
        resources = context.resources
        opened = {resource.id: resource for resource in resources.opened(Resource)}
        found = []
        for id in resources.descriptions:
            stand_in = resources.stand_in_of(id) or ""
            if (resource := opened.get(stand_in or id)) is not None:
                found.append({"id": id, "says": resource.describe(), "stand_in": stand_in})
        return found

    def _speech(self, context: TaskContext, now: float) -> dict[str, Any]:
        listener, voice = context.find_behavior(Listener), context.find_behavior(Voice)
        return {
            "is_hearing": bool(context.board.slot("hearing").value),
            "is_muted": listener is not None and listener.is_muted,
            "is_speaking": voice is not None and not voice.is_idle,
        }

    def _feeling(self, context: TaskContext, now: float) -> dict[str, Any] | None:
        emotion = context.find_behavior(EmotionModel)
        if emotion is None:
            return None
        state = emotion.feeling()
        return {
            "label": state.label,
            "words": emotion.feeling_words(),
            "why": emotion.why_words(),
            "pleasure": _short(state.valence),
            "arousal": _short(state.arousal),
            "dominance": _short(state.dominance),
            "emotions": {n: _short(v) for n, v in state.emotions.items() if v >= FAINT},
            "drives": {name: _short(value) for name, value in state.drives.items()},
            "causes": [
                {"name": cause.name, "share": _short(cause.share), "person": cause.person or ""}
                for cause in emotion.why()[:MOST_CAUSES]
            ],
        }

    def _people(self, context: TaskContext, now: float) -> dict[str, Any]:
        camera = next(iter(context.resources.opened(Camera)), None)
        seen = context.board.slot("people").value
        people = seen if isinstance(seen, People) else People(now)
        return {
            "is_watching": camera is not None and camera.is_watching,
            "is_on": camera is not None and camera.is_on,
            "persons": [_person(one, people.attended) for one in people.persons if one.is_visible],
        }

    def _base(self, context: TaskContext, now: float) -> dict[str, Any]:
        resources = context.resources
        odometry = next(iter(resources.opened(Odometry)), None)
        battery = next(iter(resources.opened(Battery)), None)
        base = next(iter(resources.opened(EmergencyStop)), None)
        world = self._world_of()
        pose = world.base.pose if world else odometry.pose(now) if odometry else None
        velocity = odometry.velocity(now) if odometry else None
        return {
            "pose": pose and [_short(pose.x), _short(pose.y), _short(pose.heading)],
            "velocity": velocity and [_short(velocity.linear), _short(velocity.angular)],
            "battery": battery and _short(battery.level(now)),
            "is_stopped": base is not None and base.is_latched,
            "why": base.explain() if base is not None else "",
            "ranges": [_range(one, resources.pose_of(one.id), now) for one in _sensors(context)],
        }

    def _world(self, context: TaskContext, now: float) -> dict[str, Any] | None:
        world = self._world_of()
        if world is None:
            return None
        return {
            **_drawn(world.room),
            "people": [
                {
                    "name": person.name,
                    "at": [_short(part) for part in person.place(now)],
                    "is_present": person.is_present(now),
                }
                for person in world.people
            ],
            "things": [{"name": i.name, "at": [_short(i.x), _short(i.y)]} for i in world.items],
        }

    def _world_of(self) -> SimulatedWorld | None:
        return next(iter(self._robot.resources.opened(SimulatedWorld)), None)


@lru_cache(maxsize=2)
def _drawn(room: Room) -> dict[str, Any]:
    """The lines and circles of a room."""
    walls = [one for one in room.obstacles if isinstance(one, Wall)]
    sides = [side for one in room.obstacles if isinstance(one, Box) for side in one.sides()]
    rounds = [one for one in room.obstacles if isinstance(one, Circle)]
    return {
        "walls": [[_short(p) for p in (w.x1, w.y1, w.x2, w.y2)] for w in (*walls, *sides)],
        "circles": [[_short(p) for p in (c.x, c.y, c.radius)] for c in rounds],
    }


class _Pictures:
    """Hands pictures to the link while someone looks at them, and not too many."""

    def __init__(self, link: RobotEnd) -> None:
        self._link = link
        self._due = dict.fromkeys(RATES, -math.inf)

    def put(self, topic: str, image: Image, time: float) -> None:
        """A picture of a key of `RATES`, taken at a time."""
        if topic in self._link.wanted and time >= self._due[topic]:
            gap = 1 / RATES[topic]
            self._due[topic] = max(self._due[topic] + gap, time)
            self._link.put_picture(topic, image, time)


class _PageScreen(Screen):
    """Shows the face on the page."""

    def __init__(self, screen: Screen, pictures: _Pictures) -> None:
        Resource.__init__(self, Description("studio", "Hri.OffscreenScreen"), screen.manager)
        self.width, self.height, self._pictures = screen.width, screen.height, pictures

    def show(self, image: Image, time: float) -> None:
        self._pictures.put("face", image, time)


def _sensors(context: TaskContext) -> Iterator[RangeSensor]:
    yield from context.resources.opened(RangeSensor)


def _range(sensor: RangeSensor, pose: Any, now: float) -> dict[str, Any]:
    try:
        distance: float | None = sensor.read(now).distance
    except HriError:
        distance = None
    return {
        "id": sensor.id,
        "at": [_short(pose.x), _short(pose.y), _short(pose.yaw)],
        "distance": None if distance is None or math.isinf(distance) else _short(distance),
    }


def _person(person: Person, attended: str) -> dict[str, Any]:
    box = person.pose.box
    return {
        "id": person.id,
        "name": person.name,
        "distance": _short(person.distance),
        "bearing": _short(person.bearing),
        "engagement": person.engagement,
        "is_looking": person.is_looking,
        "is_attended": person.id == attended,
        "box": box and [round(part) for part in (box.x, box.y, box.width, box.height)],
    }


def _short(value: float) -> float | None:
    """As many places as anyone can see."""
    return round(float(value), 3) if math.isfinite(value) else None
