"""Idle life: small eye movements, glances, breathing and sway; `blinking` has the blinks.

All of it is a function of (seed, t) alone. Looks and breaths come in rhythms without a grid below
them, and each look and breath is drawn from a hash of seed, kind and number. No state, and any time
can be asked for; each kind draws for itself, so that one more does not shift the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from hri.core.signals import Gaze
from hri.face.motion.chance import chance, drift, log_normal, normal
from hri.face.motion.rhythm import Rhythm
from hri.face.settings import IdleSettings

Place = tuple[float, float]
"""To the right and up."""

_SACCADE_TIME = 0.05
"""Seconds a small eye movement takes (25 ms + 2.4 ms a degree: Lee, Badler & Badler 2002)."""
_GLANCE_TIME = 0.07
"""Seconds a look away takes, there or back: the same for 20 degrees."""
_FIXATIONS = Rhythm("fixation", mean=1.2, spread=0.7, least=0.15)
"""Seconds that the eyes rest on one place of what they look at."""
_MICROSACCADES = Rhythm("microsaccade", mean=0.6, spread=0.4, least=0.15)
"""Seconds between microsaccades: most are .3 to 1."""
_MICRO = (0.1, 0.3)
"""How far a microsaccade leads from the middle of a place, as a share of the larger movements: with
the usual 1.25 degrees for those, most microsaccades are .2 to .5 degrees."""
_AGAIN = 0.3
"""Share of looks that are at a place of the last few again."""
_FEW = 4
_LINGER = (1.0, 3.0)
"""Seconds of a look away that lingers."""
_BREATHS = Rhythm("breath", mean=1.0, spread=0.16, least=0.5)
_BREATH_SPREAD = 0.22
"""Of the depth of breaths; both are the deviations of young people at rest (Tobin et al. 1988)."""
_INHALED = 0.4
"""Share of a breath after which the air is in: people breathe out more slowly than in."""
_SLOW, _FAST = 0.35, 0.95
"""Knots a second of the two waves of a drift: about as fast as sines of 0.07 and 0.19 Hz."""


@dataclass(frozen=True, eq=False)
class Glances:
    """How long the eyes stay on someone and how long away: means and deviations, seconds."""

    stay: tuple[float, float]
    away: tuple[float, float]
    largest: float = 22.7
    """Degrees."""
    linger: float = 0.0
    """Share of looks away that stay there longer."""
    rhythm: Rhythm = field(init=False)
    """Of looks away, from one to the next."""

    def __post_init__(self) -> None:
        mean = self.stay[0] + self.away[0]
        spread = math.hypot(self.stay[1], self.away[1]) / mean
        object.__setattr__(self, "rhythm", Rhythm("glance", mean, spread, 5 * _GLANCE_TIME))


@dataclass(frozen=True, slots=True)
class Life:
    """How a face lives in a state; shares of what its settings say."""

    blinks: float = 1.0
    glances: Glances | None = None
    saccades: float = 1.0
    sway: float = 1.0
    breaths: float = 1.0
    depth: float = 1.0
    """Of each breath."""


STATES: Mapping[str, Life] = {
    "resting": Life(glances=Glances((4.0, 2.5), (0.8, 0.4), linger=0.15)),
    "attending": Life(blinks=0.3, glances=Glances((9.0, 2.0), (0.3, 0.1), 10.0), saccades=0.8),
    "listening": Life(blinks=0.8, glances=Glances((7.9, 1.57), (0.43, 0.23)), sway=0.8),
    "talking": Life(blinks=1.5, glances=Glances((3.13, 3.17), (0.93, 0.8), 27.5, 0.1), sway=1.3),
    "thinking": Life(
        blinks=0.7, glances=Glances((1.6, 0.8), (0.9, 0.4), linger=0.2), sway=0.8, breaths=0.9
    ),
    "asleep": Life(blinks=0.0, saccades=0.0, sway=0.35, breaths=0.6, depth=1.8),
    "error": Life(blinks=0.3, saccades=0.2, sway=0.15, breaths=0.5, depth=0.5),
}
"""What a robot does with its eyes and breath. Blinks: 17 a minute at rest, 26 in talk, 4.5 while
reading (Bentivoglio et al. 1997). Glances of listeners and talkers: Lee, Badler & Badler, "Eyes
Alive" (2002), whose frames are 1/30 s."""

_WAYS = (
    (0, 15.5), (45, 6.5), (90, 17.7), (135, 7.4), (180, 16.8), (225, 7.9), (270, 20.4), (315, 7.8),
)  # fmt: skip
"""Directions of looks away, degrees, and how many of a hundred go there (Eyes Alive)."""
_TYPICAL = 11.0
"""Degrees of a look away that is as large as the face's setting says."""


# --- eyes ---


