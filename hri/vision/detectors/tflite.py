"""Networks in TensorFlow Lite files: their tensors and operations.

A file is a FlatBuffer (https://flatbuffers.dev/internals); the numbers of fields are those of
TensorFlow's `schema.fbs`. Only files of a known checksum are read, so nothing is checked again.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

KINDS = {0: "<f4", 1: "<f2", 2: "<i4"}
"""Types of tensors by their number."""


@dataclass(frozen=True, slots=True)
class Fields:
    """A table of a FlatBuffer, whose fields are numbered."""

    content: bytes
    place: int
    """Bytes from the beginning, of the table."""

    def number(self, field: int, kind: str = "i", usual: int = 0) -> int:
        """A number, of a kind of `struct`; `usual` where it is left out."""
        there = self._there(field)
        return self._read(kind, there) if there else usual

    def table(self, field: int) -> Fields | None:
        place = self._target(field)
        return Fields(self.content, place) if place else None

    def tables(self, field: int) -> list[Fields]:
        start, count = self._vector(field)
        places = range(start, start + 4 * count, 4)
        return [Fields(self.content, place + self._read("I", place)) for place in places]

    def array(self, field: int, kind: str) -> NDArray[Any]:
        """The numbers of a field; empty where it is left out."""
        start, count = self._vector(field)
        return np.frombuffer(self.content, kind, count, start)

    def _read(self, kind: str, place: int) -> int:
        return int(struct.unpack_from(f"<{kind}", self.content, place)[0])

    def _there(self, field: int) -> int:
        """Where a field is; 0 where it is left out."""
        layout = self.place - self._read("i", self.place)
        entry = 4 + 2 * field
        if entry >= self._read("H", layout):
            return 0
        offset = self._read("H", layout + entry)
        return self.place + offset if offset else 0

    def _target(self, field: int) -> int:
        there = self._there(field)
        return there + self._read("I", there) if there else 0

    def _vector(self, field: int) -> tuple[int, int]:
        """Where the first of a field's values is, and how many there are."""
        place = self._target(field)
        return (place + 4, self._read("I", place)) if place else (0, 0)


@dataclass(frozen=True, slots=True)
class Tensor:
    """A tensor; those of pictures have the shape [1, rows, columns, channels]."""

    name: str
    shape: tuple[int, ...]
    constant: NDArray[Any] | None
    """None for what is computed."""


@dataclass(frozen=True, slots=True)
class Operation:
    """One step, by the numbers of its tensors."""

    code: int
    """Number of its kind, BuiltinOperator of the schema."""
    inputs: tuple[int, ...]
    output: int
    options: Fields | None


@dataclass(frozen=True, slots=True)
class TfliteNetwork:
    """The steps of a network, in the order in which they can be done."""

    tensors: tuple[Tensor, ...]
    operations: tuple[Operation, ...]
    inputs: tuple[int, ...]
    outputs: tuple[int, ...]


def read_tflite(content: bytes) -> TfliteNetwork:
    """The network in a whole file."""
    model = Fields(content, struct.unpack_from("<I", content)[0])
    codes = [max(row.number(0, "b"), row.number(3)) for row in model.tables(1)]
    graph, buffers = model.tables(2)[0], model.tables(4)
    return TfliteNetwork(
        tuple(_tensor(row, buffers) for row in graph.tables(0)),
        tuple(
            Operation(
                codes[row.number(0, "I")], _numbers(row, 1), _numbers(row, 2)[0], row.table(4)
            )
            for row in graph.tables(3)
        ),
        _numbers(graph, 1),
        _numbers(graph, 2),
    )


def _tensor(row: Fields, buffers: list[Fields]) -> Tensor:
    name, shape = row.array(3, "u1").tobytes().decode(), _numbers(row, 0)
    values = buffers[row.number(2, "I")].array(0, "u1")
    if not len(values):
        return Tensor(name, shape, None)
    return Tensor(name, shape, values.view(KINDS[row.number(1, "b")]).reshape(shape))


def _numbers(row: Fields, field: int) -> tuple[int, ...]:
    return tuple(row.array(field, "<i4").tolist())
