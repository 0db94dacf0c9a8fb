"""What a behavior declares, as data: `hri.behavior.schema` reads and writes it as XML."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from hri.behavior.ports import GENERIC, Param
from hri.core.errors import Place
from hri.core.xml import NOWHERE

TYPES: dict[str, Any] = {"string": "", "number": 0.0, "integer": 0, "boolean": False}
"""The types of parameters with their empty values; `string` and `number` are those of 2003."""


@dataclass(frozen=True)
class Parameter:
    """A parameter: its default is a text, as networks write it."""

    name: str
    type: str
    """One of TYPES; empty for that of its driver, or a string."""
    default: str
    description: str = ""
    minimum: float = -math.inf
    maximum: float = math.inf
    choices: tuple[str, ...] = ()
    place: Place = field(default=NOWHERE, compare=False, repr=False)

    def declare(self) -> Param[Any]:
        """The declaration for a class. Raises ValueError when the default does not fit."""
        declared = Param(
            TYPES[self.type or "string"],
            self.description,
            minimum=self.minimum,
            maximum=self.maximum,
            among=self.choices,
        )
        if self.default or self.type in ("", "string"):
            declared.default = declared.parse(self.default)
        return declared


@dataclass(frozen=True)
class Port:
    """An input or an output."""

    name: str
    datatype: str
    description: str = ""
    semantic_type: str = GENERIC
    place: Place = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True)
class Schema:
    """The declaration of a behavior type, without its code."""

    type: str
    driver: str
    display_name: str
    library: str
    category: str
    parameters: tuple[Parameter, ...] = ()
    inputs: tuple[Port, ...] = ()
    outputs: tuple[Port, ...] = ()
    place: Place = field(default=NOWHERE, compare=False, repr=False)

    @property
    def brings_class(self) -> bool:
        """Whether its library is a Python file, which holds the class of its driver."""
        return self.library.endswith(".py")
