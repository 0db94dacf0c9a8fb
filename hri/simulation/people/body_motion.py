"""How people move: how they hold head and face, and where they are, as functions of time.

Nods and shakes mean something; all other motions here are incidental, and a recognizer must not
take them for head gestures.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

Angles = tuple[float, float, float]
"""Pitch, yaw, roll as in HeadPose, radians."""

SWAY = (
    ((0.9, 0.11), (0.5, 0.29)),
    ((1.6, 0.07), (0.8, 0.23)),
    ((0.8, 0.09), (0.3, 0.31)),
)
"""Waves of pitch, yaw and roll of a head at rest: degrees and hertz; too slow for a gesture."""

SWING_HZ = 1.8
SWINGS = 2.0
NOD_TIME = SHAKE_TIME = SWINGS / SWING_HZ
"""Default duration of a nod or a shake, seconds."""
TURN = 0.5
"""Seconds of a turn of the head to the side or down, and of the way back."""
SYLLABLES_HZ = 4.3
"""Of fluent speech; the mouth opens that often."""
STEPS_HZ = 1.8
"""Of walking; the head goes up and down with each step."""
BOB = 0.02
"""Meters up and down from the middle (Murray 1967: 5 cm from lowest to highest)."""
LAUGH_HZ = 4.8
"""Bursts of a laugh (Bachorowski 2001: 4 to 5 a second)."""


@dataclass(frozen=True, slots=True)
class Posture:
    """How someone holds themselves, against how they stand at rest."""

    pitch: float = 0.0
    """Radians, as in HeadPose."""
    yaw: float = 0.0
    roll: float = 0.0
    right: float = 0.0
    """Meters to the right as the camera sees them."""
    down: float = 0.0
    """Meters."""
    nearer: float = 0.0
    """Meters toward the camera."""
    mouth: float = 0.0
    """0 shut to 1 open."""
    smile: float = 0.0
    """0 to 1."""
    brows: float = 0.0
    """-1 drawn together to 1 raised."""
    stride: float = 0.0
    """How far the left leg is before the right one, -1 to 1."""

    def __add__(self, other: Posture) -> Posture:
        return Posture(
            self.pitch + other.pitch,
            self.yaw + other.yaw,
            self.roll + other.roll,
            self.right + other.right,
            self.down + other.down,
            self.nearer + other.nearer,
            self.mouth + other.mouth,
            self.smile + other.smile,
            self.brows + other.brows,
            self.stride + other.stride,
        )


REST = Posture()


def nod_angles(
    time: float,
    *,
    amplitude: float = math.radians(9),
    frequency: float = SWING_HZ,
    cycles: float = SWINGS,
) -> Angles:
    """A nod that begins at time 0 with the head going down; radians, hertz, ups and downs."""
    return _swings(time, amplitude, frequency, cycles), 0.0, 0.0


def shake_angles(
    time: float,
    *,
    amplitude: float = math.radians(14),
    frequency: float = SWING_HZ,
    cycles: float = SWINGS,
) -> Angles:
    """A shake of the head that begins at time 0 to the person's left."""
    return 0.0, _swings(time, amplitude, frequency, cycles), 0.0


def idle_angles(time: float, seed: int = 0) -> Angles:
    """The small sway of a head at rest at a time; each seed sways in its own way."""
    phases = _phases(seed)
    pitch, yaw, roll = (
        sum(
            math.radians(degrees) * math.sin(2 * math.pi * hertz * time + phase)
            for (degrees, hertz), phase in zip(waves, row, strict=True)
        )
        for waves, row in zip(SWAY, phases, strict=True)
    )
    return pitch, yaw, roll


def nod(time: float, seed: int = 0) -> Posture:
    """A nod of the usual size, which begins at time 0."""
    return Posture(*nod_angles(time))


def shake(time: float, seed: int = 0) -> Posture:
    """A shake of the usual size, which begins at time 0."""
    return Posture(*shake_angles(time))


def look_aside(time: float, seed: int = 0) -> Posture:
    """A glance to the person's left and a little down, and back."""
    turned = _held(time, 2.0, TURN)
    return Posture(pitch=math.radians(6) * turned, yaw=math.radians(26) * turned)


