"""What events may carry when people or other programs make them: numbers and texts, by name."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from typing import Any

from hri.core.errors import HriError

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_NAME = re.compile(r'[^\s\[\](){}":]+')


def plain_value(name: str, value: Any) -> float | str:
    """The value of a property; a text that looks like a number becomes one.

    Raises HriError for what is not a finite number or a text.
    """
    if isinstance(value, str):
        if not NUMBER.fullmatch(value) or not math.isfinite(float(value)):
            return value
        return float(value)
    if isinstance(value, (int, float)):
        with suppress(OverflowError):
            if math.isfinite(number := float(value)):
                return number
    raise HriError(f"the property {name} is {value!r:.40} - give a finite number or a text")


def checked_name(name: str) -> str:
    """The name of an event or a property. Raises HriError for one that cannot be written."""
    if not _NAME.fullmatch(name):
        what = f'"{name:.40}" is not a valid name of an event or a property'
        raise HriError(f'{what} - leave out white space and []{{}}():"')
    return name
