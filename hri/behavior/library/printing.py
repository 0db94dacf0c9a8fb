"""What arrives, shown to people: the formats of 2003, `%g` for numbers.

What is longer than a screen is cut. Infinity, which means "nothing in range", shows as
1.79769e+308, the largest number there is.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import DATATYPES, DBL_MAX, Input, Param
from hri.core.quoting import escaped, quoted
from hri.core.signals import Frame, Utterance

MOST_NUMBERS = 100
"""Numbers of an array that are shown; a value from outside must not fill the disk with output."""
LONGEST_TEXT = 1000
"""Characters of a text that are shown."""

_NAMES = {kind: name for name, kind in DATATYPES.items() if kind is not object} | {int: "double"}
"""Labels of the built-in datatypes; others are named by their class."""


class InputCollector(Behavior):
    """Keeps, and prints, whatever arrives, over any count of links."""

    input = Input[Any]("any", "values of any datatype, any count of links")
    print_input = Param(True, "print what arrives")

    def compute(self, now: float, dt: float) -> None:
        self.collected = self.input.values
        if self.print_input:
            for value in self.collected:
                print(f"Input {self.id}  {labeled(value)}")

    collected: list[Any] = []
    """What arrived in the last tick, in the order of the links."""


class PrintBehavior(Behavior):
    """Prints whatever arrives, after a text of your choice."""

    text = Param("", "stands before each value")
    input = Input[Any]("any", "values of any datatype, any count of links")

    def compute(self, now: float, dt: float) -> None:
        for value in self.input.values:
            print(f"{self.text}{worded(value)}")


def labeled(value: object) -> str:
    """A value with its datatype: `double: 7.62887`, `string: cup`, or `DoubleArray.` and lines."""
    if isinstance(value, tuple):
        shown = [f"{i}: {worded(x)}" for i, x in enumerate(value[:MOST_NUMBERS])]
        return "\n".join(["DoubleArray.", *shown, *_more(value)])
    return f"{_NAMES.get(type(value), type(value).__name__)}: {worded(value)}"


def worded(value: object) -> str:
    """A value as people read it."""
    match value:
        case bool():
            return str(value).lower()
        case int() | float():
            # This order keeps NaN.
            return f"{max(min(value, DBL_MAX), -DBL_MAX):g}"
        case tuple():
            return f"({', '.join([*map(worded, value[:MOST_NUMBERS]), *_more(value)])})"
        case Frame():
            height, width = value.image.shape[:2]
            return f"{width} x {height}, number {value.sequence}"
        case Utterance():
            meaning = f"{value.rule} {dict(value.tags)}"
            return f'"{escaped(value.text)}" is {meaning}, confidence {value.confidence:.2f}'
    if is_dataclass(value):
        return ", ".join(f"{f.name} {worded(getattr(value, f.name))}" for f in fields(value))
    return quoted(str(value), LONGEST_TEXT)


def _more(values: tuple[object, ...]) -> list[str]:
    """A note that there are more than are shown; empty when there are not."""
    rest = len(values) - MOST_NUMBERS
    return [f"and {rest} more"] if rest > 0 else []
