"""What counts as which facial expression: the rows of `config/expressions.toml`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.signals import Countenance
from hri.core.toml import Table
from hri.vision.gestures.gesture_file import FACIAL_EXPRESSION, read_gestures

FILE = "expressions.toml"
MEASURES = ("smile", "brows", "blink")
"""Those of a `Countenance`."""


@dataclass(frozen=True, slots=True)
class ExpressionPattern:
    """A facial expression."""

    name: str
    about: str
    measure: str
    begins: float
    """It shows from this on, away from 0."""
    ends: float
    """And until this."""
    hold: float
    """Seconds that it must last; 0 for a brief one."""
    within: float
    """Seconds in which a brief one is over; infinite for one that lasts."""

    @property
    def is_brief(self) -> bool:
        return math.isfinite(self.within)

    def begins_with(self, face: Countenance) -> bool:
        return self._strength(face) >= abs(self.begins)

    def ends_with(self, face: Countenance) -> bool:
        return self._strength(face) <= abs(self.ends)

    def _strength(self, face: Countenance) -> float:
        return math.copysign(1.0, self.begins) * float(getattr(face, self.measure))

    def words(self) -> str:
        """What it asks for: "smile from 0.5 until 0.3, for 0.3 s"."""
        time = f"over within {self.within:g} s" if self.is_brief else f"for {self.hold:g} s"
        return f"{self.measure} from {self.begins:g} until {self.ends:g}, {time}"


def load_expression_patterns(path: Path | None = None) -> dict[str, ExpressionPattern]:
    """The expressions of a file by name; without a path those of `expressions.toml`.

    Raises AuthoringError with the place of a mistake, HriError for a file that cannot be read.
    """
    return read_gestures(path or paths.find("config", FILE), FACIAL_EXPRESSION, _pattern)


def _pattern(name: str, table: Table) -> ExpressionPattern:
    about = table.string("about", "")
    measure = table.string("measure", among=MEASURES)
    begins = table.number("begins", minimum=-1.0, maximum=1.0)
    ends = table.number("ends", minimum=-1.0, maximum=1.0)
    if begins * ends < 0 or not abs(ends) < abs(begins):
        raise table.error("ends", f"ends is {ends:g}", f"write a number from 0 to below {begins:g}")
    hold = table.number("hold_s", 0.0, minimum=0.0, maximum=60.0)
    within = table.number("within_s", 0.0, minimum=0.0, maximum=60.0)
    if bool(hold) == bool(within):
        raise table.error(None, "an expression lasts, or is brief", "write hold_s, or within_s")
    table.finish()
    return ExpressionPattern(name, about, measure, begins, ends, hold, within or math.inf)
