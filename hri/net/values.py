"""How the values of ports are written in a message; the one place that knows.

| datatype | written | also read |
|---|---|---|
| `string` | in quotes, `"text"` | without them |
| `double` | six decimals (`%f`), `5.000000`, `inf` | any decimal number, `1e-3` |
| `doublearray` | doubles with a space between, `1.000000 2.000000` | white space, `,` or `;` |
| `boolean` | `true`, `false` | `1`, `0` |

NaN does not travel.

As in 2003, quotes are not taken off a string that arrives: from a behavior it comes with them, from
a program that wrote none it comes without. `unquoted` takes them off.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hri.net.malleable_protocol import ProtocolError

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?|[+-]?inf")
_BETWEEN = re.compile(r"\s*[,;]\s*|\s+")
SEPARATORS = {"space": " ", "comma": ", ", "semicolon": ";"}
"""What may stand between the numbers of an array that is sent; the first is the usual one."""
_TRUTHS = {"true": True, "1": True, "false": False, "0": False}


@dataclass(frozen=True)
class Form:
    """How values of one datatype are written and read."""

    write: Callable[[Any], str]
    read: Callable[[str], Any]


def unquoted(text: str) -> str:
    """A string without the quotes that a behavior put around it, if it did."""
    is_quoted = len(text) >= 2 and text[0] == text[-1] == '"'
    return text[1:-1] if is_quoted else text


def read(datatype: str, text: str) -> Any:
    """The value of a text. Raises ProtocolError if it does not have that datatype."""
    try:
        return FORMS[datatype].read(text)
    except ValueError as error:
        raise ProtocolError(f'"{text[:40]}" is not a {datatype} - see docs/bridge.md') from error


def can_travel(value: Any) -> bool:
    """Whether a value has a text: NaN, alone or in an array, has none."""
    numbers = value if isinstance(value, tuple) else (value,)
    return all(number == number for number in numbers)  # only NaN is not equal to itself


def write(datatype: str, value: Any, separator: str = "space") -> str:
    """The text of a value that can travel; `separator`: one of SEPARATORS, for arrays."""
    if datatype == "doublearray":
        return SEPARATORS[separator].join(f"{number:f}" for number in value)
    return FORMS[datatype].write(value)


def _numbers(text: str) -> tuple[float, ...]:
    text = text.strip()
    return tuple(map(_number, _BETWEEN.split(text))) if text else ()


def _number(text: str) -> float:
    if not _NUMBER.fullmatch(text):
        raise ValueError(text)
    return float(text)


def _truth(text: str) -> bool:
    if text.strip() not in _TRUTHS:
        raise ValueError(text)
    return _TRUTHS[text.strip()]


FORMS: dict[str, Form] = {
    "string": Form(lambda value: f'"{value}"', str),
    "double": Form(lambda value: f"{value:f}", lambda text: _number(text.strip())),
    "doublearray": Form(lambda value: write("doublearray", value), _numbers),
    "boolean": Form(lambda value: "true" if value else "false", _truth),
}
"""The datatypes that travel."""
