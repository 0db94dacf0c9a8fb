"""The one word for a state: the emotion that stands out, else the name of the mood.

An emotion keeps the label until it has faded well below the level that gave it the label, or until
another one clearly leads. Charges decay exponentially, so both moments are known in closed form:
the label does not depend on how often anyone looks.
"""

from __future__ import annotations

import math

import numpy as np

from hri.emotion.emotions import Vector

RISE = -math.log(1 - 0.20)
"""Charge at which an emotion takes the label (intensity 0.20)."""
FALL = -math.log(1 - 0.12)
"""Charge at which it loses it again (intensity 0.12)."""
LEAD = 1.15
"""How many times the labelled charge another one must be to take over."""

NOTHING = -1
"""In place of an emotion's index: none stands out."""

CALM = "calm"
CALM_RADIUS = 0.12
"""A mood within this distance of the origin has no direction worth a name."""
EDGE = 0.03
"""An axis counts as negative only below minus this; zero is not negative, as in ALMA."""

OCTANTS = {
    (True, True, True): "exuberant",
    (False, False, False): "bored",
    (True, True, False): "dependent",
    (False, False, True): "disdainful",
    (True, False, True): "relaxed",
    (False, True, False): "anxious",
    (True, False, False): "docile",
    (False, True, True): "hostile",
}
"""Mood names by the signs of pleasure, arousal, dominance (Gebhard 2005, table 1)."""

MOODS = (CALM, *OCTANTS.values())


def mood_name(mood: Vector) -> str:
    """The name of a mood given as pleasure, arousal, dominance."""
    if np.linalg.norm(mood) < CALM_RADIUS:
        return CALM
    pleasure, arousal, dominance = (float(axis) >= -EDGE for axis in mood)
    return OCTANTS[pleasure, arousal, dominance]


def leader(current: int, charges: Vector, rates: Vector, seconds: float) -> int:
    """Index of the emotion that stands out some seconds on, NOTHING for none.

    `current` stood out before, `charges` are those at the start, `rates` their decay in 1/s.
    """
    if current == NOTHING:
        current = int(np.argmax(charges))
        if charges[current] < RISE:
            return NOTHING
    while True:
        wait, successor = _next_change(current, charges, rates)
        if wait > seconds:
            return current
        if successor == NOTHING:
            return NOTHING
        charges = charges * np.exp(-rates * wait)
        seconds -= wait
        current = successor


def _next_change(current: int, charges: Vector, rates: Vector) -> tuple[float, int]:
    """Seconds until the label passes on, and to which emotion."""
    own, rate = float(charges[current]), float(rates[current])
    fades = math.log(own / FALL) / rate if own > FALL else 0.0
    # Of several at the same moment the strongest emotion wins, and any wins over none.
    changes = [(fades, 0.0, NOTHING)]
    for other in range(len(charges)):
        wait = _overtakes_after(own, rate, float(charges[other]), float(rates[other]))
        if other != current and charges[other] * math.exp(-rates[other] * wait) >= RISE:
            changes.append((wait, -float(charges[other]), other))
    wait, _, successor = min(changes)
    return wait, successor


def _overtakes_after(own: float, rate: float, other: float, other_rate: float) -> float:
    """Seconds until `other` is LEAD times `own`; infinite when it never will be."""
    if other >= LEAD * own:
        return 0.0
    if other <= 0 or other_rate >= rate:
        return math.inf
    return math.log(LEAD * own / other) / (rate - other_rate)
