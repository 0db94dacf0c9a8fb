"""The one word for a state: the emotion that stands out, else the name of the mood.

An emotion keeps the label until it has faded well below the level that gave it the label, or until
another one clearly leads. Charges decay exponentially, so both moments are known in closed form
when something happens: the label does not depend on when, or how often, anyone looks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import exp, hypot, log

STANDS_OUT = 0.20
"""Intensity at which an emotion takes the label."""
RISE = -log(1 - STANDS_OUT)
"""The same as a charge."""
FALL = -log(1 - 0.12)
"""Charge at which it loses it again (intensity 0.12)."""
LEAD = 1.15
"""How many times the labeled charge another one must be to take over."""

NOTHING = ""
"""Instead of an emotion's name: none stands out."""

CALM = "calm"
CALM_RADIUS = 0.12
"""A mood within this distance of the origin has no direction worth a name."""
EDGE = 5e-5
"""An axis counts as negative only below minus this, which is written as zero; zero is not negative,
as in ALMA."""

OCTANTS = {
    (True, True, True): "exuberant",
    (False, False, False): "bored",
    (True, True, False): "trusting",
    (False, False, True): "disdainful",
    (True, False, True): "relaxed",
    (False, True, False): "anxious",
    (True, False, False): "peaceful",
    (False, True, True): "hostile",
}
"""Mood names by the signs of pleasure, arousal, dominance: those of Gebhard 2005, table 1, where
they are names that people have for their own mood."""

FORMER = {"dependent": "trusting", "docile": "peaceful"}
"""Gebhard's other names, which older files use."""

MOODS = (CALM, *OCTANTS.values())


def known_as(label: str) -> str:
    """The name that a label has today."""
    return FORMER.get(label, label)


Course = tuple[tuple[float, str], ...]
"""The course of the label: times in seconds, rising from 0, with an emotion each; the last is
NOTHING or stays.
"""

_LOG_RISE, _LOG_FALL, _LOG_LEAD = log(RISE), log(FALL), log(LEAD)


def mood_name(mood: Sequence[float]) -> str:
    """The name of a mood given as pleasure, arousal, dominance, each -1 to 1."""
    pleasure, arousal, dominance = mood
    if hypot(pleasure, arousal, dominance) < CALM_RADIUS:
        return CALM
    return OCTANTS[pleasure >= -EDGE, arousal >= -EDGE, dominance >= -EDGE]


def course(current: str, charges: Mapping[str, float], rates: Mapping[str, float]) -> Course:
    """Which emotions have the label from now on, if nothing else happens.

    `current` had it until now, `charges` are those of now, `rates` their decay in 1/s, above 0.
    """
    # On a logarithmic scale charges fade along straight lines.
    heights = {
        name: log(charge)
        for name, charge in charges.items()
        if charge >= FALL and (charge >= RISE or name == current)
    }
    if current not in heights:
        current = _highest(heights, rates)
    steps = [(0.0, current)]
    while current != NOTHING:
        at, current = _next_change(current, steps[-1][0], heights, rates)
        if at == steps[-1][0]:
            steps.pop()
        steps.append((at, current))
    return tuple(steps)


def label_at(course: Course, seconds: float) -> str:
    """The emotion with the label at a time since the start of a course, seconds."""
    label = NOTHING
    for at, name in course:
        if at > seconds:
            break
        label = name
    return label


def _highest(heights: Mapping[str, float], rates: Mapping[str, float]) -> str:
    """The strongest emotion; of equals the one that lasts longest."""
    if not heights:
        return NOTHING
    return min(heights, key=lambda name: (-heights[name], rates[name], name))


def _next_change(
    current: str, now: float, heights: Mapping[str, float], rates: Mapping[str, float]
) -> tuple[float, str]:
    """When the label passes on, and to which emotion."""
    own, rate = heights[current], rates[current]
    fades = max((own - _LOG_FALL) / rate, now)
    # Of several at the same moment the strongest emotion wins, and any wins over none.
    first = (fades, 0.0, 0.0, NOTHING)
    to_beat = own + _LOG_LEAD
    for name, height in heights.items():
        if name == current:
            continue
        behind, faster = to_beat - height, rate - rates[name]
        if behind <= faster * now:
            at = now
        elif faster > 0:
            at = behind / faster
        else:
            continue
        if at <= fades and height - rates[name] * at >= _LOG_RISE:
            rival = (at, -exp(height), rates[name], name)
            if rival < first:
                first = rival
    return first[0], first[3]
