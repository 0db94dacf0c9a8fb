"""The person: where they are, how they hold the head, what they say.

What is asked of them is put on a schedule; from then on every answer is a function of time, so
pictures and sound do not depend on how often anybody looked or listened.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from hri.core.signals import HeadPose, Speech
from hri.hal.synthesizer import Synthesizer
from hri.simulation import motion
from hri.simulation.motion import Angles

RADIUS = 0.22
"""Metres, of the place a standing person takes."""
WALK_TIME = 1.5
"""Seconds to come into view or to walk out of it."""
WALK_WAY = 1.0
"""Metres between the person's place and where they are out of view."""
PAUSE = 0.3
"""Seconds between two sentences that were asked for at the same time."""

_BLINK_EVERY = 4.0
_BLINK_TIME = 0.2
_OPEN_MOUTH = 6000.0
"""Level of the voice, of 32767, that opens the mouth all the way."""


@dataclass(frozen=True, slots=True)
class Movement:
    """A movement of the head that begins at a time and ends where it began."""

    start: float
    duration: float
    angles: Callable[[float], Angles]
    """The angles, seconds after the start."""

    def at(self, time: float) -> Angles:
        elapsed = time - self.start
        return self.angles(elapsed) if 0 <= elapsed <= self.duration else (0.0, 0.0, 0.0)


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


class Person:
    """Stands at (x, y), faces the robot, and does what is put on the schedule."""

    def __init__(
        self,
        x: float = 0.0,
        y: float = 0.0,
        synthesizer: Synthesizer | None = None,
        seed: int = 0,
        starts_present: bool = True,
    ) -> None:
        """Without a synthesizer the person cannot speak."""
        self.x, self.y = x, y
        self.spoken: list[Spoken] = []
        self._synthesizer = synthesizer
        self._seed = seed
        self.starts_present = starts_present
        self._walks: list[tuple[float, bool]] = []
        self._movements: list[Movement] = []
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

    def nod(self, at: float) -> None:
        self._movements.append(Movement(at, motion.NOD_TIME, motion.nod_angles))

    def shake(self, at: float) -> None:
        self._movements.append(Movement(at, motion.SHAKE_TIME, motion.shake_angles))

    def look_aside(self, at: float) -> None:
        """Glance to the side and back."""
        self._movements.append(Movement(at, motion.GLANCE_TIME, motion.glance_angles))

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
        """Metres from the person's place, to the right as seen by the robot, while walking."""
        begin, comes = self._last_walk(time)
        part = motion.eased((time - begin) / WALK_TIME)
        return WALK_WAY * (1 - part if comes else part)

    def head(self, time: float) -> HeadPose:
        """How the head is held; all angles 0 look at the robot."""
        moved = (movement.at(time) for movement in self._movements)
        sway = motion.idle_angles(time, self._seed)
        pitch, yaw, roll = (sum(parts) for parts in zip(sway, *moved, strict=True))
        return HeadPose(time, pitch, yaw, roll)

    def mouth(self, time: float) -> float:
        """How far the mouth is open, 0 to 1."""
        return max((s.loudness(time) for s in self.spoken if s.start <= time <= s.end), default=0.0)

    def lids(self, time: float) -> float:
        """How far the eyes are open, 0 to 1: one blink in each stretch of a few seconds."""
        stretch = math.floor(time / _BLINK_EVERY)
        dice = random.Random(f"{self._seed}/{stretch}")
        blink = (stretch + dice.uniform(0.1, 0.9)) * _BLINK_EVERY
        return min(1.0, abs(time - blink) / (_BLINK_TIME / 2))

    def _walk(self, at: float, comes: bool) -> None:
        if self._last_walk(at)[1] != comes:
            self._walks.append((at, comes))

    def _last_walk(self, time: float) -> tuple[float, bool]:
        begun = [walk for walk in self._walks if walk[0] <= time]
        return max(begun) if begun else (-math.inf, self.starts_present)
