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

RADIUS = 0.22
"""Metres, of the place a standing person takes."""
WALK_TIME = 1.5
"""Seconds to come into view or to walk out of it."""
WALK_WAY = 1.0
"""Metres between the person's place and where they are out of view."""
PAUSE = 0.3
"""Seconds between two sentences that were asked for at the same time."""

_SWING_HZ = 1.7
_NOD_TIME = 1.5
_SHAKE_TIME = 1.6
_GLANCE_TIME = 2.0
_GLANCE_TURN = 0.5
_BLINK_EVERY = 4.0
_BLINK_TIME = 0.2
_OPEN_MOUTH = 6000.0
"""Level of the voice, of 32767, that opens the mouth all the way."""
_SWAY = ((math.radians(0.7), 5.3), (math.radians(1.1), 7.7), (math.radians(0.8), 9.1))
"""Amplitude and period of the sway of a head at rest: pitch, yaw, roll; too slow for a gesture."""

Angles = tuple[float, float, float]
"""Pitch, yaw, roll as in HeadPose, radians."""


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
        dice = random.Random(seed)
        self._phases = [dice.uniform(0.0, 2 * math.pi) for _ in _SWAY]

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
        self._movements.append(Movement(at, _NOD_TIME, _nod))

    def shake(self, at: float) -> None:
        self._movements.append(Movement(at, _SHAKE_TIME, _shake))

    def look_aside(self, at: float) -> None:
        """Glance to the side and back."""
        self._movements.append(Movement(at, _GLANCE_TIME, _look_aside))

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
        part = _eased((time - begin) / WALK_TIME)
        return WALK_WAY * (1 - part if comes else part)

    def head(self, time: float) -> HeadPose:
        """How the head is held; all angles 0 look at the robot."""
        sway = (
            amplitude * math.sin(2 * math.pi * time / period + phase)
            for (amplitude, period), phase in zip(_SWAY, self._phases, strict=True)
        )
        moved = (movement.at(time) for movement in self._movements)
        pitch, yaw, roll = (sum(parts) for parts in zip(tuple(sway), *moved, strict=True))
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


def _nod(elapsed: float) -> Angles:
    return _swings(elapsed, math.radians(9), _NOD_TIME), 0.0, 0.0


def _shake(elapsed: float) -> Angles:
    return 0.0, _swings(elapsed, math.radians(14), _SHAKE_TIME), 0.0


def _look_aside(elapsed: float) -> Angles:
    turned = _eased(min(elapsed, _GLANCE_TIME - elapsed) / _GLANCE_TURN)
    return math.radians(6) * turned, math.radians(26) * turned, 0.0


def _swings(elapsed: float, amplitude: float, duration: float) -> float:
    """A sine that swells and fades, so that the head starts and ends at rest."""
    swell = math.sin(math.pi * elapsed / duration)
    return amplitude * swell * math.sin(2 * math.pi * _SWING_HZ * elapsed)


def _eased(part: float) -> float:
    """0 to 1 with a soft start and end."""
    part = min(1.0, max(0.0, part))
    return part * part * (3 - 2 * part)
