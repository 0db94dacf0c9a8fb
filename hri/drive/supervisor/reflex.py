"""What the base does by itself when it touches something or stands at an edge.

It stops, backs off a hand's breadth, and turns away from the side where that was; then it obeys
again. Each part is bounded in time, should the wheels not turn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from hri.core.signals import Twist
from hri.drive.supervisor.cause import Cause
from hri.drive.supervisor.hazards import Hazard, Sensor
from hri.hal.motion import REST, Way

PAUSE = 0.1
"""Seconds that it stands before it backs off."""
BACK_OFF = 0.1
"""Meters; an edge seen at the rim is then behind the sensors of a base 0.3 m wide."""
BACK_SPEED = 0.1
"""Meters a second."""
TURN_AWAY = 0.6
"""Radians."""
TURN_RATE = 0.8
"""Radians a second."""
LONGEST = 2.5
"""Seconds for each part."""
STALLED = 0.6
"""Seconds without progress after which a part is over: something else is in the way. That is sooner
than wheels that stand although they are told to turn count as a fault."""
PROGRESS = 0.005
"""Meters or radians that count as some."""


class _Part(Enum):
    STAND = 0
    BACK = 1
    TURN = 2


@dataclass(slots=True)
class _Course:
    part: _Part
    began: float
    origin: Way
    backs_off: bool
    gone: float = 0.0
    """Meters or radians, as of the last progress."""
    gone_at: float = -math.inf


class Reflex:
    """Begins with what is newly sensed while the base moves; goes on until it is done."""

    def __init__(self) -> None:
        self.cause: Cause | None = None
        """What it answers to; None while there is nothing."""
        self._course: _Course | None = None
        self._side = 1
        """Where it last was: 1 left, -1 right."""
        self._known: set[Sensor] = set()

    def cancel(self) -> None:
        """Go no further."""
        self._course = self.cause = None

    def step(
        self, now: float, hazards: Sequence[Hazard], rolled: Way, going: Twist
    ) -> Twist | None:
        """What it wants; None when it wants nothing. `going` is what the base was told last."""
        sensed = [hazard for hazard in hazards if hazard.is_sensed]
        news = [hazard for hazard in sensed if hazard.sensor not in self._known]
        self._known = {hazard.sensor for hazard in sensed}
        if news and going != REST:
            self._begin(now, news, rolled, going)
        return self._wanted(now, rolled)

    def _begin(self, now: float, news: Sequence[Hazard], rolled: Way, going: Twist) -> None:
        side = sum(hazard.side for hazard in news)
        if side:
            self._side = 1 if side > 0 else -1
        self.cause = news[0].cause
        # What touches a base that backs off already is not ahead.
        backs_off = going.linear >= 0 and not any(hazard.is_behind for hazard in news)
        self._course = _Course(_Part.STAND, now, rolled, backs_off)

    def _wanted(self, now: float, rolled: Way) -> Twist | None:
        course = self._course
        if course is None:
            return None
        if self._is_over(course, now, rolled):
            self._go_on(course, now, rolled)
            return self._wanted(now, rolled)
        if course.part is _Part.STAND:
            return REST
        if course.part is _Part.BACK:
            return Twist(-BACK_SPEED)
        return Twist(0.0, -self._side * TURN_RATE)

    def _is_over(self, course: _Course, now: float, rolled: Way) -> bool:
        elapsed = now - course.began
        if course.part is _Part.STAND:
            return elapsed >= PAUSE
        if course.part is _Part.BACK:
            gone, goal = course.origin.linear - rolled.linear, BACK_OFF
        else:
            gone, goal = abs(rolled.angular - course.origin.angular), TURN_AWAY
        if gone >= course.gone + PROGRESS or course.gone_at == -math.inf:
            course.gone, course.gone_at = gone, now
        return gone >= goal or elapsed >= LONGEST or now - course.gone_at > STALLED

    def _go_on(self, course: _Course, now: float, rolled: Way) -> None:
        if course.part is _Part.TURN or not course.backs_off:
            self.cancel()
        else:
            part = _Part(course.part.value + 1)
            self._course = _Course(part, now, rolled, course.backs_off)
