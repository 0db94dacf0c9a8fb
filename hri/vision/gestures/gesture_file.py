"""Files of gestures of head and hands, and of facial expressions: a table of each, by its name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeVar

from hri.core.errors import HriError, did_you_mean
from hri.core.toml import Table, load_toml

T = TypeVar("T")

HEAD_GESTURE, HAND_GESTURE = "head gesture", "hand gesture"
FACIAL_EXPRESSION = "facial expression"
MOST_GESTURES = 50


def read_gestures(path: Path, kind: str, gesture: Callable[[str, Table], T]) -> dict[str, T]:
    """The gestures of a file by name; `kind` is what one is called in messages.

    Raises AuthoringError with the place of a mistake, HriError for a file that cannot be read.
    """
    table = load_toml(path, f"file of {kind}s")
    names = table.keys()
    if not 0 < len(names) <= MOST_GESTURES:
        raise table.error(None, f"{len(names)} {kind}s", f"write 1 to {MOST_GESTURES}")
    found = {name: gesture(name, table.table(name)) for name in names}
    table.finish()
    return found


def chosen(patterns: Mapping[str, T], names: Iterable[str], kind: str = HEAD_GESTURE) -> list[T]:
    """The gestures of these names. Raises HriError for an unknown name."""
    found = []
    for name in names:
        if name not in patterns:
            raise HriError(f'there is no {kind} "{name}" - {did_you_mean(name, patterns)}')
        found.append(patterns[name])
    return found
