"""TOML files whose every error has a place.

`Table` reads one table with checks: each getter names the type and the range it wants, and
`finish()` refuses the keys that nobody asked for, so a misspelt key is never silently ignored.
"""

from __future__ import annotations

import difflib
import math
import re
import tomllib
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.reading import read_text

Key = tuple[str | int, ...]
Default = TypeVar("Default")
REQUIRED: Any = object()
LARGEST = 1e300
"""Numbers beyond it, infinity and NaN among them, mean nothing in an authored file."""

LARGEST_TOML = 1_000_000
"""Bytes of a file: some 3 seconds of reading on a slow machine."""
MOST_KEPT = 32
"""Texts that are kept as they were read: a robot that starts reads most files several times."""
DEEPEST = 32
"""Parts of a dotted key, `a.b.c` has three. Each line below a deep header repeats all of it."""

_NAME = r"""(?:[A-Za-z0-9_-]++|"[^"\n]*+"|'[^'\n]*+')"""
_DEEP_KEY = re.compile(rf"(?<![A-Za-z0-9_-])(?:{_NAME}[ \t]*+\.[ \t]*+){{{DEEPEST}}}")
_POSITION = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")


def load_toml(path: Path, what: str = "TOML file") -> Table:
    """The root table of a file.

    Raises AuthoringError on a syntax error and for a key of more than DEEPEST parts, HriError for
    a file that cannot be read or is larger than LARGEST_TOML.
    """
    text = read_text(path, what, LARGEST_TOML)
    _check_depth(path, text)
    try:
        data, places = _parsed(text)
    except tomllib.TOMLDecodeError as error:
        match = _POSITION.search(str(error))
        line, column = (match.group(1), match.group(2)) if match else (None, None)
        place = Place(path, int(line or text.count("\n") + 1), int(column or 1))
        problem = _POSITION.sub("", str(error))
        is_value = problem == "Invalid value"
        remedy = 'write a value; text goes in "quotes"' if is_value else "fix the TOML syntax here"
        raise AuthoringError(place, problem[:1].lower() + problem[1:], remedy) from error
    except (RecursionError, ValueError) as error:
        raise AuthoringError(
            Place(path), "brackets or numbers without end", "shorten it"
        ) from error
    return Table(data, path, (), places)


@lru_cache(maxsize=MOST_KEPT)
def _parsed(text: str) -> tuple[dict[str, Any], dict[Key, Place]]:
    """What a text says, and where each key stands; a Table changes neither."""
    return tomllib.loads(text), locate_keys(text)


def _check_depth(path: Path, text: str) -> None:
    if deep := _DEEP_KEY.search(text):
        line = text.count("\n", 0, deep.start()) + 1
        place = Place(path, line, deep.start() - text.rfind("\n", 0, deep.start()))
        raise AuthoringError(place, f"a key of more than {DEEPEST} parts", "write fewer dots")


class Table:
    """One table of a TOML file; knows where each of its keys stands."""

    def __init__(
        self, data: dict[str, Any], path: Path, key: Key, places: dict[Key, Place]
    ) -> None:
        self.data = data
        self.path = path
        self.key = key
        self._places = places
        self._asked: set[str] = set()

    def __contains__(self, name: str) -> bool:
        return name in self.data

    def keys(self) -> list[str]:
        return list(self.data)

    def place(self, name: str | None = None) -> Place:
        """Where a key stands; without a name, where the table stands."""
        key = self.key if name is None else (*self.key, name)
        while key and key not in self._places and (*key, 0) not in self._places:
            key = key[:-1]
        key = key if key in self._places else (*key, 0)
        found = self._places.get(key, Place(self.path))
        return Place(self.path, found.line, found.column)

    def error(self, name: str | None, what: str, remedy: str) -> AuthoringError:
        """The error to raise about a key of this table."""
        return AuthoringError(self.place(name), what, remedy)

    def string(
        self, name: str, default: Default = REQUIRED, *, among: Sequence[str] = ()
    ) -> str | Default:
        """A text; one of `among` when given."""
        value = self._get(name, default, str, "a text in quotes")
        if among and isinstance(value, str) and name in self.data and value not in among:
            raise self.error(name, f'{name} is "{value}"', did_you_mean(value, among))
        return value  # type: ignore[no-any-return]

    def number(
        self,
        name: str,
        default: Default = REQUIRED,
        *,
        minimum: float = -math.inf,
        maximum: float = math.inf,
    ) -> float | Default:
        """A finite number within the range, ends included."""
        value = self._get(name, default, (int, float), "a number")
        if name not in self.data:
            return value  # type: ignore[no-any-return]
        if isinstance(value, bool):
            raise self.error(name, f"{name} is true or false", "write a number")
        if not minimum <= value <= maximum or abs(value) > LARGEST:
            remedy = f"write a number from {minimum:g} to {maximum:g}"
            raise self.error(name, f"{name} is {value}", remedy)
        return float(value)

    def flag(self, name: str, default: bool = False) -> bool:
        """true or false."""
        return bool(self._get(name, default, bool, "true or false"))

    def strings(self, name: str, default: Sequence[str] = REQUIRED) -> list[str]:
        """A list of texts."""
        value = self._get(name, default, list, "a list of texts")
        if any(not isinstance(item, str) for item in value):
            raise self.error(
                name, f"{name} holds something that is not a text", "put quotes around it"
            )
        return list(value)

    def numbers(
        self, name: str, default: Sequence[float] = REQUIRED, *, count: int = 0
    ) -> list[float]:
        """A list of numbers, `count` of them when given."""
        value = self._get(name, default, list, "a list of numbers")
        if not all(_is_number(item) for item in value):
            raise self.error(
                name, f"{name} holds something that is not a number", "write numbers only"
            )
        if count and len(value) != count:
            raise self.error(name, f"{name} has {len(value)} numbers", f"write {count}")
        return [float(item) for item in value]

    def table(self, name: str, *, optional: bool = False) -> Table:
        """A table below this one; an empty one when optional and absent."""
        value = self._get(name, {} if optional else REQUIRED, dict, "a table")
        return Table(value, self.path, (*self.key, name), self._places)

    def tables(self, name: str) -> Iterator[tuple[str, Table]]:
        """The tables below `name` with their names; none when absent."""
        below = self.table(name, optional=True)
        for key in below.data:
            yield key, below.table(key)

    def array(self, name: str) -> list[Table]:
        """An array of tables, `[[name]]`; empty when absent."""
        value = self._get(name, [], list, "an array of tables, [[...]]")
        if any(not isinstance(item, dict) for item in value):
            raise self.error(
                name, f"{name} must be an array of tables", f"write [[{name}]] above each"
            )
        key = (*self.key, name)
        return [Table(item, self.path, (*key, i), self._places) for i, item in enumerate(value)]

    def weights(self, minimum: float = 0.0, maximum: float = 1.0) -> dict[str, float]:
        """The whole table as names with numbers within the range."""
        found = {name: self.number(name, minimum=minimum, maximum=maximum) for name in self.data}
        return {name: float(value) for name, value in found.items()}

    def finish(self) -> None:
        """Refuse every key that was not asked for."""
        for name in self.data:
            if name not in self._asked:
                place = self.place(name)
                remedy = did_you_mean(name, self._asked)
                raise AuthoringError(place, f'unknown key "{name}"', remedy)

    def _get(self, name: str, default: Any, kind: type | tuple[type, ...], wanted: str) -> Any:
        self._asked.add(name)
        if name not in self.data:
            if default is REQUIRED:
                where = f"[{'.'.join(map(str, self.key))}]" if self.key else "this file"
                others = set(self.data) - self._asked
                for other in others:  # a key that is misspelled may be why this one is wanted
                    meant = difflib.get_close_matches(other, self._asked - {name}, n=1, cutoff=0.8)
                    if meant and meant[0] not in self.data:
                        remedy = did_you_mean(other, meant)
                        raise self.error(other, f'unknown key "{other}"', remedy)
                near = difflib.get_close_matches(name, others, n=1, cutoff=0.6)
                remedy = f'rename "{near[0]}"' if near else f"add {name} = ..."
                raise self.error(None, f'"{name}" is missing in {where}', remedy)
            return default
        value = self.data[name]
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            raise self.error(name, f"{name} is {_kind_of(value)}", f"write {wanted}")
        return value


