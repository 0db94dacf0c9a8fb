"""What people show with a hand: its shape, and where it is, as functions of time."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.simulation.people.body_motion import eased

RISE = 0.45
"""Seconds in which a hand is raised, and lowered again."""
LAP = 0.8
"""Meters by which it is lower at rest."""
OPEN = (True,) * 5
THUMB = (True, False, False, False, False)
INDEX = (False, True, False, False, False)


@dataclass(frozen=True, slots=True)
class HeldHand:
    """A left hand at a moment, seen from the front; a right one is its mirror image."""

    straight: tuple[bool, ...]
    """Which fingers are straight, the thumb first."""
    turn: float
    """Radians clockwise in the picture, from fingers up."""
    aside: float
    """Meters from the middle of the head to the outside."""
    down: float
    """Meters."""


@dataclass(frozen=True, slots=True)
class HandMotion:
    """A hand that is raised, shows something, and is lowered."""

    straight: tuple[bool, ...] = OPEN
    turn: float = 0.0
    """Radians."""
    aside: float = 0.26
    """Meters, while it is up."""
    down: float = 0.1
    swing: float = 0.0
    """Radians to each side."""
    hertz: float = 1.4

    def at(self, elapsed: float, held: float) -> HeldHand | None:
        """Seconds after it began to rise, of a hand that is up for `held` seconds; None at rest."""
        duration = 2 * RISE + held
        if not 0 < elapsed < duration:
            return None
        raised = eased(min(elapsed, duration - elapsed) / RISE)
        swing = self.swing * math.sin(math.tau * self.hertz * elapsed)
        down = self.down + (1 - raised) * LAP
        return HeldHand(self.straight, self.turn + swing, self.aside, down)


HAND_MOTIONS = {
    "wave": HandMotion(swing=0.45),
    "stop": HandMotion(),
    "thumb_up": HandMotion(THUMB, turn=0.9, down=0.2),
    "thumb_down": HandMotion(THUMB, turn=-2.3, down=0.2),
    "point": HandMotion(INDEX, turn=1.3, aside=0.2, down=0.2),
}
"""By the names of `config/hands.toml`."""
