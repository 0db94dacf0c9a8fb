"""Identity: distinguishes people while faces cover each other and leave. Looks come first; position
and motion decide between people who look alike, and count less the older they are.
"""

from __future__ import annotations

import math

from hri.vision.tracking.appearance import Look, blended, difference
from hri.vision.tracking.face_track import FaceTrack
from hri.vision.tracking.place import Place

STRANGER = 0.15
"""A face that costs more is someone else: 2 of 100 of one person do, and 99 of 100 of another."""
STRANGER_IN_CROWD = 0.28
"""The same for who may have been covered, and may be so in part."""
PLACE_COST = 0.06
"""Cost of a face far from its predicted place; less when near."""
PLACE_REACH = 2.5
"""Sizes of the face that are nowhere near."""
SIZE_COST = 0.06
"""Cost of a face of very different size; less when similar."""
SIZE_REACH = 0.4
"""Logarithm of the ratio of sizes that is nowhere near."""
PLACE_MEMORY, RETURN_MEMORY = 1.5, 0.5
"""Seconds in which the weight of place and size falls to a third: among those who cover each other,
and of someone who was out of sight alone. Whoever comes where someone left may be anyone."""
COASTING = 0.7
"""Seconds that someone out of sight is taken to walk on."""
PACE_SMOOTHING = 0.25
"""Seconds over which the pace is averaged."""
LEARNING = 0.15
"""Part of a look that each new one makes up."""
UNKNOWN_LOOK = 0.12
"""What the look costs where none of the two can be compared."""


class Identity:
    """One person's look, place and pace."""

    def __init__(self) -> None:
        self._look: Look | None = None
        self._x = self._y = self._breadth = math.nan
        self._pace = 0.0, 0.0
        self._time = -math.inf

    @property
    def is_established(self) -> bool:
        """Whether they were ever seen where they could not be taken for anyone else."""
        return self._time > -math.inf

    def place(self, time: float, place: Place) -> None:
        """See them, or their body, at a time in seconds."""
        x, y, elapsed = place.x, place.y, time - self._time
        if 0 < elapsed < COASTING:
            part = 1 - math.exp(-elapsed / PACE_SMOOTHING)
            old_x, old_y = self._pace
            self._pace = (
                old_x + ((x - self._x) / elapsed - old_x) * part,
                old_y + ((y - self._y) / elapsed - old_y) * part,
            )
        elif elapsed != 0:
            self._pace = 0.0, 0.0
        self._x, self._y, self._breadth, self._time = x, y, place.breadth, time

    def learn(self, look: Look) -> None:
        """Take how they look now."""
        self._look = look if self._look is None else blended(self._look, look, LEARNING)

    def expected(self, time: float) -> tuple[float, float]:
        """Where their face should be then, in pixels."""
        coasting = min(COASTING, max(0.0, time - self._time))
        return self._x + self._pace[0] * coasting, self._y + self._pace[1] * coasting

    def expected_face(self, time: float) -> tuple[float, float, float]:
        """Middle and size of it then, in pixels."""
        return *self.expected(time), self._breadth

    def cost(self, time: float, face: FaceTrack, look: Look, memory: float = PLACE_MEMORY) -> float:
        """How unlikely it is that this face is theirs; above STRANGER it is not.

        `memory`: seconds in which the weight of place and size falls to a third.
        """
        unlike = math.inf if self._look is None else difference(self._look, look)
        if unlike == math.inf:
            unlike = UNKNOWN_LOOK
        known = math.exp(-max(0.0, time - self._time) / memory)
        return unlike + known * self.misfit(time, face)

    def misfit(self, time: float, face: FaceTrack) -> float:
        """How far a face is from where and how large theirs should be; the most when never seen."""
        x, y = self.expected(time)
        away = math.hypot(face.middle[0] - x, face.middle[1] - y) / max(self._breadth, 1.0)
        grown = abs(math.log(max(face.breadth, 1.0) / max(self._breadth, 1.0)))
        misplaced = PLACE_COST * (2 * min(1.0, away / PLACE_REACH) - 1)
        misfit = SIZE_COST * (2 * min(1.0, grown / SIZE_REACH) - 1)
        return misplaced + misfit
