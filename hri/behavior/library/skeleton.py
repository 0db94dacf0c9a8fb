"""A behavior to copy: replace `Skeleton` by the name of yours, then declare and compute.

Declare it under `[project.entry-points."hri.behaviors"]` of your package, or put a schema with
`library="skeleton.py"` beside it in a search folder; `hri new behavior NAME` does that for you.
"""

from __future__ import annotations

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param


class SkeletonBehavior(Behavior):
    """Passes a number on, times a gain: put your own arithmetic in its place."""

    category = "sample_code"
    gain = Param(1.0, "what the number is multiplied with", minimum=0)
    input = Input[float]("double", "a number")
    output = Output[float]("double", "the number times the gain; nothing without a number")

    def start(self, context: Context) -> None:
        """Take what you need: `context.resources.obtain(id, Interface)`, `context.clock`."""

    def compute(self, now: float, dt: float) -> None:
        """One tick. Never wait in here."""
        if (value := self.input.value) is not None:
            self.output.send(value * self.gain)

    def stop(self) -> None:
        """Give back what `start` took."""
