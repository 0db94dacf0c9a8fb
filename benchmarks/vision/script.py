"""What happens in the films that are judged: gestures and distractors by lot, each at its time.

The gestures are as people make them when asked (see the notes of
`hri.vision.gestures.gesture_recognizer`): nods of 3 to 10 degrees and shakes of 5 to 20 to each
side, 1.2 to 2.8 a second, one and a half to three times. Before each comes a distractor. Faces,
light, noise, blur and a trembling camera are drawn by lot, too; the faces are those that nothing
was tuned on."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import (
    DISTRACTORS,
    MOTIONS,
    Posture,
    nod_angles,
    shake_angles,
)
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role

SEED = 640_000
"""Of the figures; none of these films was looked at to choose anything."""
GESTURES_A_FILM = 5
LEAD = 1.5
"""Seconds before anything happens, in which the person is found."""
PAUSE = (0.9, 1.6)
"""Seconds of rest after each movement."""
HERTZ, CYCLES = (1.2, 2.8), (1.5, 2.0, 2.5, 3.0)
NOD_DEGREES, SHAKE_DEGREES = (3.0, 10.0), (5.0, 20.0)
DISTANCE = (0.75, 1.6)
"""Meters: faces of 170 down to 80 pixels."""
FAR_TOO_FAST = 160.0
"""Degrees a second; nobody nods or shakes as wide and as fast as the dice may ask for."""


@dataclass(frozen=True, slots=True)
class Gesture:
    """A nod or shake in a film."""

    kind: str
    start: float
    """Seconds, when the movement begins."""
    duration: float
    amplitude: float
    """Radians to each side."""
    frequency: float
    """Hertz."""

    @property
    def end(self) -> float:
        return self.start + self.duration

    def posture(self, time: float) -> Posture:
        angles = nod_angles if self.kind == "nod" else shake_angles
        elapsed, cycles = time - self.start, self.duration * self.frequency
        if not 0 <= elapsed <= self.duration:
            return Posture()
        return Posture(
            *angles(elapsed, amplitude=self.amplitude, frequency=self.frequency, cycles=cycles)
        )


@dataclass(frozen=True, slots=True)
class Distraction:
    """Something else that the person does."""

    name: str
    start: float
    seed: int

    def posture(self, time: float) -> Posture:
        return MOTIONS[self.name].at(time - self.start, self.seed)


@dataclass(frozen=True, slots=True)
class Script:
    """One film of one person."""

    number: int
    gestures: tuple[Gesture, ...]
    distractions: tuple[Distraction, ...]
    duration: float
    """Seconds."""

    def motion(self, time: float) -> Posture:
        """All that the person does at a time."""
        held = Posture()
        parts: list[Gesture | Distraction] = [*self.gestures, *self.distractions]
        for part in parts:
            held += part.posture(time)
        return held

    def film(self, rate: float) -> Film:
        """The film at a frame rate."""
        dice = random.Random(f"film {SEED + self.number}")
        actors = [name for name, looks in ACTORS.items() if looks.is_for_tests]
        role = Role(
            self.motion,
            actor=actors[self.number % len(actors)],
            distance=dice.uniform(*DISTANCE),
            right=dice.uniform(-0.1, 0.1),
            seed=SEED + self.number,
        )
        is_dark = dice.random() < 0.3
        lens = Lens(
            noise=dice.uniform(2, 9),
            light=0.4 if is_dark else 1.0,
            flicker=0.15 if is_dark else 0.0,
            blur=dice.choice((0.0, 0.0, 0.8)),
            jitter=dice.choice((0.0, 0.0, 1.0)),
            seed=SEED + self.number,
        )
        return Film([role], self.duration, rate, Optics(), lens, scene=self.number)


def scripts(gestures: int) -> list[Script]:
    """Films with a number of gestures in all."""
    return [_script(number) for number in range(math.ceil(gestures / GESTURES_A_FILM))]


def _script(number: int) -> Script:
    dice = random.Random(f"script {SEED + number}")
    now, gestures, distractions = LEAD, [], []
    for turn in range(GESTURES_A_FILM):
        name = dice.choice(DISTRACTORS)
        distractions.append(Distraction(name, now, dice.randrange(10**6)))
        now += MOTIONS[name].duration + dice.uniform(*PAUSE)
        kind = ("nod", "shake")[(number + turn) % 2]
        gestures.append(_gesture(kind, now, dice))
        now = gestures[-1].end + dice.uniform(*PAUSE)
    return Script(number, tuple(gestures), tuple(distractions), now)


def _gesture(kind: str, start: float, dice: random.Random) -> Gesture:
    frequency = dice.uniform(*HERTZ)
    degrees = dice.uniform(*(NOD_DEGREES if kind == "nod" else SHAKE_DEGREES))
    degrees = min(degrees, FAR_TOO_FAST / (2 * math.pi * frequency))
    duration = dice.choice(CYCLES) / frequency
    return Gesture(kind, start, duration, math.radians(degrees), frequency)
