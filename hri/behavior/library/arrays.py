"""Splits arrays into numbers, and joins numbers to arrays."""

from __future__ import annotations

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output


class DoubleArraySplitter(Behavior):
    """Sends the first four elements of an array one by one; of a shorter one, those it has."""

    category = "operators"
    array = Input[tuple[float, ...]]("doublearray", "the array")
    first = Output[float]("double", "element 0")
    second = Output[float]("double", "element 1")
    third = Output[float]("double", "element 2")
    fourth = Output[float]("double", "element 3")

    def compute(self, now: float, dt: float) -> None:
        ports = (self.first, self.second, self.third, self.fourth)
        for port, value in zip(ports, self.array.value or (), strict=False):
            port.send(value)


class DoubleArrayJoiner(Behavior):
    """Makes one array of up to four numbers: those of the linked inputs, in order.

    Nothing is sent while one of them is missing, since the others would change places.
    """

    keeps_inputs = False
    category = "operators"
    first = Input[float]("double", "element 0")
    second = Input[float]("double", "the next element")
    third = Input[float]("double", "the next element")
    fourth = Input[float]("double", "the next element")
    array = Output[tuple[float, ...]]("doublearray", "the elements together")

    def compute(self, now: float, dt: float) -> None:
        ports = (self.first, self.second, self.third, self.fourth)
        values = [port.value for port in ports if port.sources]
        elements = tuple(value for value in values if value is not None)
        if elements and len(elements) == len(values):
            self.array.send(elements)
