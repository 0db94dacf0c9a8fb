"""A person: where they are, how they hold themselves, what they say.

Requests are put on a schedule; from then on every answer is a function of time, so pictures and
sound do not depend on how often anyone looked or listened.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from hri.core.geometry import wrapped
from hri.core.signals import HeadPose, Speech
from hri.hal.synthesizer import Synthesizer
from hri.simulation.people import body_motion
from hri.simulation.people.appearance import DEFAULT_ACTOR, Outfit
from hri.simulation.people.body_motion import MOTIONS, BodyMotion, Posture
from hri.simulation.people.hand_motion import HAND_MOTIONS, HandMotion, HeldHand

RADIUS = 0.22
"""Meters, of the place a standing person takes."""
WALK_TIME = 1.5
"""Seconds to come into view or to walk out of it."""
WALK_WAY = 1.0
"""Meters between the person's place and where they are out of view."""
SPEED = 0.7
"""Meters a second of someone who comes nearer or steps back."""
TURN_TIME = 0.7
"""Seconds in which someone turns to where they walk."""
PAUSE = 0.3
"""Seconds between two sentences that were asked for at the same time."""

_BLINK_EVERY = 4.0
_BLINK_TIME = 0.2
_OPEN_MOUTH = 6000.0
"""Level of the voice, of 32767, that opens the mouth all the way."""


@dataclass(frozen=True, slots=True)
class Movement:
    """A movement that begins at a time and ends where it began."""

    start: float
    motion: BodyMotion
    seed: int

    def at(self, time: float) -> Posture:
        return self.motion.at(time - self.start, self.seed)


@dataclass(frozen=True, slots=True)
class ShownHand:
    """A hand that is raised at a time, held up for some seconds, and lowered."""

    start: float
    """Seconds."""
    held: float
    motion: HandMotion


@dataclass(frozen=True, slots=True)
class Way:
    """A way through the room."""

    start: float
    """Seconds."""
    origin: tuple[float, float]
    goal: tuple[float, float]
    speed: float = SPEED
    """Meters a second, in the mean."""
    looks_ahead: bool = False
    """Whether they turn to where they go, and go on from there at the same pace."""

    @property
    def duration(self) -> float:
        return math.dist(self.origin, self.goal) / self.speed

    @property
    def heading(self) -> float:
        """Radians, in the room."""
        return math.atan2(self.goal[1] - self.origin[1], self.goal[0] - self.origin[0])

    def at(self, time: float) -> tuple[float, float]:
        (x, y), (to_x, to_y), duration = self.origin, self.goal, self.duration
        part = (time - self.start) / duration if duration else 1.0
        part = min(1.0, part) if self.looks_ahead else body_motion.eased(part)
        return x + (to_x - x) * part, y + (to_y - y) * part


@dataclass(frozen=True, slots=True)
class Spoken:
    """Something the person says."""

    start: float
    """Seconds."""
    speech: Speech

    @property
    def end(self) -> float:
        return self.start + self.speech.duration

    def loudness(self, time: float) -> float:
        """0 to 1, how far the mouth opens for what sounds then."""
        index = int((time - self.start) * self.speech.rate)
        width = self.speech.rate // 50
        heard = self.speech.samples[max(0, index - width) : max(0, index + width)]
        if not len(heard):
            return 0.0
        return min(1.0, float(np.sqrt(np.mean(heard.astype(np.float64) ** 2))) / _OPEN_MOUTH)


