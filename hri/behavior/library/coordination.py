"""Arbitration between behaviors that want different things."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output, Param
from hri.behavior.reason import Arrived, Reason, decided_by
from hri.core.signals import Twist


class PriorityArbiter(Behavior):
    """Passes the most important wish on: the first link, in the order of the file, that has one."""

    category = "operators"
    input = Input[Any]("any", "wishes of any datatype, the most important link first")
    winner = Output[Any]("any", "the winning value; nothing when there is none")

    def compute(self, now: float, dt: float) -> None:
        if wishes := self.input.values:
            self.winner.send(wishes[0])

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        sent = [one for one in arrived if one.value is not None]
        return decided_by("the first of its inputs that sent something wins", sent[:1])


class VelocityMixer(Behavior):
    """Adds velocities up by their weights, within limits; nothing when nothing comes in.

    A sum beyond the limits shrinks as a whole, so that the robot drives the same curve, slower.
    """

    keeps_inputs = False
    category = "operators"
    first_weight = Param(1.0, "factor on the first velocity")
    second_weight = Param(1.0, "factor on the second velocity")
    third_weight = Param(1.0, "factor on the third velocity")
    max_linear = Param(0.5, "meters a second", minimum=0)
    max_angular = Param(1.5, "radians a second", minimum=0)
    first = Input[Twist]("twist", "a velocity")
    second = Input[Twist]("twist", "another velocity")
    third = Input[Twist]("twist", "one more velocity")
    velocity = Output[Twist]("twist", "what they come to")

    def compute(self, now: float, dt: float) -> None:
        wishes = [
            (weight, port.value)
            for weight, port in (
                (self.first_weight, self.first),
                (self.second_weight, self.second),
                (self.third_weight, self.third),
            )
            if port.value is not None
        ]
        if wishes:
            linear = sum(weight * wish.linear for weight, wish in wishes)
            angular = sum(weight * wish.angular for weight, wish in wishes)
            self.velocity.send(bounded(linear, angular, self.max_linear, self.max_angular))


def bounded(linear: float, angular: float, max_linear: float, max_angular: float) -> Twist:
    """The velocity within both limits, both parts shrunk alike; rest for what is not finite."""
    if not (math.isfinite(linear) and math.isfinite(angular)):
        return Twist()
    share = 1.0
    for value, limit in ((linear, max_linear), (angular, max_angular)):
        if abs(value) > limit:
            share = min(share, limit / abs(value))
    return Twist(
        math.copysign(min(abs(linear) * share, max_linear), linear),
        math.copysign(min(abs(angular) * share, max_angular), angular),
    )


class Inhibit(Behavior):
    """Lets a higher behavior hold a lower one back, or put its own wish in the place.

    The two ways of Brooks' subsumption ("A robust layered control system for a mobile robot",
    1986): without a replacement the lower wish is inhibited, with one it is suppressed.
    """

    keeps_inputs = False
    category = "operators"
    hold_s = Param(0.5, "seconds it is still held back after the inhibitor ends", minimum=0)
    input = Input[Any]("any", "the lower wish")
    inhibitor = Input[Any]("any", "holds it back: any value but false; any count of links")
    replacement = Input[Any]("any", "sent in its place while it is held back")
    output = Output[Any]("any", "the lower wish, its replacement, or nothing")

    def compute(self, now: float, dt: float) -> None:
        if any(value is not False for value in self.inhibitor.values):
            self._until = now + self.hold_s
        self._is_held = now <= self._until
        value = (self.replacement if self._is_held else self.input).value
        if value is not None:
            self.output.send(value)

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        sent = [one for one in arrived if one.value is not None]
        replacement = [one for one in arrived if one.input == "replacement"]
        held_by = [one for one in sent if one.input == "inhibitor" and one.value is not False]
        if held_by:
            return Reason("it is held back by its inhibitor", [*held_by, *replacement])
        if self._is_held:
            return Reason(
                "it is held back still, for hold_s after its inhibitor ended", replacement
            )
        return Reason("nothing holds it back", [one for one in arrived if one.input == "input"])

    _until = -math.inf
    _is_held = False
