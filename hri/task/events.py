"""Events as text, in the two forms of 2003, and events made the way of 2003.

{Event Examples.PhotoEvent.Shoot [time 0] (count: 3.000000) (name: "a_")}   for people and logs
Examples.PhotoEvent.Shoot?count=3&name=a_                                   over the wire

A property is a number or a text. A text that looks like a number becomes one, so that every way
into the system gives the same event.

In the query form `%XX` stands for a byte of UTF-8, for `% & = ?`, white space and control
characters; a `%` that two hexadecimal digits do not follow stands for itself.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any
from urllib.parse import quote, unquote

from hri.core.clock import Clock, since_1970
from hri.core.errors import HriError
from hri.core.properties import NUMBER, checked_name, plain_value
from hri.core.signals import Event

LONGEST = 65_536
"""Characters of an event as text."""
MOST_PROPERTIES = 1000

_HEAD = re.compile(r'\{Event ([^\s\[\](){}":]+) \[time ([^\s\]]+)\]')
_PROPERTY = re.compile(r' \(([^\s\[\](){}":]+): (?:"((?:[^"\\]|\\.)*)"|([^\s")]+))\)', re.DOTALL)
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t"}
_UNESCAPES = {written[1]: plain for plain, written in _ESCAPES.items()}
_KEPT = "".join(map(chr, range(33, 127))).translate(str.maketrans("", "", "%&=?"))
"""What the query form leaves as it is."""


def event(name: str, /, **properties: Any) -> Event:
    """An event that has not been raised, with properties as 2003 takes them.

    Raises HriError for a name that cannot be written, or a property that is not a number or text.
    """
    return _checked(name, 0.0, properties)


def write_event(event: Event, clock: Clock | None = None) -> str:
    """The text form, properties sorted by name.

    The time is 0 for an event that was not raised, else in seconds since 1970, as coarse as 2003
    wrote it. A `clock` is needed only for an event that a program made with the time of that clock.
    Raises HriError for what the form cannot hold.
    """
    checked_name(event.name)
    seconds = event.since_1970
    if clock is not None and not seconds:
        seconds = since_1970(clock) - (clock.now() - event.time)
    time = f"{seconds:g}" if seconds else _exact(f"{event.time:g}", event.time)
    parts = [f"{{Event {event.name} [time {time}]"]
    for name in sorted(event.properties):
        checked_name(name)
        parts.append(f" ({name}: {_written(name, event.properties[name])})")
    return "".join(parts) + "}"


def parse_event(text: str) -> Event:
    """The event of a text form, with the time as written. Raises HriError."""
    _check_length(text)
    text = text.strip()
    head = _HEAD.match(text)
    if head is None:
        raise _wrong(text, "it does not begin like {Event Name [time 0]")
    if not NUMBER.fullmatch(head[2]) or not math.isfinite(float(head[2])):
        raise _wrong(text, f'"{head[2]:.40}" is not a time')
    properties: dict[str, Any] = {}
    at = head.end()
    while found := _PROPERTY.match(text, at):
        name, words, number = found.groups()
        if name in properties:
            raise _wrong(text, f'"{name:.40}" is there twice')
        if words is None and not NUMBER.fullmatch(number):
            raise _wrong(text, f'"{number:.40}" is not a number and has no quotes')
        properties[name] = number if words is None else _unescaped(words)
        at = found.end()
    if text[at:] != "}":
        raise _wrong(text, f'"{text[at : at + 20]}" is not understood at character {at + 1}')
    return _checked(head[1], float(head[2]), properties)


def write_query(event: Event) -> str:
    """The query form, `Name?count=5&name=b_`. Raises HriError for what it cannot hold."""
    checked_name(event.name)
    pairs = "&".join(f"{_quoted(n)}={_queried(n, v)}" for n, v in event.properties.items())
    return f"{_quoted(event.name)}?{pairs}" if pairs else _quoted(event.name)


def parse_query(text: str) -> Event:
    """The event of a query form. Raises HriError."""
    _check_length(text)
    name, mark, rest = text.strip().partition("?")
    properties: dict[str, Any] = {}
    for pair in rest.split("&") if mark and rest else ():
        key, equals, value = pair.partition("=")
        key = _plain(key)
        if not equals or not key:
            raise _wrong(text, f'"{pair:.40}" is not like property=value')
        if key in properties:
            raise _wrong(text, f'"{key:.40}" is there twice')
        properties[key] = _plain(value)
    return _checked(_plain(name), 0.0, properties)


def _checked(name: str, time: float, properties: dict[str, Any]) -> Event:
    checked_name(name)
    if len(properties) > MOST_PROPERTIES:
        raise HriError(f"{len(properties)} properties - write at most {MOST_PROPERTIES}")
    for key in properties:
        checked_name(key)
    return Event(name, time, {key: plain_value(key, value) for key, value in properties.items()})


def _written(name: str, value: Any) -> str:
    value = plain_value(name, value)
    if isinstance(value, float):
        return _exact(f"{value:f}", value)
    return '"' + "".join(_ESCAPES.get(letter, letter) for letter in value) + '"'


def _exact(usual: str, value: float) -> str:
    """A number as 2003 writes it where that says it all, else with all its digits."""
    return usual if float(usual) == value else repr(value)


def _queried(name: str, value: Any) -> str:
    value = plain_value(name, value)
    return _quoted(value) if isinstance(value, str) else repr(value).removesuffix(".0")


def _unescaped(words: str) -> str:
    def letters() -> Iterator[str]:
        rest = iter(words)
        for letter in rest:
            if letter == "\\":
                escaped = next(rest)
                yield _UNESCAPES.get(escaped, escaped)
            else:
                yield letter

    return "".join(letters())


def _quoted(text: str) -> str:
    return quote(text, safe=_KEPT, errors="surrogatepass")


def _plain(quoted: str) -> str:
    """The text of a quoted one; bytes that are not text are shown as bytes."""
    try:
        return unquote(quoted, errors="surrogatepass")
    except UnicodeDecodeError:
        return unquote(quoted)


def _check_length(text: str) -> None:
    if len(text) > LONGEST:
        raise HriError(f"an event of {len(text)} characters - write at most {LONGEST}")


def _wrong(text: str, why: str) -> HriError:
    return HriError(f'"{text[:60]}" is not an event: {why} - fix the text')
