"""The board in a network: links take values from its slots and put values there.

    <Link from="board.speech" to="listener.speech"/>
    <Link from="voice.speech" to="board.speech"/>

A network that has such links has two ends of the board: one runs before all that reads from it,
the other after all that writes to it. A slot empties when nothing comes in a tick, and when the
network stops.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import NOTHING
from hri.behavior.ports import ANY, Input, InputPort, Output, OutputPort
from hri.core.latest import Latest

log = logging.getLogger("hri.network")

BOARD = "board"
"""What a link calls the board; a behavior of that id goes before it."""


@dataclass(frozen=True)
class Slot:
    """What the program itself knows of a slot."""

    name: str
    datatype: str
    about: str
    """What its value means, and who writes or reads it besides networks."""


DECLARED = {
    slot.name: slot
    for slot in (
        Slot("drive.command", "twist", "what tasks ask the base for"),
        Slot("drive.goal", "pose", "where tasks send the base"),
        Slot("expression.override", "expression", "what tasks let the face show"),
        Slot("people", "people", "everyone who is seen; tasks read it"),
        Slot("question.open", "boolean", "true while a task waits for an answer"),
    )
}
"""The slots that tasks write or read, by name; `declare_slot` adds to them."""


def declare_slot(name: str, datatype: str, about: str) -> str:
    """Say what a slot carries that tasks of yours use, so that links to it are checked; its name.

    `datatype` is one of `hri.behavior.ports.DATATYPES`.
    """
    DECLARED[name] = Slot(name, datatype, about)
    return name


class _BoardEnd(Behavior):
    """One of the two ends; its ports are the slots that links name."""

    may_do = NOTHING

    def __init__(self) -> None:
        super().__init__(BOARD)
        self.inputs, self.outputs = {}, {}  # type: ignore[misc]
        # Not attributes: a slot may be called "stop" or "id".
        self._in: dict[str, InputPort[Any]] = {}
        self._out: dict[str, OutputPort[Any]] = {}

    def input_port(self, name: str) -> InputPort[Any]:
        return self._in[name]

    def output_port(self, name: str) -> OutputPort[Any]:
        return self._out[name]

    def start(self, context: Context) -> None:
        names = (*self.inputs, *self.outputs)
        self._slots: dict[str, Latest[Any]] = {name: context.board.slot(name) for name in names}


class BoardSource(_BoardEnd):
    """Sends what stands in the slots that links read."""

    is_sensor = is_relay = True

    def add(self, slot: str, datatype: str) -> None:
        """Make the output of a slot, for what takes a datatype."""
        if slot not in self.outputs or self.outputs[slot].datatype == ANY:
            self.outputs[slot] = Output(datatype, f"what stands in the slot {slot}")
            self._out.setdefault(slot, OutputPort()).restrict(datatype)

    def start(self, context: Context) -> None:
        super().start(context)
        self._wrong: set[str] = set()

    def compute(self, now: float, dt: float) -> None:
        for name, slot in self._slots.items():
            if (value := slot.value) is None:
                continue
            port = self.output_port(name)
            if port.takes(value):
                port.send(value, slot.spoken)
            elif name not in self._wrong:
                self._wrong.add(name)
                what = "the slot %s holds %.60r, written by %s - a %s is wanted"
                log.warning(what, name, value, slot.writer, self.outputs[name].datatype)


class BoardSink(_BoardEnd):
    """Puts what comes in into the slots that links write."""

    def __init__(self) -> None:
        super().__init__()
        self._writers: dict[OutputPort[Any], str] = {}

    def add(self, slot: str) -> None:
        """Make the input of a slot."""
        if slot not in self.inputs:
            self.inputs[slot] = Input(ANY, f"what comes to stand in the slot {slot}")
            self._in[slot] = InputPort()

    def name_writer(self, port: OutputPort[Any], writer: str) -> None:
        """Say who writes by a port: what the slot names with its value."""
        self._writers[port] = writer

    def compute(self, now: float, dt: float) -> None:
        for name, slot in self._slots.items():
            source = self.input_port(name).source
            if source is None:
                slot.clear()
            else:
                slot.set(source.value, now, source.spoken, self._writers.get(source, BOARD))

    def stop(self) -> None:
        """What it wrote ends with it: nobody is there who could change it."""
        for slot in self._slots.values():
            slot.clear()
