"""General blocks: constants, sums, collectors, and the slots where networks meet."""

from __future__ import annotations

import sys
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.latest import Latest

DBL_MAX = sys.float_info.max


class Constant(Behavior):
    """Sends the same number at every tick."""

    category = "operators"
    parsed_value = Param(0.0, "the number")
    value = Output[float]("double", "the number")

    def compute(self, now: float, dt: float) -> None:
        self.value.send(self.parsed_value)


class Addition(Behavior):
    """The sum of all inputs; nothing when nothing comes in."""

    category = "operators"
    input = Input[float]("double", "numbers to add")
    sum = Output[float]("double", "their sum")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input.values:
            self.sum.send(sum(values))


class Subtraction(Behavior):
    """The positive inputs less the negative ones; nothing when nothing positive comes in."""

    category = "operators"
    input_positive = Input[float]("double", "numbers to add")
    input_negative = Input[float]("double", "numbers to take away")
    difference = Output[float]("double", "what is left")

    def compute(self, now: float, dt: float) -> None:
        if values := self.input_positive.values:
            self.difference.send(sum(values) - sum(self.input_negative.values))


class DoubleArraySplitter(Behavior):
    """Sends the first four elements of an array one by one."""

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


class InputCollector(Behavior):
    """Keeps, and on request prints, the numbers that arrive."""

    input = Input[float]("double", "numbers, any count of links")
    print_input = Param(True, "print what arrives")

    def compute(self, now: float, dt: float) -> None:
        self.collected = self.input.values
        if self.print_input:
            for value in self.collected:
                print(f"Input {self.id}  double: {min(value, DBL_MAX):g}")

    collected: list[float] = []


class Share(Behavior):
    """Puts what comes in on the robot's board, for other networks and tasks."""

    slot = Param("", "name of the slot on the board")
    emotion = Input[Any]("emotion", "an emotion state")
    expression = Input[Any]("expression", "an expression")
    prosody = Input[Any]("prosody", "how to say things")
    gaze = Input[Any]("gaze", "where to look")
    number = Input[Any]("double", "a number")
    truth = Input[Any]("boolean", "a truth")
    speech = Input[Any]("speech", "the speech that plays")
    twist = Input[Any]("twist", "a velocity")
    pose = Input[Any]("pose", "a pose")
    head = Input[Any]("headpose", "the head that is seen")

    def start(self, context: Context) -> None:
        self._slot: Latest[Any] = context.board.slot(self.slot)
        self._inputs = [getattr(self, name) for name in self.inputs]

    def compute(self, now: float, dt: float) -> None:
        for port in self._inputs:
            if port.sources:
                if port.value is None:
                    self._slot.clear()
                else:
                    self._slot.set(port.value, now)


class Shared(Behavior):
    """Takes the newest value of a slot of the robot's board; link the port of its type."""

    slot = Param("", "name of the slot on the board")
    emotion = Output[Any]("emotion", "an emotion state")
    expression = Output[Any]("expression", "an expression")
    prosody = Output[Any]("prosody", "how to say things")
    gaze = Output[Any]("gaze", "where to look")
    number = Output[Any]("double", "a number")
    truth = Output[Any]("boolean", "a truth")
    speech = Output[Any]("speech", "the speech that plays")
    twist = Output[Any]("twist", "a velocity")
    pose = Output[Any]("pose", "a pose")
    head = Output[Any]("headpose", "the head that is seen")

    def start(self, context: Context) -> None:
        self._slot: Latest[Any] = context.board.slot(self.slot)
        self._outputs = [getattr(self, name) for name in self.outputs]

    def compute(self, now: float, dt: float) -> None:
        value, _ = self._slot.get()
        if value is not None:
            for port in self._outputs:
                port.send(value)
