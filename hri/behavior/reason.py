"""Why an output has its value: the inputs that decided, as a behavior itself explains it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Arrived:
    """What one link brought to a behavior in its last tick."""

    source: str
    """The output that it leads from: `behavior.output`, or `board.slot`."""
    input: str
    value: Any
    """None for nothing."""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why an output has its value."""

    words: str
    decisive: Sequence[Arrived] = ()
    """The inputs that decided."""


def decided_by(words: str, decisive: Iterable[Arrived]) -> Reason | None:
    """The reason, unless nothing decided in that way."""
    found = tuple(decisive)
    return Reason(words, found) if found else None


def with_value(value: Any, arrived: Iterable[Arrived]) -> list[Arrived]:
    """The inputs that brought this value."""
    return [one for one in arrived if one.value is not None and one.value == value]
