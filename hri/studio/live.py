"""What the page shows of a robot that runs: its newest values, its events, its pictures."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from hri.behavior.device_behaviors import CameraFrames
from hri.behavior.runner import Runner
from hri.conversation.examples import nearest_sentence, sayings
from hri.conversation.puzzlement import as_said
from hri.core.errors import HriError
from hri.core.geometry import Pose3D, seen_from
from hri.core.signals import Event, Frame, Image, People, Person, Pose2D
from hri.drive.avoidance import ROUTE
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
from hri.speech.grammar import Grammar
from hri.studio import topics
from hri.studio.history import LogLines, MoodHistory, Trail, Troubles, TypedSentences
from hri.studio.link import RobotEnd
from hri.studio.running import RunningNetworks
from hri.task.context import TaskContext

API = 1
"""Version of the interface."""
RATES = {"face": 22.0, "camera": 10.0}
"""Pictures a second at most."""
MOST_CAUSES = 6
"""Causes of a feeling that are shown."""
FAINT = 0.02
"""An emotion of less than this is not shown."""
DONE = "done"
"""Why the base stops whenever it was asked to."""
ROUTE_AGE = 0.5
"""Seconds for which a planned way counts."""
UNDERSTOOD = ("speech.heard", "speech.rejected")
"""Events that say what became of a sentence."""
BREATH = 0.005
"""Seconds between two looks: the loop has other things to do in between."""

log = logging.getLogger("hri")


class Live:
    """Puts what a robot does into the link."""

    def __init__(self, robot: Robot, link: RobotEnd, networks: RunningNetworks) -> None:
        self._robot, self._link, self._networks = robot, link, networks
        self._seeing: Runner | None = None
        """The network whose camera is shown."""
        self._pictures = _Pictures(link)
        self._moods, self._trail, self._troubles = MoodHistory(), Trail(), Troubles()
        self._log = LogLines(robot.clock.now)
        self.typed = TypedSentences()
        self._grammar: Grammar | None = None
        self._told: list[topics.Saying] = []
        """What can be said by that grammar."""
        self._looks: Mapping[str, tuple[float, Callable[[TaskContext, float], Any]]] = {
            # topic: seconds between two looks, and the look
            "about": (1.0, self._about),
            "speech": (0.1, self._speech),
            "sayings": (1.0, self._sayings),
            "feeling": (0.1, self._feeling),
            "moods": (1.0, self._mood_history),
            "people": (0.1, self._people),
            "base": (0.1, self._base),
            "path": (0.2, self._path),
            "world": (0.1, self._world),
            "devices": (0.5, self._devices),
            "log": (0.3, self._log_lines),
            "networks": (0.1, self._running),
        }

    def join(self) -> None:
        """Let the page have the face, beside the screen, and the log; before the networks start."""
        self._listen_to_notices()
        self._log_level = log.level
        log.addHandler(self._log)
        log.setLevel(min(log.getEffectiveLevel(), logging.INFO))
        if "screen" not in self._robot.resources.descriptions:
            return
        resources = self._robot.resources
        screen = resources.obtain("screen", Screen)
        page = _PageScreen(screen, self._pictures)
        tee = TeeScreen(screen, page)
        tee.activate()
        resources.substitute("screen", tee)

    def leave(self) -> None:
        """Follow the log no more; a second call does nothing."""
        if self._log in log.handlers:
            log.removeHandler(self._log)
            log.setLevel(self._log_level)

    def _listen_to_notices(self) -> None:
        resources = self._robot.resources
        tell = resources.notice

        def noticed(line: str) -> None:
            self._troubles.note(line)
            self._log.add("notice", "resources", line)
            tell(line)

        resources.notice = noticed

    async def watch(self, context: TaskContext) -> None:
        """Look at the robot as long as it lives."""
        self._robot.events.subscribe("*", self._tell)
        self._robot.events.subscribe("drive.stopped", self._note_stop)
        due = dict.fromkeys(self._looks, 0.0)
        while True:
            topic = min(due, key=due.__getitem__)
            now = context.clock.now()
            await context.clock.sleep_until(max(due[topic], now + BREATH))
            now = context.clock.now()
            every, look = self._looks[topic]
            self._link.put(topic, look(context, now))
            due[topic] = now + every

    def _tell(self, event: Event) -> None:
        # Words that were rejected were said to someone else: the page gets them no more than a
        # recording does, unless they were typed there.
        withheld = REJECTED.get(event.name, ())
        told = {key: value for key, value in event.properties.items() if key not in withheld}
        if event.name in UNDERSTOOD:
            typed = self.typed.take(str(event.properties.get("text", "")))
            if typed is not None and event.name == "speech.rejected":
                told |= {"text": typed, "detail": event.properties.get("detail", ""), "typed": True}
                told["nearest"] = self._nearest(typed)
        self._link.add_event({**told, "t": round(event.time, 3), "event": event.name})

    def _note_stop(self, event: Event) -> None:
        reason, words = (str(event.properties.get(key, "")) for key in ("reason", "words"))
        if reason != DONE:
            self._trail.add_stop(event.time, reason, words)

    def _watch_camera(self, context: TaskContext) -> None:
        """Again when another network has taken the place of the one that was watched."""
        runners = context.networks.runners
        if self._seeing in runners.values():
            return
        for name, runner in runners.items():
            for behavior in runner.network.behaviors:
                if isinstance(behavior, CameraFrames):
                    context.networks.watch(name, behavior.id, "raw_image", self._see)
                    self._seeing = runner
                    return

    def _see(self, frame: Frame, now: float) -> None:
        self._pictures.put("camera", frame.image, frame.time)

    # --- topics ---

    def _running(self, context: TaskContext, now: float) -> list[topics.RunningNetwork]:
        self._watch_camera(context)
        return self._networks.listed()

    def _about(self, context: TaskContext, now: float) -> topics.About:
        drives = self._robot.resources.ids(EmergencyStop)
        return {
            "api": API,
            "app": self._robot.app.name,
            "about": self._robot.app.about,
            "is_simulated": self._world_of() is not None or self._is_world_configured(),
            "has_base": bool(drives),
            "is_network": self._robot.app.is_network,
            "networks": [str(path.resolve()) for path in self._robot.app.networks],
        }

    def _devices(self, context: TaskContext, now: float) -> list[topics.Device]:
        resources = context.resources
        opened = {resource.id: resource for resource in resources.opened(Resource)}
        found: list[topics.Device] = []
        for id in resources.descriptions:
            stand_in = resources.stand_in_of(id) or ""
            if (resource := opened.get(stand_in or id)) is None:
                continue
            problem = self._troubles.of(id)
            found.append(
                {
                    "id": id,
                    "says": resource.describe(),
                    "stand_in": stand_in,
                    "state": "missing" if stand_in else "trouble" if problem else "ok",
                    "problem": problem,
                }
            )
        return found

    def _log_lines(self, context: TaskContext, now: float) -> list[topics.LogLine]:
        return self._log.told()

    def _speech(self, context: TaskContext, now: float) -> topics.Speech:
        listener, voice = context.find_behavior(Listener), context.find_behavior(Voice)
        return {
            "is_hearing": bool(context.board.slot("hearing").value),
            "is_muted": listener is not None and listener.is_muted,
            "is_held": listener is not None and listener.is_held,
            "is_speaking": voice is not None and not voice.is_idle,
        }

    def _sayings(self, context: TaskContext, now: float) -> list[topics.Saying]:
        listener = context.find_behavior(Listener)
        grammar = None if listener is None else listener.loaded_grammar
        if grammar is not self._grammar:
            self._grammar = grammar
            found = {} if grammar is None else sayings(grammar)
            self._told = [
                {
                    "rule": rule,
                    "about": "" if grammar is None else grammar.rules[rule].doc.partition("\n")[0],
                    "examples": [as_said(text) for text in examples],
                }
                for rule, examples in found.items()
            ]
        return self._told

    def _nearest(self, text: str) -> str:
        """The sentence that can be said and is most like a text; empty when none is near."""
        return "" if self._grammar is None else as_said(nearest_sentence(self._grammar, text))

    def _feeling(self, context: TaskContext, now: float) -> topics.Feeling | None:
        emotion = context.find_behavior(EmotionModel)
        if emotion is None:
            return None
        state, why, causes = emotion.feeling(), emotion.why_words(), emotion.why()[:MOST_CAUSES]
        self._moods.add(now, state, causes[0].name if causes else "", why)
        return {
            "label": state.label,
            "words": emotion.feeling_words(),
            "why": why,
            "pleasure": round(state.valence, 3),
            "arousal": round(state.arousal, 3),
            "dominance": round(state.dominance, 3),
            "emotions": {n: round(v, 3) for n, v in state.emotions.items() if v >= FAINT},
            "drives": {name: round(value, 3) for name, value in state.drives.items()},
            "causes": [
                {"name": cause.name, "share": round(cause.share, 3), "person": cause.person or ""}
                for cause in causes
            ],
        }

    def _mood_history(self, context: TaskContext, now: float) -> topics.Moods:
        return self._moods.told()

    def _people(self, context: TaskContext, now: float) -> topics.Eyes:
        camera = next(iter(context.resources.opened(Camera)), None)
        seen = context.board.slot("people").value
        people = seen if isinstance(seen, People) else People(now)
        return {
            "is_watching": camera is not None and camera.is_watching,
            "is_on": camera is not None and camera.is_on,
            "persons": [_person(one, people.attended) for one in people.persons if one.is_visible],
        }

    def _base(self, context: TaskContext, now: float) -> topics.Base:
        resources = context.resources
        odometry = next(iter(resources.opened(Odometry)), None)
        battery = next(iter(resources.opened(Battery)), None)
        level = battery.level(now) if battery else None
        base = next(iter(resources.opened(EmergencyStop)), None)
        pose = self._pose(context, now)
        velocity = odometry.velocity(now) if odometry else None
        if pose is not None:
            self._trail.add(pose)
        return {
            "pose": _placed(pose.x, pose.y, pose.heading) if pose else None,
            "velocity": _placed(velocity.linear, velocity.angular) if velocity else None,
            "battery": _short(level) if level is not None else None,
            "has_battery": battery is not None,
            "is_stopped": base is not None and base.is_latched,
            "why": base.explain() if base is not None else "",
            "ranges": [_range(one, resources.pose_of(one.id), now) for one in _sensors(context)],
        }

    def _pose(self, context: TaskContext, now: float) -> Pose2D | None:
        """Where the base is: in the room where that is simulated, else as its odometry has it."""
        if (world := self._world_of()) is not None:
            return world.base.pose
        odometry = next(iter(context.resources.opened(Odometry)), None)
        return odometry.pose(now) if odometry else None

    def _path(self, context: TaskContext, now: float) -> topics.Path:
        return {
            "been": self._trail.been,
            "planned": self._planned(context, now),
            "stops": self._trail.stops,
        }

    def _planned(self, context: TaskContext, now: float) -> list[list[float]]:
        """The way that it means to take, in the frame of `_pose`."""
        route, time = context.board.slot(ROUTE).get()
        odometry = next(iter(context.resources.opened(Odometry)), None)
        pose = self._pose(context, now)
        if not route or now - time > ROUTE_AGE or odometry is None or pose is None:
            return []
        here = odometry.pose(now)
        cos, sin = math.cos(pose.heading), math.sin(pose.heading)
        seen = [seen_from(here, x, y) for x, y in route]
        return [_placed(pose.x + cos * u - sin * v, pose.y + sin * u + cos * v) for u, v in seen]

    def _world(self, context: TaskContext, now: float) -> topics.World | None:
        world = self._world_of()
        if world is None:
            return None
        walls, circles = _drawn(world.room)
        return {
            "walls": walls,
            "circles": circles,
            "people": [
                {
                    "name": person.name,
                    "at": _placed(*person.place(now)),
                    "is_present": person.is_present(now),
                }
                for person in world.people
            ],
            "things": [{"name": item.name, "at": _placed(item.x, item.y)} for item in world.items],
            "obstacles": [
                {"name": name, "at": _placed(one.x, one.y), "radius": one.radius}
                for name, one in world.obstacles.items()
            ],
        }

    def _is_world_configured(self) -> bool:
        """Also before anything is open: a world that is there, not one that may stand in."""
        resources = self._robot.resources
        stand_ins = {one.text("stand_in") for one in resources.descriptions.values()}
        return not stand_ins.issuperset(resources.ids(SimulatedWorld))

    def _world_of(self) -> SimulatedWorld | None:
        return next(iter(self._robot.resources.opened(SimulatedWorld)), None)


@lru_cache(maxsize=2)
def _drawn(room: Room) -> tuple[list[list[float]], list[list[float]]]:
    """The lines and circles of a room."""
    walls = [one for one in room.obstacles if isinstance(one, Wall)]
    sides = [side for one in room.obstacles if isinstance(one, Box) for side in one.sides()]
    rounds = [one for one in room.obstacles if isinstance(one, Circle)]
    lines = [_placed(wall.x1, wall.y1, wall.x2, wall.y2) for wall in (*walls, *sides)]
    return lines, [_placed(one.x, one.y, one.radius) for one in rounds]


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


def _range(sensor: RangeSensor, pose: Pose3D, now: float) -> topics.Range:
    try:
        distance: float | None = sensor.read(now).distance
    except HriError:
        distance = None
    return {
        "id": sensor.id,
        "at": _placed(pose.x, pose.y, pose.yaw),
        "distance": None if distance is None or math.isinf(distance) else _short(distance),
    }


def _person(person: Person, attended: str) -> topics.SeenPerson:
    box = person.pose.box or person.body
    return {
        "id": person.id,
        "name": person.name,
        "distance": _short(person.distance),
        "bearing": _short(person.bearing),
        "engagement": person.engagement,
        "is_looking": person.is_looking,
        "is_attended": person.id == attended,
        "has_face": person.has_face,
        "since": _short(person.since),
        "box": [round(part) for part in (box.x, box.y, box.width, box.height)] if box else None,
    }


def _placed(*parts: float) -> list[float]:
    """Meters and radians, to the millimeter."""
    return [round(float(part), 3) for part in parts]


def _short(value: float) -> float | None:
    """As many places as anyone can see."""
    return round(float(value), 3) if math.isfinite(value) else None
