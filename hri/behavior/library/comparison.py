"""Compares two numbers; nothing is sent when one of them is missing."""

from __future__ import annotations

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output, Param


class Greater(Behavior):
    """Whether the first number is greater than the second; nothing when one is missing."""

    category = "operators"
    first = Input[float]("double", "a number")
    second = Input[float]("double", "what it is compared with")
    is_greater = Output[bool]("boolean", "true when first > second")

    def compute(self, now: float, dt: float) -> None:
        first, second = self.first.value, self.second.value
        if first is not None and second is not None:
            self.is_greater.send(first > second)


class Less(Behavior):
    """Whether the first number is less than the second; nothing when one is missing."""

    category = "operators"
    first = Input[float]("double", "a number")
    second = Input[float]("double", "what it is compared with")
    is_less = Output[bool]("boolean", "true when first < second")

    def compute(self, now: float, dt: float) -> None:
        first, second = self.first.value, self.second.value
        if first is not None and second is not None:
            self.is_less.send(first < second)


class Equal(Behavior):
    """Whether two numbers are as good as the same; nothing when one is missing."""

    category = "operators"
    tolerance = Param(1e-9, "how far apart they may be", minimum=0)
    first = Input[float]("double", "a number")
    second = Input[float]("double", "what it is compared with")
    is_equal = Output[bool]("boolean", "true when they differ by no more than the tolerance")

    def compute(self, now: float, dt: float) -> None:
        first, second = self.first.value, self.second.value
        if first is not None and second is not None:
            # Infinity equals itself, though inf - inf is NaN.
            self.is_equal.send(first == second or abs(first - second) <= self.tolerance)
