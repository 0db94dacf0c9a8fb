"""A value that is written in the network: a number, a text, an array or a truth."""

from __future__ import annotations

from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Output, Param
from hri.core.expression import evaluate

Value = float | str | bool | tuple[float, ...]

_DATATYPES: dict[type, str] = {
    float: "double",
    str: "string",
    bool: "boolean",
    tuple: "doublearray",
}


class Constant(Behavior):
    """Sends the same value at every tick."""

    may_do = NOTHING
    parsed_value = Param("0", 'a number, a text, an array such as "1, 2, 3", true or false')
    value = Output[Any]("any", "the value")

    def __init__(self, id: str = "", **parameters: Any) -> None:
        super().__init__(id, **parameters)
        self._parse()

    def set_parameter(self, name: str, value: Any) -> None:
        super().set_parameter(name, value)
        self._parse()

    def compute(self, now: float, dt: float) -> None:
        self.value.send(self._constant)

    def _parse(self) -> None:
        self._constant = parsed(self.parsed_value)
        # The datatype is known from here on, so a link that does not fit is refused at load.
        output = Output[Any](_DATATYPES[type(self._constant)], "the value")
        self.__dict__["outputs"] = {"value": output}


def parsed(text: str) -> Value:
    """What a text means.

    `3`, `-pi/4` are numbers; `1, 2, 3` and `(1, 2, 3)` arrays; `true` and `false` truths; all else
    is a text. Quotes around a text are taken off: so `"5"` is the text 5.
    """
    text = text.strip()
    if len(text) > 1 and text[0] == text[-1] == '"':
        return text[1:-1]
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    for read in (evaluate, _array, _array_in_brackets):
        try:
            return read(text)
        except ValueError:
            continue
    return text


def _array(text: str) -> tuple[float, ...]:
    return tuple(evaluate(element) for element in text.removesuffix(",").split(","))


def _array_in_brackets(text: str) -> tuple[float, ...]:
    if not (text.startswith("(") and text.endswith(")")):
        raise ValueError("no brackets")
    inside = text[1:-1].strip()
    return _array(inside) if inside else ()
