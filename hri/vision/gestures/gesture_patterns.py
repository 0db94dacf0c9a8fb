"""What counts as which gesture of the head: the rows of `config/gestures.toml`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from hri.core import paths
from hri.core.errors import did_you_mean
from hri.core.toml import Table
from hri.vision.gestures.gesture_file import HEAD_GESTURE, chosen, read_gestures
from hri.vision.gestures.oscillation import Swing
from hri.vision.gestures.swing_score import FEATURES, SwingScore

FILE = "gestures.toml"
NOD, SHAKE = "nod", "shake"
ANSWERS = (NOD, SHAKE)
"""The gestures that mean yes and no."""
AXES = ("pitch", "yaw", "roll")
DIRECTIONS = {
    "pitch": {"down": 1, "up": -1},
    "yaw": {"left": 1, "right": -1},
    "roll": {"left": 1, "right": -1},
}
"""The sign of each direction, seen from the person."""
WHEN = {"always": (False, True), "asked": (True,), "unasked": (False,)}
"""Whether a row counts without, or with, a question that waits for an answer."""
HEAVIEST = 100.0
"""Most of a weight of a score, either way."""
MOST_ROWS = 20


@dataclass(frozen=True, slots=True)
class PatternRow:
    """One way to make a gesture: what a run of swings of one angle must satisfy."""

    swings: int
    """How many in a row."""
    width: float
    """Radians, least of each swing."""
    widest: float
    """Radians, most of each swing."""
    duration: float
    """Seconds, most of each swing."""
    quickest: float
    """Seconds, least of a swing, as a mean of those that have ended."""
    dominance: Mapping[str, float]
    """Least ratio, in each swing, of the movement on this axis to that on each other one."""
    rest: float
    """Most that a pair of swings may miss its beginning by, as a part of its wider swing."""
    unevenness: float
    """Most that the widest swing exceeds the narrowest."""
    slowing: float
    """The last swing must have slowed to this part of its top speed; 1 asks nothing."""
    hold: float
    """Seconds that the head must stay where the last swing led it."""
    direction: int
    """Sign of the first swing; 0 for either."""
    score: SwingScore | None
    """What the swings must score above 0 by; None asks nothing."""
    prompted: tuple[bool, ...]
    """For which states of "an answer is expected" the row counts."""

    def fits(self, swings: Sequence[Swing], least: float) -> bool:
        """Whether swings are wide, quick, even, and come back; `least` radians for the noise."""
        widths = [abs(swing.width) for swing in swings]
        return (
            len(swings) == self.swings
            and swings[-1].start - swings[0].start >= self.quickest * (self.swings - 1)
            and self.direction * swings[0].width >= 0
            and min(widths) >= max(self.width, least)
            and max(widths) <= min(self.widest, self.unevenness * min(widths))
            and all(
                abs(out.width + back.width) <= self.rest * max(abs(out.width), abs(back.width))
                for out, back in pairwise(swings)
            )
        )

    def words(self, axis: int) -> str:
        """The row in a line: "asked: 2 swings of pitch, each from 3.5 degrees, within 0.5 s"."""
        when = next(name for name, prompted in WHEN.items() if prompted == self.prompted)
        count = "1 swing" if self.swings == 1 else f"{self.swings} swings"
        words = f"{when}: {count} of {AXES[axis]}, each from {math.degrees(self.width):g} degrees"
        held = f", then {self.hold:g} s still" if self.hold else ""
        return f"{words}, within {self.duration:g} s{held}"


@dataclass(frozen=True, slots=True)
class Pattern:
    """A gesture of the head."""

    gesture: str
    axis: int
    """0 pitch, 1 yaw, 2 roll."""
    event: str
    """Name of its event."""
    about: str
    rows: tuple[PatternRow, ...]


def load_patterns(path: Path | None = None) -> dict[str, Pattern]:
    """The gestures of a file by name; without a path those of `gestures.toml` in the configuration.

    Raises AuthoringError with the place of a mistake, HriError for a file that cannot be read.
    """
    return read_gestures(path or paths.find("config", FILE), HEAD_GESTURE, _pattern)


def answer_patterns() -> list[Pattern]:
    """Nod and shake, as the configuration has them. Raises as `load_patterns`."""
    return chosen(load_patterns(), ANSWERS)


def _pattern(name: str, table: Table) -> Pattern:
    axis = table.string("axis", among=AXES)
    event = table.string("event", f"head.{name}")
    if not event.startswith("head."):
        raise table.error("event", f'event is "{event}"', 'begin it with "head."')
    about = table.string("about", "")
    rows = table.array("row")
    if not 0 < len(rows) <= MOST_ROWS:
        raise table.error("row", f"{len(rows)} rows", f"write 1 to {MOST_ROWS} of [[{name}.row]]")
    pattern = Pattern(
        name, AXES.index(axis), event, about, tuple(_row(axis, below) for below in rows)
    )
    table.finish()
    return pattern


def _row(axis: str, table: Table) -> PatternRow:
    swings = table.number("swings", minimum=1, maximum=6)
    if swings != int(swings):
        raise table.error("swings", f"swings is {swings:g}", "write a whole number")
    hold = table.number("hold_s", 0.0, minimum=0.0, maximum=2.0)
    if swings == 1 and not hold:
        raise table.error(None, "one swing is any movement", "add hold_s, or swings")
    if swings == 1 and "score" in table.data:
        raise table.error("score", "one swing has no score", "take it away, or ask for more swings")
    width = table.number("width_deg", minimum=1.0, maximum=90.0)
    widest = table.number("widest_deg", 360.0, minimum=width)
    first = table.string("first", "either", among=("either", *DIRECTIONS[axis]))
    row = PatternRow(
        swings=int(swings),
        width=math.radians(width),
        widest=math.radians(widest),
        duration=table.number("swing_s", minimum=0.05, maximum=2.0),
        quickest=table.number("quickest_s", 0.0, minimum=0.0, maximum=2.0),
        dominance=_dominance(axis, table),
        rest=table.number("rest", 1.0, minimum=0.0, maximum=1.0),
        unevenness=table.number("unevenness", 5.0, minimum=1.0, maximum=100.0),
        slowing=table.number("slowing", 1.0, minimum=0.05, maximum=1.0),
        hold=hold,
        direction=DIRECTIONS[axis].get(first, 0),
        score=_score(table) if "score" in table.data else None,
        prompted=WHEN[table.string("when", "always", among=tuple(WHEN))],
    )
    table.finish()
    return row


def _score(table: Table) -> SwingScore:
    below = table.table("score")
    bias, width, duration, rest, dominance = (
        float(below.number(name, minimum=-HEAVIEST, maximum=HEAVIEST))
        for name in ("bias", *FEATURES)
    )
    below.finish()
    return SwingScore(bias, (width, duration, rest, dominance))


def _dominance(axis: str, table: Table) -> dict[str, float]:
    below = table.table("dominance", optional=True)
    for name in below.data:
        if name not in AXES or name == axis:
            remedy = did_you_mean(name, [other for other in AXES if other != axis])
            raise below.error(name, f'{axis} cannot be compared with "{name}"', remedy)
    found = below.weights(minimum=0.0, maximum=20.0)
    below.finish()
    return found
