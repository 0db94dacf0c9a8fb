"""Combines booleans. Missing inputs are ignored."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output
from hri.behavior.reason import Arrived, Reason, decided_by, with_value


class And(Behavior):
    """Whether all that came in is true; nothing when nothing comes in."""

    category = "operators"
    input = Input[bool]("boolean", "truths, any count of links")
    result = Output[bool]("boolean", "true when all are true")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            self.result.send(all(values))

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        return decided_by("one of its inputs is false", with_value(False, arrived))


class Or(Behavior):
    """Whether something that came in is true; nothing when nothing comes in."""

    category = "operators"
    input = Input[bool]("boolean", "truths, any count of links")
    result = Output[bool]("boolean", "true when one of them is true")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            self.result.send(any(values))

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        return decided_by("one of its inputs is true", with_value(True, arrived))


class Not(Behavior):
    """The opposite of a truth; nothing when nothing comes in."""

    category = "operators"
    input = Input[bool]("boolean", "a truth")
    result = Output[bool]("boolean", "true when the input is false")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self.result.send(not value)
