"""What a tool takes: each argument checks a value, and describes itself as JSON Schema."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import quoted

LONGEST_TEXT = 500
"""Letters."""


@dataclass(frozen=True, slots=True)
class Argument(ABC):
    """One that a tool takes."""

    about: str

    @property
    @abstractmethod
    def default(self) -> Any:
        """What stands for one that was left out; None where it must be given."""

    @property
    @abstractmethod
    def wanted(self) -> str:
        """What it must be, in words."""

    @abstractmethod
    def checked(self, value: Any) -> Any:
        """The value as the tool wants it; None for one that does not fit."""

    @abstractmethod
    def schema(self) -> dict[str, Any]:
        """It as JSON Schema."""


@dataclass(frozen=True, slots=True)
class Text(Argument):
    """Letters; blanks around them do not count unless they are `is_exact`."""

    default: str | None = None
    longest: int = LONGEST_TEXT
    is_exact: bool = False

    @property
    def wanted(self) -> str:
        return f"a text of 1 to {self.longest} letters"

    def checked(self, value: Any) -> str | None:
        if not isinstance(value, str) or len(value) > self.longest:
            return None
        text = value if self.is_exact else " ".join(value.split())
        if not text.strip():
            return self.default
        # A lone half of a character cannot be written, said, or recorded.
        is_whole = not any("\ud800" <= letter <= "\udfff" for letter in text)
        is_said = self.is_exact or text.isprintable()
        return text if is_whole and is_said else None

    def schema(self) -> dict[str, Any]:
        return {"type": "string", "maxLength": self.longest}


@dataclass(frozen=True, slots=True)
class Number(Argument):
    """A finite number of a range."""

    least: float
    most: float
    default: float | None = None

    @property
    def wanted(self) -> str:
        return f"a number from {self.least:g} to {self.most:g}"

    def checked(self, value: Any) -> float | None:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return None
        # Compared before it is made a float, which a huge integer cannot be.
        return float(value) if self.least <= value <= self.most and math.isfinite(value) else None

    def schema(self) -> dict[str, Any]:
        return {"type": "number", "minimum": self.least, "maximum": self.most}


@dataclass(frozen=True, slots=True)
class Choice(Argument):
    """One of some words."""

    values: tuple[str, ...]
    default: str | None = None

    @property
    def wanted(self) -> str:
        return f"one of {', '.join(filter(None, self.values))}"

    def checked(self, value: Any) -> str | None:
        return value if isinstance(value, str) and value in self.values else None

    def schema(self) -> dict[str, Any]:
        return {"type": "string", "enum": list(self.values)}


def schema_of(arguments: Mapping[str, Argument]) -> dict[str, Any]:
    """Arguments as the JSON Schema of an object that has nothing else."""
    described = {
        name: {**one.schema(), "description": one.about}
        | ({} if one.default is None else {"default": one.default})
        for name, one in arguments.items()
    }
    required = [name for name, one in arguments.items() if one.default is None]
    return {
        "type": "object",
        "properties": described,
        "required": required,
        "additionalProperties": False,
    }


def checked(tool: str, wanted: Mapping[str, Argument], given: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of a call as its tool wants them. Raises HriError for what does not fit."""
    for other in given.keys() - wanted.keys():
        remedy = did_you_mean(other[:60], wanted, "leave it out")
        raise HriError(f'{tool} takes no "{quoted(other)}" - {remedy}')
    found = {}
    for name, argument in wanted.items():
        value = argument.checked(given[name]) if name in given else argument.default
        if value is None:
            raise HriError(f'"{name}" must be {argument.wanted} - {argument.about}')
        found[name] = value
    return found
