"""What the companion does when a hand shows something.

heed_hands   waves back with its face and a word, stands still before an open hand, and looks where
             someone points

An open hand only ever stops: nothing that a hand shows lets the base move.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from hri.core import FoundObject, Gaze, Hand
from hri.task import TaskContext
from hri.vision import people_of

from .companion import Companion

GREETED_FOR = 20.0
"""Seconds after a wave was answered in which another is answered by the face alone."""
LOOKS_S = 2.0
"""How long it looks where someone points."""
AWAY = 1.0
"""Meters from the hand to where it looks: what is pointed at may be nearer, or farther."""
USUAL_DISTANCE = 1.5
POINTED_FOR = 6.0
"""Seconds for which "this" is what someone pointed at."""
BESIDE = math.radians(25)
"""Most by which what is pointed at lies beside the line of the finger, as it is seen."""
POINTED = "gaze.pointed"
"""Slot of the board with where it looks since someone points there."""
WAVED = "perk"
"""The gesture of the face that answers a wave."""


async def heed_hands(context: TaskContext) -> None:
    """Answer what hands show."""
    companion = Companion.of(context)
    greeted = -math.inf
    with context.queue("hand.waved", "hand.opened", "person.pointed") as queue:
        while True:
            event = await queue.get()
            if event.name == "hand.opened":
                companion.halt()
            elif companion.is_asleep:
                continue
            elif event.name == "person.pointed":
                companion.pointing.start(_look_there, companion, event.properties)
            else:
                companion.make(WAVED)
                if companion.is_calm and event.time - greeted >= GREETED_FOR:
                    greeted = event.time
                    companion.tell("waved")


async def _look_there(context: TaskContext, companion: Companion, told: Mapping[str, Any]) -> None:
    person = people_of(context).person(told["person"])
    hand = next((one for one in person.hands if one.side == told["hand"]), None) if person else None
    if person is None or hand is None:
        return
    companion.pointed = context.clock.now(), hand
    away = person.distance if math.isfinite(person.distance) else USUAL_DISTANCE
    start = _point(hand.bearing, hand.elevation, away)
    way = _point(told["bearing"], told["elevation"], AWAY)
    x, y, z = (first + second for first, second in zip(start, way, strict=True))
    slot = context.board.slot(POINTED)
    slot.set(Gaze(point=(x, y, z)), context.clock.now())
    try:
        await context.clock.sleep(LOOKS_S)
    finally:
        slot.clear()


def pointed_at(hand: Hand, things: tuple[FoundObject, ...]) -> FoundObject | None:
    """Which of these things a hand points at in the picture; None when none is near its line."""
    (x, y), (tip_x, tip_y) = hand.landmarks[5, :2].tolist(), hand.landmarks[8, :2].tolist()
    line = math.atan2(tip_y - y, tip_x - x)

    def beside(thing: FoundObject) -> float:
        return abs(math.remainder(math.atan2(thing.y - tip_y, thing.x - tip_x) - line, math.tau))

    near = [thing for thing in things if beside(thing) <= BESIDE]
    return min(near, key=beside, default=None)


def _point(bearing: float, elevation: float, meters: float) -> tuple[float, float, float]:
    level = meters * math.cos(elevation)
    return (
        level * math.cos(bearing),
        level * math.sin(bearing),
        meters * math.sin(elevation),
    )