def wandering(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> Gaze:
    """Where the eyes drift around what they look at: small jumps, and now and then a look away."""
    life = STATES[state]
    size = life.saccades * idle.saccade
    x, y = _glance(idle, life.glances, seed, t) if life.glances else (0.0, 0.0)
    if size:
        for rhythm, place in ((_FIXATIONS, _fixation), (_MICROSACCADES, _microsaccade)):
            jump = _jumping(rhythm, place, seed, t)
            x, y = x + size * jump[0], y + size * jump[1]
    return Gaze(x, y)


def _jumping(rhythm: Rhythm, place: Callable[[int, int], Place], seed: int, t: float) -> Place:
    """At one place after the other, each drawn for a seed and the number of its beat."""
    last = rhythm.beat(seed, t)
    x, y = place(seed, last.number)
    if last.since >= _SACCADE_TIME:
        return x, y
    left = 1 - _smooth(last.since / _SACCADE_TIME)
    old = place(seed, rhythm.beat(seed, t, -1).number)
    return x + (old[0] - x) * left, y + (old[1] - y) * left


@lru_cache(maxsize=256)
def _fixation(seed: int, number: int) -> Place:
    number = _again("fixation", seed, number)
    return _on_circle(seed, "saccade angle", number, chance(seed, "saccade size", number))


@lru_cache(maxsize=256)
def _microsaccade(seed: int, number: int) -> Place:
    least, most = _MICRO
    size = least + (most - least) * chance(seed, "microsaccade size", number)
    return _on_circle(seed, "microsaccade angle", number, size)


def _on_circle(seed: int, kind: str, number: int, size: float) -> Place:
    """Up and down the eyes move less than to the sides."""
    angle = 2 * math.pi * chance(seed, kind, number)
    return size * math.cos(angle), 0.6 * size * math.sin(angle)


def _again(kind: str, seed: int, number: int) -> int:
    """The number of the place to look at: a new one, or one of the last few."""
    share = chance(seed, f"{kind} again", number) / _AGAIN
    return number if share >= 1 else number - 1 - int(_FEW * share)


def _glance(idle: IdleSettings, glances: Glances, seed: int, t: float) -> Place:
    """Each beat is a look away and the stay after it."""
    last, length = glances.rhythm.lasting(seed, t)
    # Some time to stay has to be left until the next look away.
    away = min(_time_away(glances, seed, last.number), 0.7 * length)
    if last.since >= away:
        return 0.0, 0.0
    share = _smooth(last.since / _GLANCE_TIME) * _smooth((away - last.since) / _GLANCE_TIME)
    number = _again("glance", seed, last.number)
    # Magnitudes of Eyes Alive: most looks away are short ones. Those below 3 degrees are left out,
    # since small movements happen all the time anyway.
    degrees = -6.9 * math.log(10 * chance(seed, "glance size", number) / 15.7)
    size = share * idle.aversion * min(degrees, glances.largest) / _TYPICAL
    angle = math.radians(_way(chance(seed, "glance way", number)))
    return size * math.cos(angle), size * math.sin(angle)


@lru_cache(maxsize=256)
def _time_away(glances: Glances, seed: int, number: int) -> float:
    if chance(seed, "glance lingers", number) < glances.linger:
        least, most = _LINGER
        return least + (most - least) * chance(seed, "glance length", number)
    mean, deviation = glances.away
    return max(mean + deviation * normal(seed, "glance length", number), 3 * _GLANCE_TIME)


def _way(share: float) -> float:
    """One of the directions, as often as each is taken."""
    share *= sum(weight for _, weight in _WAYS)
    for degrees, weight in _WAYS:
        share -= weight
        if share < 0:
            return degrees
    return 0


# --- the body ---


def sway(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> dict[str, float]:
    """How the head drifts and breathes: weights of its motions."""
    life = STATES[state]
    moves = {
        name: life.sway * idle.sway * share * _waves(seed, name, t)
        for name, share in (("headX", 0.6), ("headY", 0.35), ("headRoll", 0.7))
    }
    breath = breathing(idle, seed, t, life)
    moves["headY"] -= 0.5 * idle.sway * breath
    moves["headSize"] = 0.6 * idle.sway * breath
    return moves


def turning(idle: IdleSettings, seed: int, t: float, state: str = "resting") -> tuple[float, float]:
    """How a head that turns drifts: weights of headYaw and headPitch."""
    size = STATES[state].sway * idle.sway
    return 0.5 * size * _waves(seed, "headYaw", t), 0.35 * size * _waves(seed, "headPitch", t)


def breathing(idle: IdleSettings, seed: int, t: float, life: Life) -> float:
    """-1 (out) to about 1 (in), times the depth of a breath; no two breaths are alike."""
    t *= idle.breaths * life.breaths / 60
    last, length = _BREATHS.lasting(seed, t)
    phase = last.since / length
    # Out is always as far, and how far in differs: so one breath goes on where the last one ends.
    share = phase / _INHALED if phase < _INHALED else (1 - phase) / (1 - _INHALED)
    depth = min(log_normal(seed, "breath depth", last.number, _BREATH_SPREAD), 1.6)
    return life.depth * (2 * depth * _smooth(share) - 1)


def _waves(seed: int, name: str, t: float) -> float:
    """A slow and a faster wave, which never repeat."""
    slow, fast = drift(seed, "slow " + name, _SLOW * t), drift(seed, "fast " + name, _FAST * t)
    return slow + 0.6 * fast


def _smooth(x: float) -> float:
    """0 below 0, 1 above 1, and a smooth step between."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)
