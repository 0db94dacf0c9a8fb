"""Attributes of objects: what a program wants to know of a thing, beside its name.

They are numbers and texts by name, as `price=3.5` and `owner=Ann`, kept with the object in its set.
A program finds them at each `FoundObject`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hri.core.errors import HriError
from hri.core.properties import checked_name, plain_value

MOST = 50
"""Of an object."""
LONGEST_NAME, LONGEST_TEXT = 60, 1000
"""Characters."""

Attributes = Mapping[str, float | str]


def checked_attributes(given: Mapping[str, Any]) -> dict[str, float | str]:
    """Attributes as a set keeps them; a text that looks like a number becomes one.

    Raises HriError for a name with white space or brackets, and for what is not a finite number or
    a printable text.
    """
    if len(given) > MOST:
        raise HriError(f"{len(given)} attributes - an object has at most {MOST}")
    return {_name(name): _value(name, value) for name, value in given.items()}


def with_changes(attributes: Attributes, changes: Mapping[str, str]) -> dict[str, float | str]:
    """The attributes with some set, and those taken away whose new value is empty.

    Raises HriError as `checked_attributes`, and for one to be taken away that is not there.
    """
    for name, value in changes.items():
        if not value and name not in attributes:
            has = ", ".join(attributes) or "none"
            raise HriError(f'no attribute "{name}" to take away - it has: {has}')
    changed = {**attributes, **changes}
    return checked_attributes({name: value for name, value in changed.items() if value != ""})


def _name(name: str) -> str:
    if len(name) > LONGEST_NAME:
        raise HriError(f'"{name[:LONGEST_NAME]}" is too long for an attribute - shorten it')
    if "=" in name or not name.isprintable():
        raise HriError(f'"{name}" is not a name of an attribute - write NAME=VALUE')
    return checked_name(name)


def _value(name: str, value: Any) -> float | str:
    plain = plain_value(name, value)
    if isinstance(plain, str) and (len(plain) > LONGEST_TEXT or not plain.isprintable()):
        what = f"the attribute {name} is not a line of {LONGEST_TEXT} printable characters"
        raise HriError(f"{what} at most - shorten it")
    return plain
