"""What an ONNX file consists of, as bytes.

Protocol buffers (https://protobuf.dev/programming-guides/encoding); the numbers of fields are those
of ONNX's `onnx.proto3`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

FORMAT, OPERATIONS = 8, 13
"""Versions of the format, and of the set of operations."""
FLOAT, INT64 = 1, 7
"""Types of a tensor's values."""

Attribute = int | str | Sequence[int]
KINDS = {int: (3, 2), str: (4, 3)}
LIST = 8, 7
"""Of an attribute: the field of its value, and the number of its type; of a list's numbers."""


def node(
    operation: str, inputs: Iterable[str], output: str, attributes: dict[str, Attribute]
) -> bytes:
    """One step of a network; an input that is left out is empty."""
    parts = [_field(1, name) for name in inputs] + [_field(2, output), _field(4, operation)]
    parts += [_field(5, _attribute(name, value)) for name, value in attributes.items()]
    return b"".join(parts)


def constant(name: str, values: NDArray[Any]) -> bytes:
    """A tensor of floats or whole numbers that is known."""
    is_whole = values.dtype.kind == "i"
    kept = np.ascontiguousarray(values, "<i8" if is_whole else "<f4")
    sizes = b"".join(_field(1, size) for size in kept.shape)
    kind = INT64 if is_whole else FLOAT
    return sizes + _field(2, kind) + _field(8, name) + _field(9, kept.tobytes())


def tensor(name: str, shape: Sequence[int]) -> bytes:
    """A tensor of floats that goes in or comes out."""
    sizes = b"".join(_field(1, _field(1, size)) for size in shape)
    return _field(1, name) + _field(2, _field(1, _field(1, FLOAT) + _field(2, sizes)))


def model(
    nodes: Iterable[bytes],
    constants: Iterable[bytes],
    inputs: Iterable[bytes],
    outputs: Iterable[bytes],
) -> bytes:
    """A whole file, of what the functions above made."""
    fields = ((1, nodes), (5, constants), (11, inputs), (12, outputs))
    graph = b"".join(_field(number, part) for number, parts in fields for part in parts)
    named = _field(2, "network") + graph
    return _field(1, FORMAT) + _field(7, named) + _field(8, _field(1, "") + _field(2, OPERATIONS))


def _attribute(name: str, value: Attribute) -> bytes:
    field, kind = KINDS.get(type(value), LIST)
    values = value if isinstance(value, Sequence) and not isinstance(value, str) else [value]
    return _field(1, name) + b"".join(_field(field, one) for one in values) + _field(20, kind)


def _field(number: int, value: int | str | bytes) -> bytes:
    if isinstance(value, int):
        return _varint(number << 3) + _varint(value)
    content = value.encode() if isinstance(value, str) else value
    return _varint(number << 3 | 2) + _varint(len(content)) + content


def _varint(number: int) -> bytes:
    """Seven bits a byte, the lowest first; all but the last have the highest bit set."""
    assert number >= 0
    found = bytearray()
    while number > 127:
        found.append(number & 127 | 128)
        number >>= 7
    return bytes([*found, number])
