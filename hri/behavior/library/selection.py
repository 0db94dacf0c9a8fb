"""One of two values, by a choice."""

from __future__ import annotations

from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output


class Select(Behavior):
    """Passes one of two values on; nothing without a choice, or when the chosen one is missing."""

    keeps_inputs = False
    category = "operators"
    choice = Input[bool]("boolean", "which one")
    when_true = Input[Any]("any", "sent when the choice is true")
    when_false = Input[Any]("any", "sent when the choice is false")
    selected = Output[Any]("any", "the chosen value")

    def compute(self, now: float, dt: float) -> None:
        choice = self.choice.value
        if choice is not None:
            value = (self.when_true if choice else self.when_false).value
            if value is not None:
                self.selected.send(value)