def _is_number(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return -LARGEST <= value <= LARGEST


def _kind_of(value: object) -> str:
    names = {bool: "true or false", int: "a number", float: "a number", str: "a text"}
    return names.get(type(value), "a list" if isinstance(value, list) else "a table")


_HEADER = re.compile(r"^\s*(\[\[?)([^\]]+)\]\]?\s*(?:#.*)?$")
_ENTRY = re.compile(
    r"""^(\s*)((?:"[^"]*"|'[^']*'|[A-Za-z0-9_-]+)(?:\s*\.\s*(?:"[^"]*"|'[^']*'|[A-Za-z0-9_-]+))*)\s*="""
)
_PART = re.compile(r""""([^"]*)"|'([^']*)'|([A-Za-z0-9_-]+)""")
# Nothing is looked at twice: a word of a million letters must not take a million times as long.
_INLINE = re.compile(r"""("[^"]*+"|'[^']*+'|(?<![A-Za-z0-9_-])[A-Za-z0-9_-]++)\s*+=(?!=)""")


def locate_keys(text: str) -> dict[Key, Place]:
    """Where each key of a TOML text stands (the path of the places is left empty).

    tomllib gives places only for syntax errors, so the text is read again, line by line. What
    this misses (keys inside arrays that span lines) falls back to the place of the enclosing key.
    """
    places: dict[Key, Place] = {}
    prefix: Key = ()
    counts: dict[Key, int] = {}
    fence = ""
    nowhere = Path()
    for number, line in enumerate(text.splitlines(), start=1):
        if fence:
            fence = "" if line.count(fence) % 2 else fence
            continue
        if header := _HEADER.match(line):
            prefix = _resolve(_parts(header.group(2)), counts, header.group(1) == "[[")
            places.setdefault(prefix, Place(nowhere, number, header.start(1) + 1))
        elif entry := _ENTRY.match(line):
            key = prefix + _parts(entry.group(2))
            places[key] = Place(nowhere, number, entry.start(2) + 1)
            value = line[entry.end() :]
            if value.lstrip().startswith("{"):
                for inner in _INLINE.finditer(value):
                    place = Place(nowhere, number, entry.end() + inner.start(1) + 1)
                    places.setdefault(key + _parts(inner.group(1)), place)
            for mark in ('"""', "'''"):
                if value.count(mark) % 2:
                    fence = mark
    return places


def _parts(dotted: str) -> Key:
    return tuple(a or b or c for a, b, c in _PART.findall(dotted))


def _resolve(names: Key, counts: dict[Key, int], is_array: bool) -> Key:
    """The key of a header, with the index of the newest element for each array on the way."""
    key: Key = ()
    for position, name in enumerate(names):
        key = (*key, name)
        last = position == len(names) - 1
        if last and is_array:
            counts[key] = counts.get(key, -1) + 1
        if key in counts:
            key = (*key, counts[key])
    return key
