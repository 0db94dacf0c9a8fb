"""What counts as which gesture of a hand: the rows of `config/hands.toml`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.signals import Hand
from hri.core.toml import Table
from hri.vision.gestures.gesture_file import HAND_GESTURE, read_gestures
from hri.vision.hands.hand_shape import POINTING, SHAPES, THUMB

FILE = "hands.toml"
ANY = "any"
DIRECTIONS = {"up": 0.0, "down": math.pi, "any": None}
"""Radians from up in the picture."""
LINES = {THUMB: (2, 4), POINTING: (5, 8)}
"""The points of a hand from which, and to which, a shape is directed."""
USUAL_LINE = (0, 9)


@dataclass(frozen=True, slots=True)
class HandPattern:
    """A gesture of a hand."""

    gesture: str
    event: str
    about: str
    shape: str
    toward: float | None
    """Radians from up in the picture; None for any direction."""
    within: float
    """Radians, most by which it misses that."""
    beyond: float
    """Radians, least by which it misses that."""
    is_palm: bool
    hold: float
    """Seconds for which the hand keeps its shape; 0 for one that swings."""
    still: float
    """Lengths of the palm, most by which it moves meanwhile."""
    swings: int
    width: float
    """Lengths of the palm, least of each swing."""
    duration: float
    """Seconds, most of each swing."""
    share: float
    """Least part of the looks in which the hand has its shape."""

    def fits(self, hand: Hand) -> bool:
        """Whether a hand has the shape and the direction."""
        is_shape = hand.fingers > 0 if self.shape == ANY else hand.shape == self.shape
        if not is_shape or (self.is_palm and not hand.is_palm):
            return False
        if self.toward is None:
            return True
        first, last = LINES.get(hand.shape, USUAL_LINE)
        x, y = (hand.landmarks[last, :2] - hand.landmarks[first, :2]).tolist()
        missed = abs(math.remainder(math.atan2(x, -y) - self.toward, math.tau))
        return self.beyond <= missed <= self.within

    def words(self) -> str:
        """What it asks for: "open, palm, 0 to 40 deg from up: still for 0.5 s"."""
        shape = f"{self.shape}, palm" if self.is_palm else self.shape
        if self.toward is not None:
            name = next(name for name, to in DIRECTIONS.items() if to == self.toward)
            least, most = (round(math.degrees(angle)) for angle in (self.beyond, self.within))
            shape += f", {least} to {most} deg from {name}"
        if self.swings:
            swings = f"{self.swings} swings of {self.width:g} palms within {self.duration:g} s each"
            return f"{shape}: {swings}"
        return f"{shape}: still for {self.hold:g} s"


def load_hand_patterns(path: Path | None = None) -> dict[str, HandPattern]:
    """The gestures of a file by name; without a path those of `hands.toml` in the configuration.

    Raises AuthoringError with the place of a mistake, HriError for a file that cannot be read.
    """
    return read_gestures(path or paths.find("config", FILE), HAND_GESTURE, _pattern)


def _pattern(name: str, table: Table) -> HandPattern:
    event = table.string("event")
    if not event.startswith(("hand.", "person.")):
        raise table.error("event", f'event is "{event}"', 'begin it with "hand." or "person."')
    swings = table.number("swings", 0.0, minimum=0.0, maximum=8.0)
    if swings != int(swings):
        raise table.error("swings", f"swings is {swings:g}", "write a whole number")
    hold = table.number("hold_s", 0.0, minimum=0.0, maximum=5.0)
    if bool(swings) == bool(hold):
        raise table.error(None, "a gesture holds still, or swings", "write hold_s, or swings")
    pattern = HandPattern(
        name,
        event,
        table.string("about", ""),
        table.string("shape", among=(*SHAPES, ANY)),
        DIRECTIONS[table.string("toward", "any", among=tuple(DIRECTIONS))],
        math.radians(table.number("within_deg", 180.0, minimum=1.0, maximum=180.0)),
        math.radians(table.number("beyond_deg", 0.0, minimum=0.0, maximum=179.0)),
        table.flag("palm"),
        hold,
        table.number("still", 100.0, minimum=0.01, maximum=100.0),
        int(swings),
        table.number("width", 0.4, minimum=0.05, maximum=20.0),
        table.number("swing_s", 0.8, minimum=0.05, maximum=3.0),
        table.number("share", 0.75, minimum=0.1, maximum=1.0),
    )
    table.finish()
    return pattern
