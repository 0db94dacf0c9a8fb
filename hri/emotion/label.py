"""The one word for a state: the emotion that stands out, else the name of the mood.

An emotion keeps the label until it has faded well below the level that gave it the label, or until
another one clearly leads. Charges decay exponentially, so both moments are known in closed form
when something happens: the label does not depend on when, or how often, anyone looks.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import exp, hypot, inf, log
from typing import NamedTuple

from hri.emotion.emotions import PART_OF, SLOW_SHARES

STANDS_OUT = 0.30
"""Intensity at which an emotion takes the label."""
RISE = -log(1 - STANDS_OUT)
"""The same as a charge."""
FALL = -log(1 - 0.15)
"""Charge at which it loses it again (intensity 0.15)."""
LEAD = 1.15
"""How many times the labeled charge another one must be to take over."""

NOTHING = ""
"""Instead of an emotion's name: none stands out."""

CALM = "calm"
CALM_RADIUS = 0.12
"""A mood within this distance of the origin has no direction worth a name."""
CLEAR = 0.08
"""Least pleasure, either way, of a mood that has a name: less is neither a good nor a bad one."""
NARROW = 0.2
"""Arousal and dominance count as high from this share of the pleasure on: what is hardly anything
does not turn contentment into high spirits."""
MOOD_S = 60.0
"""Seconds for which a mood keeps its name, unless something strong happens."""
STRONG = 1.4
"""Charge of an event that turns the mood, and its name, at once (intensity 0.75)."""

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

_NOTHING_AHEAD: Course = ((0.0, NOTHING),)
_LOG_RISE, _LOG_FALL, _LOG_LEAD = log(RISE), log(FALL), log(LEAD)
_SLOW = {name: -log(1 - share) for name, share in SLOW_SHARES.items()}
"""What the slow part that comes with a quick one adds to it; it fades no faster, so that the sum of
both is never less."""

_STANDS_OUT = {part: exp(log(RISE) - _SLOW.get(part, 0.0)) * (1 - 1e-9) for part in PART_OF}
"""The charge of each part with which its emotion stands out, a little less for rounding."""


def mood_name(mood: Sequence[float]) -> str:
    """The name of a mood given as pleasure, arousal, dominance, each -1 to 1."""
    pleasure, arousal, dominance = mood
    if abs(pleasure) < CLEAR or hypot(pleasure, arousal, dominance) < CALM_RADIUS:
        return CALM
    high = NARROW * abs(pleasure)
    return OCTANTS[pleasure > 0, arousal >= high, dominance >= high]


class Line(NamedTuple):
    """An emotion's charge, or a part of it, over the time in which it is an exponential."""

    emotion: str
    height: float
    """Logarithm of the charge at 0, as if it had begun by then."""
    rate: float
    """Its decay in 1/s, >= 0."""
    start: float = 0.0
    """Seconds."""
    end: float = inf


def course(
    current: str,
    charges: Mapping[str, float],
    rates: Mapping[str, float],
    held: Sequence[Line] = (),
) -> Course:
    """Which emotions have the label from now on, if nothing else happens.

    `current` had it until now, `charges` are those of now by part, `rates` their decay in 1/s,
    above 0; `held` are those that last. An emotion counts as much as its largest part.
    """
    # Charges only fall: an emotion of which no part stands out now will not have the label later.
    standing = {PART_OF[part] for part, charge in charges.items() if charge >= _STANDS_OUT[part]}
    standing.add(current)
    lines = [
        Line(PART_OF[part], height, rates[part])
        for part, charge in charges.items()
        if PART_OF[part] in standing
        and charge
        and (height := log(charge) + _SLOW.get(part, 0.0)) >= _LOG_FALL
    ]
    if not held:
        return tuple(_steps(current, lines, 0.0, inf)) if lines else _NOTHING_AHEAD
    lines += held
    edges = {0.0}.union(*((line.start, line.end) for line in held)) - {inf}
    steps: list[tuple[float, str]] = []
    for begin, end in pairwise((*sorted(edges), inf)):
        there = [line for line in lines if line.start <= begin < line.end]
        following = list(_steps(current, there, begin, end))
        current = following[-1][1]
        if steps and steps[-1][1] == following[0][1]:
            del following[0]
        steps += following
    return tuple(steps)


def _steps(
    current: str, lines: Sequence[Line], begin: float, end: float
) -> Iterator[tuple[float, str]]:
    """The course from a time on until another, between which no line begins or ends."""
    if not any(
        line.emotion == current and line.height - line.rate * begin >= _LOG_FALL for line in lines
    ):
        current = _highest(lines, begin)
    at = begin
    while current != NOTHING:
        until, following = _next_change(current, at, lines)
        if until > at:
            yield at, current
        if until >= end:
            return
        at, current = until, following
    yield at, NOTHING


def label_at(course: Course, seconds: float) -> str:
    """The emotion with the label at a time since the start of a course, seconds."""
    label = NOTHING
    for at, name in course:
        if at > seconds:
            break
        label = name
    return label


def _height(line: Line, now: float) -> float:
    return line.height - line.rate * now


def _highest(lines: Iterable[Line], now: float) -> str:
    """The strongest emotion that stands out; of equals the one that lasts longest."""
    high = [line for line in lines if _height(line, now) >= _LOG_RISE]
    if not high:
        return NOTHING
    # Rounded, since equal charges differ in the last bits once they are divided into parts.
    return min(
        high, key=lambda line: (-round(_height(line, now), 9), line.rate, line.emotion)
    ).emotion


def _next_change(current: str, now: float, lines: Iterable[Line]) -> tuple[float, str]:
    """When the label passes on, and to which emotion; infinitely late for never."""
    own = [line for line in lines if line.emotion == current]
    fades = max(max(_time_at(line, _LOG_FALL) for line in own), now)
    # Of several at the same moment the strongest emotion wins, and any wins over none.
    first = (fades, inf, 0.0, NOTHING)
    for line in lines:
        if line.emotion == current:
            continue
        at, latest = now, min(fades, _time_at(line, _LOG_RISE))
        for mine in own:
            behind, faster = mine.height + _LOG_LEAD - line.height, mine.rate - line.rate
            if faster > 0:
                at = max(at, behind / faster)
            elif behind > faster * at:
                latest = -inf
            elif faster < 0:
                latest = min(latest, behind / faster)
        if at <= latest:
            rival = (at, -_height(line, at), line.rate, line.emotion)
            if rival < first:
                first = rival
    return first[0], first[3]


def _time_at(line: Line, height: float) -> float:
    """When a line falls to a height; in the past if it is below already."""
    above = line.height - height
    if line.rate:
        return above / line.rate
    return inf if above >= 0 else -inf
