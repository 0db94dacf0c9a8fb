"""Values of a JSON file, each checked as it is taken."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, NoReturn, TypeVar

from hri.core.errors import HriError
from hri.core.reading import parse_json

T = TypeVar("T")

LARGEST = 1e12
"""No number in a list of one of these files comes near it."""
LATEST = 1e12
"""Seconds; no clock shows more."""


def fields_of(text: str) -> Fields:
    """What a JSON file has at its top. Raises HriError for what is damaged, or not an object."""
    try:
        return Fields(parse_json(text, parse_constant=_refuse), "the file")
    except ValueError as error:
        raise HriError(f"no JSON: {error}") from error


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is not a number")


class Fields:
    """A JSON object whose values are asked for by name and kind; errors say where they stand."""

    def __init__(self, data: object, place: str) -> None:
        """Raises HriError for anything but an object."""
        if not isinstance(data, dict):
            raise HriError(f"{place} is not a table")
        self._data: Mapping[str, Any] = data
        self.place = place

    def __contains__(self, name: str) -> bool:
        """Whether anything stands there, null aside."""
        return self._data.get(name) is not None

    def names(self) -> tuple[str, ...]:
        """All its names."""
        return tuple(self._data)

    def value(self, name: str) -> Any:
        """Whatever stands there. Raises HriError when nothing does."""
        if name not in self._data:
            raise HriError(f"{self.place} has no {name}")
        return self._data[name]

    def number(
        self, name: str, highest: float, lowest: float = -LATEST, default: float | None = None
    ) -> float:
        """A number within a range; the default, if there is one, when nothing stands there."""
        if default is not None and self._data.get(name) is None:
            return default
        return _number(self.value(name), f"{self.place}.{name}", lowest, highest)

    def numbers(self, name: str) -> list[float]:
        """A list of numbers within -LARGEST to LARGEST."""
        where = f"{self.place}.{name}"
        return [_number(item, where, -LARGEST, LARGEST) for item in self._list(name)]

    def text(self, name: str) -> str:
        """A text."""
        return _text(self.value(name), f"{self.place}.{name}")

    def truth(self, name: str, default: bool) -> bool:
        """True or false; the default when nothing stands there."""
        value = self._data.get(name, default)
        if not isinstance(value, bool):
            raise HriError(f"{self.place}.{name} is neither true nor false")
        return value

    def entries(self, name: str, default: list[Any] | None = None) -> list[Fields]:
        """A list of objects; the default, if there is one, when nothing stands there."""
        items = enumerate(self._list(name) if default is None or name in self else default)
        return [Fields(item, f"{self.place}.{name}[{number}]") for number, item in items]

    def below(self, name: str) -> Fields:
        """An object."""
        return Fields(self.value(name), f"{self.place}.{name}")

    def table(self, name: str, make: Callable[[Fields], T]) -> dict[str, T]:
        """An object of objects by names, each made into something."""
        below = self.below(name)
        return {key: make(below.below(key)) for key in below._data}

    def _list(self, name: str) -> list[Any]:
        value = self.value(name)
        if not isinstance(value, list):
            raise HriError(f"{self.place}.{name} is not a list")
        return value


def _number(value: object, place: str, lowest: float, highest: float) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise HriError(f"{place} is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not lowest <= number <= highest:
        raise HriError(f"{place} is {number:.6g}, not {lowest:g} to {highest:g}")
    return number


def _text(value: object, place: str) -> str:
    if not isinstance(value, str):
        raise HriError(f"{place} is not a text")
    if not value.isascii() and value != value.encode("utf-8", "replace").decode("utf-8"):
        raise HriError(f"{place} has halves of letters")
    return value