def look_down(time: float, seed: int = 0) -> Posture:
    """A look at the hands, and back."""
    dice = _dice(seed)
    turned = _held(time, MOTIONS["look_down"].duration, dice.uniform(0.4, 0.7))
    down, aside = dice.uniform(16, 28), dice.uniform(-5, 5)
    return Posture(pitch=math.radians(down) * turned, yaw=math.radians(aside) * turned)


def look_around(time: float, seed: int = 0) -> Posture:
    """Looks here and there, each for a moment."""
    dice, begun, yaw, pitch = _dice(seed), 0.0, 0.0, 0.0
    end = MOTIONS["look_around"].duration
    held = Posture()
    while begun < end:
        stays, turn = dice.uniform(0.5, 1.2), dice.uniform(0.35, 0.6)
        last = begun + stays + 0.7 >= end
        to_yaw, to_pitch = (0.0, 0.0) if last else (dice.uniform(-35, 35), dice.uniform(-8, 10))
        if time >= begun:
            part = eased((time - begun) / turn)
            held = Posture(
                pitch=math.radians(pitch + (to_pitch - pitch) * part),
                yaw=math.radians(yaw + (to_yaw - yaw) * part),
            )
        yaw, pitch, begun = to_yaw, to_pitch, end if last else begun + stays
    return held


def talk(time: float, seed: int = 0) -> Posture:
    """Speech: the mouth opens with the syllables, the head moves along and stresses some words."""
    duration = MOTIONS["talk"].duration
    envelope, dice = _held(time, duration, 0.3), _dice(seed)
    phase, slow = dice.uniform(0, 2 * math.pi), dice.uniform(0, 2 * math.pi)
    # Waves of no common beat, and single small dips on stressed words.
    pitch = 0.9 * math.sin(2 * math.pi * 0.43 * time + slow)
    pitch += 0.7 * math.sin(2 * math.pi * 1.13 * time + phase)
    yaw = 1.8 * math.sin(2 * math.pi * 0.31 * time + phase) + math.sin(6.9 * time + slow)
    beat = 0.0
    while beat < duration:
        beat += dice.uniform(0.7, 1.9)
        pitch += dice.uniform(1.5, 3.5) * math.exp(-(((time - beat) / 0.14) ** 2))
    syllable = 0.5 - 0.5 * math.cos(2 * math.pi * SYLLABLES_HZ * time)
    loud = 0.6 + 0.4 * math.sin(2 * math.pi * 0.9 * time + slow)
    return Posture(
        pitch=math.radians(pitch) * envelope,
        yaw=math.radians(yaw) * envelope,
        roll=math.radians(1.2 * math.sin(2 * math.pi * 0.37 * time + slow)) * envelope,
        mouth=0.7 * syllable * loud * envelope,
        brows=0.6 * max(0.0, math.sin(2 * math.pi * 0.27 * time + slow)) * envelope,
    )


def walk(time: float, seed: int = 0) -> Posture:
    """Steps to the side and back: the head goes up and down with each, and rocks."""
    duration = MOTIONS["walk"].duration
    way = _dice(seed).choice((-1, 1)) * _dice(seed).uniform(0.12, 0.25)
    gone = Posture(
        right=way * math.sin(math.pi * min(1.0, max(0.0, time / duration))),
        nearer=0.15 * math.sin(2 * math.pi * time / duration) * _held(time, duration, 0.4),
    )
    return gone + steps(time, _held(time, duration, 0.4), seed)


def steps(time: float, part: float = 1.0, seed: int = 0) -> Posture:
    """What walking does to head and legs; `part` from 0 at rest to 1."""
    phase = 2 * math.pi * STEPS_HZ * _dice(seed).uniform(0.9, 1.1) * time
    return Posture(
        pitch=math.radians(0.9) * math.sin(phase + 0.6) * part,
        yaw=math.radians(1.4) * math.sin(phase / 2) * part,
        roll=math.radians(1.2) * math.sin(phase / 2 + 1.0) * part,
        right=0.015 * math.sin(phase / 2) * part,
        down=BOB * math.sin(phase) * part,
        stride=math.sin(phase / 2) * part,
    )


