"""Sums, products, extremes. Missing inputs are ignored; without any, nothing is sent. Nor is
a result that is NaN, such as infinity minus infinity.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output, OutputPort
from hri.behavior.reason import Arrived, Reason, decided_by, with_value


class Addition(Behavior):
    """The sum of all inputs; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "numbers to add, any count of links")
    sum = Output[float]("double", "their sum")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            send_number(self.sum, sum(values))


class Subtraction(Behavior):
    """The positive inputs less the negative ones; nothing when nothing positive comes in."""

    keeps_inputs = False
    category = "operators"
    input_positive = Input[float]("double", "numbers to add, any count of links")
    input_negative = Input[float]("double", "numbers to take away, any count of links")
    difference = Output[float]("double", "what is left")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input_positive.values:
            send_number(self.difference, sum(values) - sum(self.input_negative.values))


class Multiplication(Behavior):
    """The product of all inputs; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "numbers to multiply, any count of links")
    product = Output[float]("double", "their product")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            send_number(self.product, math.prod(values))


class Division(Behavior):
    """One number divided by another; nothing when one is missing, or the divisor is zero."""

    keeps_inputs = False
    category = "operators"
    dividend = Input[float]("double", "what is divided")
    divisor = Input[float]("double", "what it is divided by")
    quotient = Output[float]("double", "dividend / divisor")

    def compute(self, now: float, dt: float) -> None:
        dividend, divisor = self.dividend.value, self.divisor.value
        if dividend is not None and divisor:
            send_number(self.quotient, dividend / divisor)

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        zero = [one for one in arrived if one.input == "divisor" and one.value == 0]
        return decided_by("nothing can be divided by 0", zero)


class Minimum(Behavior):
    """The least of all inputs; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "numbers, any count of links")
    minimum = Output[float]("double", "the least of them")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            send_number(self.minimum, min(values))

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        return decided_by("the least of its inputs", with_value(value, arrived))


class Maximum(Behavior):
    """The greatest of all inputs; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "numbers, any count of links")
    maximum = Output[float]("double", "the greatest of them")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            send_number(self.maximum, max(values))

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        return decided_by("the greatest of its inputs", with_value(value, arrived))


class Absolute(Behavior):
    """A number without its sign; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "a number")
    magnitude = Output[float]("double", "how large it is")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            send_number(self.magnitude, abs(value))


def send_number(port: OutputPort[float], value: float) -> None:
    """Send a result, unless it is NaN."""
    if not math.isnan(value):
        port.send(value)
