"""One of two values, by a choice."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output
from hri.behavior.reason import Arrived, Reason


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

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        choices = [one for one in arrived if one.input == "choice"]
        if (choice := self.choice.value) is None:
            return Reason("nothing is chosen without a choice", choices)
        chosen = "when_true" if choice else "when_false"
        ways = [one for one in arrived if one.input == chosen]
        given = [one for one in choices if one.value is not None]
        return Reason(f"the choice is {str(choice).lower()}", [*given[:1], *ways])