def laugh(time: float, seed: int = 0) -> Posture:
    """A laugh: the head goes back and quivers, mouth and cheeks go up."""
    envelope = _held(time, MOTIONS["laugh"].duration, 0.35)
    burst = math.sin(2 * math.pi * LAUGH_HZ * time)
    dice = _dice(seed)
    return Posture(
        pitch=math.radians(-dice.uniform(5, 9) + 0.9 * burst) * envelope,
        roll=math.radians(dice.uniform(-5, 5)) * envelope,
        down=0.004 * burst * envelope,
        mouth=(0.45 + 0.15 * burst) * envelope,
        smile=envelope,
    )


def tilt(time: float, seed: int = 0) -> Posture:
    """The head goes toward a shoulder and back."""
    dice = _dice(seed)
    turned = _held(time, MOTIONS["tilt"].duration, dice.uniform(0.4, 0.6))
    return Posture(roll=math.radians(dice.choice((-1, 1)) * dice.uniform(10, 20)) * turned)


def lean(time: float, seed: int = 0) -> Posture:
    """The person comes a little nearer with the upper body, and goes back."""
    leant = _held(time, MOTIONS["lean"].duration, 0.8)
    return Posture(
        pitch=math.radians(3) * leant,
        nearer=_dice(seed).uniform(0.12, 0.25) * leant,
        down=0.03 * leant,
    )


def still(time: float, seed: int = 0) -> Posture:
    """Only the sway of a head at rest."""
    return REST


def smile(time: float, seed: int = 0) -> Posture:
    """A smile that lasts for a while."""
    return Posture(smile=_held(time, MOTIONS["smile"].duration, 0.3))


def raise_brows(time: float, seed: int = 0) -> Posture:
    """The brows go up, and down again."""
    return Posture(brows=_held(time, MOTIONS["raise_brows"].duration, 0.2))


def lower_brows(time: float, seed: int = 0) -> Posture:
    """The brows are drawn together and down."""
    return Posture(brows=-_held(time, MOTIONS["lower_brows"].duration, 0.3))


@dataclass(frozen=True, slots=True)
class BodyMotion:
    """Something that people do."""

    duration: float
    """Seconds; it begins and ends at rest."""
    posture: Callable[[float, int], Posture]
    """Its contribution at a time since its start, seconds; varies with the seed."""

    def at(self, time: float, seed: int = 0) -> Posture:
        """The same; at rest before and after."""
        return self.posture(time, seed) if 0 <= time <= self.duration else REST


MOTIONS: Mapping[str, BodyMotion] = {
    "nod": BodyMotion(NOD_TIME, nod),
    "shake": BodyMotion(SHAKE_TIME, shake),
    "look_aside": BodyMotion(2.0, look_aside),
    "look_down": BodyMotion(2.4, look_down),
    "look_around": BodyMotion(5.0, look_around),
    "talk": BodyMotion(4.0, talk),
    "walk": BodyMotion(5.0, walk),
    "laugh": BodyMotion(2.5, laugh),
    "tilt": BodyMotion(2.2, tilt),
    "lean": BodyMotion(3.5, lean),
    "still": BodyMotion(3.0, still),
    "smile": BodyMotion(2.5, smile),
    "raise_brows": BodyMotion(1.2, raise_brows),
    "lower_brows": BodyMotion(2.0, lower_brows),
}
"""By name."""
GESTURES = ("nod", "shake")
EXPRESSIONS = ("smile", "raise_brows", "lower_brows")
DISTRACTORS = tuple(name for name in MOTIONS if name not in GESTURES + EXPRESSIONS)
"""What must not be taken for a gesture."""


def eased(part: float) -> float:
    """0 to 1 with a soft start and end; what is beyond stays at the end."""
    part = min(1.0, max(0.0, part))
    return part * part * (3 - 2 * part)


def _held(time: float, duration: float, turn: float) -> float:
    """0 to 1 within `turn` seconds, and back at the end."""
    return eased(min(time, duration - time) / turn)


def _swings(time: float, amplitude: float, frequency: float, cycles: float) -> float:
    """A sine that swells and fades within a quarter of a cycle."""
    phase = time * frequency
    return amplitude * eased(4 * min(phase, cycles - phase)) * math.sin(2 * math.pi * phase)


@lru_cache(maxsize=16)
def _phases(seed: int) -> tuple[tuple[float, ...], ...]:
    drawn = np.random.default_rng(seed).uniform(0, 2 * math.pi, (3, 2))
    return tuple(tuple(float(phase) for phase in row) for row in drawn)


def _dice(seed: int) -> random.Random:
    return random.Random(f"motion {seed}")
