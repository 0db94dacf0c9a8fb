"""Whether someone looks at the robot, estimated from the head pose. The head is the best available
cue to the gaze: people turn it along for all but small glances. NAOqi's LookingAtRobotScore has the
same form.
"""

from __future__ import annotations

import math

SURE = math.radians(8)
"""Turned away by less, a head looks at the robot for certain."""
AWAY = math.radians(30)
"""Turned away by more, it does not."""
START, STOP = 0.6, 0.35
"""Scores above which looking begins and below which it ends."""
START_AFTER, STOP_AFTER = 0.2, 0.5
"""Seconds that the score must hold; a blink or one wrong pose changes nothing."""


def looking_score(pitch: float, yaw: float) -> float:
    """How surely a head that is turned so looks at the camera, 0 to 1; angles in radians."""
    away = math.hypot(pitch, yaw)
    if not math.isfinite(away):
        return 0.0
    return min(1.0, max(0.0, (AWAY - away) / (AWAY - SURE)))


class EyeContact:
    """One person's looking, with a start and a stop that do not flutter."""

    def __init__(self) -> None:
        self.is_looking = False
        self._since: float | None = None
        """When the score began to speak against what is so now."""

    def update(self, time: float, score: float) -> bool:
        """Whether they look at the robot, from the score at a time in seconds."""
        speaks_against = score < STOP if self.is_looking else score > START
        if not speaks_against:
            self._since = None
            return self.is_looking
        if self._since is None or time < self._since:
            self._since = time
        if time - self._since >= (STOP_AFTER if self.is_looking else START_AFTER):
            self.is_looking, self._since = not self.is_looking, None
        return self.is_looking