class SimulatedPerson:
    """Stands somewhere, faces the robot, and does what is put on the schedule."""

    def __init__(
        self,
        x: float = 0.0,
        y: float = 0.0,
        synthesizer: Synthesizer | None = None,
        seed: int = 0,
        starts_present: bool = True,
        name: str = "",
        actor: str = DEFAULT_ACTOR,
    ) -> None:
        """`x` and `y` are where they stand at first; `actor` is whom they look like (see
        `actors.ACTORS`). Without a synthesizer the person cannot speak."""
        self.x, self.y = x, y
        self.name, self.actor = name, actor
        self.outfit: Outfit | None = None
        """What they wear instead of the clothes of the actor."""
        self.spoken: list[Spoken] = []
        self._synthesizer = synthesizer
        self._seed = seed
        self.starts_present = starts_present
        self._walks: list[tuple[float, bool]] = []
        self._ways: list[Way] = []
        self._movements: list[Movement] = []
        self._shown: list[ShownHand] = []
        self._known: dict[str, Speech] = {}

    def rehearse(self, texts: Iterable[str]) -> None:
        """Make the sound of sentences ahead, so that saying them takes no time."""
        for text in texts:
            if self._synthesizer is not None and text not in self._known:
                self._known[text] = self._synthesizer.synthesize(text)

    def say(self, text: str, at: float) -> Spoken | None:
        """Say something, after what is still being said; None from someone without a voice."""
        self.rehearse([text])
        if text not in self._known:
            return None
        start = max([at, *(spoken.end + PAUSE for spoken in self.spoken[-1:])])
        self.spoken.append(Spoken(start, self._known[text]))
        return self.spoken[-1]

    def move(self, name: str, at: float) -> None:
        """Do something of `body_motion.MOTIONS`."""
        seed = self._seed + len(self._movements)
        self._movements.append(Movement(at, MOTIONS[name], seed))

    def show(self, name: str, at: float, seconds: float = 2.0) -> None:
        """Raise the left hand for something of `hand_motion.HAND_MOTIONS`, held so long."""
        self._shown.append(ShownHand(at, seconds, HAND_MOTIONS[name]))

    def hand(self, time: float) -> HeldHand | None:
        """The left hand, where it shows something; None while it rests."""
        for shown in reversed(self._shown):
            if (held := shown.motion.at(time - shown.start, shown.held)) is not None:
                return held
        return None

    def nod(self, at: float) -> None:
        """Nod the head."""
        self.move("nod", at)

    def shake(self, at: float) -> None:
        """Shake the head."""
        self.move("shake", at)

    def look_aside(self, at: float) -> None:
        """Glance to the side and back."""
        self.move("look_aside", at)

    def go(
        self, x: float, y: float, at: float, *, speed: float = SPEED, looks_ahead: bool = False
    ) -> float:
        """Walk to another place of the room; when they are there, seconds.

        They face the robot meanwhile, or with `looks_ahead` turn to where they go, and stay so.
        """
        self._ways.append(Way(at, self.place(at), (x, y), speed, looks_ahead))
        return at + self._ways[-1].duration

    def facing(self, time: float, robot: float) -> float:
        """Radians in the room: where their body faces; `robot` is the direction to the robot."""
        heading = robot
        for way in self._ways:
            if way.start <= time and way.duration:
                goal = way.heading if way.looks_ahead else robot
                part = body_motion.eased((time - way.start) / TURN_TIME)
                heading += wrapped(goal - heading) * part
        return heading

    def place(self, time: float) -> tuple[float, float]:
        """Where they stand, or would if they were there: x and y, meters."""
        for way in reversed(self._ways):
            if way.start <= time:
                return way.at(time)
        return self.x, self.y

    def enter(self, at: float) -> None:
        """Walk into view; nothing for someone who is there."""
        self._walk(at, True)

    def leave(self, at: float) -> None:
        """Walk out of view; gone when the walk is over."""
        self._walk(at, False)

    def is_present(self, time: float) -> bool:
        """Whether any of the person is there."""
        begin, comes = self._last_walk(time)
        return comes or time - begin < WALK_TIME

    def aside(self, time: float) -> float:
        """Meters from the person's place, to the right as seen by the robot, while walking."""
        begin, comes = self._last_walk(time)
        part = body_motion.eased((time - begin) / WALK_TIME)
        return WALK_WAY * (1 - part if comes else part)

    def posture(self, time: float) -> Posture:
        """How they hold themselves: all that they do at once, over the sway of rest."""
        held = Posture(*body_motion.idle_angles(time, self._seed))
        for movement in self._movements:
            held += movement.at(time)
        if self._is_walking(time):
            held += body_motion.steps(time)
        voice = (s.loudness(time) for s in self.spoken if s.start <= time <= s.end)
        return held + Posture(mouth=max(voice, default=0.0))

    def head(self, time: float) -> HeadPose:
        """How the head is held; all angles 0 look at the robot."""
        held = self.posture(time)
        return HeadPose(time, held.pitch, held.yaw, held.roll)

    def mouth(self, time: float) -> float:
        """How far the mouth is open, 0 to 1."""
        return self.posture(time).mouth

    def lids(self, time: float) -> float:
        """How far the eyes are open, 0 to 1: one blink in each stretch of a few seconds."""
        stretch = math.floor(time / _BLINK_EVERY)
        dice = random.Random(f"{self._seed}/{stretch}")
        blink = (stretch + dice.uniform(0.1, 0.9)) * _BLINK_EVERY
        return min(1.0, abs(time - blink) / (_BLINK_TIME / 2))

    def _is_walking(self, time: float) -> bool:
        walks = [(self._last_walk(time)[0], WALK_TIME)]
        walks += [(way.start, way.duration) for way in self._ways]
        return any(start <= time <= start + duration for start, duration in walks)

    def _walk(self, at: float, comes: bool) -> None:
        if self._last_walk(at)[1] != comes:
            self._walks.append((at, comes))

    def _last_walk(self, time: float) -> tuple[float, bool]:
        begun = [walk for walk in self._walks if walk[0] <= time]
        return max(begun) if begun else (-math.inf, self.starts_present)
