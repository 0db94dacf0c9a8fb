"""Behaviors for slots of the board, from before links named slots; old networks still load."""

from __future__ import annotations

from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError
from hri.core.latest import Latest


class _OnBoard(Behavior):
    """Uses a slot of the robot's board."""

    slot = Param("", "name of the slot on the board")

    def check(self) -> None:
        """Raises HriError when it has no slot."""
        if not self.slot:
            raise HriError(f"{self.id} has no slot on the board - set its parameter slot")


class Share(_OnBoard):
    """Puts what comes in on the robot's board, for other networks and tasks."""

    may_do = NOTHING
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
    people = Input[Any]("people", "everyone who is seen")

    def start(self, context: Context) -> None:
        self._slot: Latest[Any] = context.board.slot(self.slot)
        self._inputs = [self.input_port(name) for name in self.inputs]

    def compute(self, now: float, dt: float) -> None:
        for port in self._inputs:
            if port.sources:
                if port.value is None:
                    self._slot.clear()
                else:
                    self._slot.set(port.value, now, port.spoken)

    def stop(self) -> None:
        """Clear the slot, since nobody updates it anymore."""
        self._slot.clear()


class Shared(_OnBoard):
    """Takes the newest value of a slot of the robot's board; the port of its type sends it."""

    is_relay = True
    may_do = NOTHING
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
    people = Output[Any]("people", "everyone who is seen")

    def start(self, context: Context) -> None:
        self._slot: Latest[Any] = context.board.slot(self.slot)
        self._outputs = [getattr(self, name) for name in self.outputs]

    def compute(self, now: float, dt: float) -> None:
        value, _ = self._slot.get()
        if value is not None:
            for port in self._outputs:
                if port.takes(value):
                    port.send(value, self._slot.spoken)
