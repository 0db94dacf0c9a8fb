"""Frames of the Malleable bridge: one line of XML a message, written and read without a socket.

    <tutorial><number count="1">5.000000</number></tutorial>

The tag says who is meant, each element inside is a value for the port of its name. `count="1"`: the
receiver sends the value on once; without it, again at every tick until another one comes. Written
without quotes, `count=1`, it is read as well.

expat reads the lines, as fast as a strict parser of our own did (200 bytes in 6 us). What could
grow is refused: a DOCTYPE, and with it every entity that a peer could define; elements within a
value; lines of more than 64 KiB.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from xml.parsers import expat

from hri.core.errors import HriError
from hri.core.token import Grant

LONGEST = 65_536
"""Bytes of a line, its end included."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
_JUNK = expat.errors.codes[expat.errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT]
_COUNT = re.compile("[1-9][0-9]{0,5}")
_BARE_COUNT = re.compile(rb"(<[A-Za-z_][A-Za-z0-9_.-]* +count=)([0-9]+)(?=[ />])")
_UNWRITABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class ProtocolError(HriError):
    """A line, or a value in it, is not what the bridge speaks."""


class Surplus(ProtocolError):
    """A line goes on after the end of its message."""


@dataclass(frozen=True, slots=True)
class Item:
    """A value on its way to a port."""

    port: str
    text: str
    """The text without XML escapes; `hri.net.values` converts it."""
    count: int | None = 1
    """In how many ticks the receiver sends it, 1 to 999999; None: until another one comes."""


class Sender:
    """Who is at the other end of a connection."""

    spoken = -math.inf
    """When its last message came, in seconds on the clock of whoever keeps its values."""
    is_gone = False
    """Whether the connection has ended."""
    grant: Grant | None = None
    """What it got for the token that it has proven; None before."""
    refused: frozenset[str] = frozenset()
    """The ports that refused a value of this peer, which it was informed of."""
    name = "somebody"
    """Who it is, for people."""

    @property
    def is_authorized(self) -> bool:
        """Whether it has proven the token that counts now."""
        return self.grant is not None and self.grant.holds

    def tell(self, line: bytes) -> None:
        """Send a line to it alone, as far as there is a connection."""


@dataclass(frozen=True, slots=True)
class Message:
    """What one line carries."""

    tag: str
    items: tuple[Item, ...]
    sender: Sender | None = field(default=None, compare=False)
    """Who sent it; None for one that did not come over a connection."""


def encode(message: Message) -> bytes:
    """The line, its end included.

    Characters that XML cannot carry become U+FFFD. Raises ProtocolError for what is not a name,
    and for more than 64 KiB.
    """
    line = _line(message.tag, map(_element, message.items))
    if len(line) > LONGEST:
        raise ProtocolError(f"a message of {len(line)} bytes - keep it within {LONGEST}")
    return line


def split(message: Message) -> tuple[list[bytes], list[Item]]:
    """As many lines as a message of any length takes, and the items too long for a line.

    Raises ProtocolError for what is not a name.
    """
    room = LONGEST - len(_line(message.tag, ()))
    lines: list[list[bytes]] = [[]]
    left, too_long = room, []
    for item in message.items:
        element = _element(item)
        if len(element) > room:
            too_long.append(item)
            continue
        if len(element) > left:
            lines.append([])
            left = room
        lines[-1].append(element)
        left -= len(element)
    return [_line(message.tag, line) for line in lines if line], too_long


def decode(line: bytes, sender: Sender | None = None) -> Message:
    """What a line says. Raises ProtocolError, with what is wrong and where."""
    if len(line) > LONGEST:
        raise ProtocolError(f"a line of {len(line)} bytes - keep it within {LONGEST}")
    return _Reader().read(line, sender)


@lru_cache(1024)
def checked_name(name: str) -> str:
    """The name of a tag or port. Raises ProtocolError when it cannot be one."""
    if not _NAME.fullmatch(name):
        raise ProtocolError(f'"{name[:60]}" names no tag or port - use letters, digits and _')
    return name


def _line(tag: str, elements: Iterable[bytes]) -> bytes:
    name = checked_name(tag).encode()
    return b"<%b>%b</%b>\n" % (name, b"".join(elements), name)


def _element(item: Item) -> bytes:
    port = checked_name(item.port)
    count = "" if item.count is None else f' count="{item.count}"'
    return f"<{port}{count}>{_escaped(item.text)}</{port}>".encode()


def _escaped(text: str) -> str:
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    text = text.replace('"', "&quot;")
    if not text.isprintable():
        # An end of line inside a value would end the message.
        text = _UNWRITABLE.sub("\ufffd", text).replace("\n", "&#10;").replace("\r", "&#13;")
    return text


class _Reader:
    """Reads one line; expat parsers cannot be used twice."""

    def __init__(self) -> None:
        self.tag = ""
        self.items: list[Item] = []
        self.depth = 0
        self.count: int | None = None
        self.text: list[str] = []

    def read(self, line: bytes, sender: Sender | None) -> Message:
        # Not kept in self: it keeps us, and a circle would be left to the garbage collector.
        parser = expat.ParserCreate("UTF-8")
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.StartDoctypeDeclHandler = self._doctype
        try:
            has_count = b"count=" in line
            parser.Parse(_BARE_COUNT.sub(rb'\1"\2"', line) if has_count else line, True)
        except expat.ExpatError as error:
            if error.code == _JUNK:
                what = f"column {error.offset + 1}: more after </{self.tag[:60]}>"
                raise Surplus(f"{what} - write each message on a separate line") from error
            what = expat.ErrorString(error.code)
            remedy = "write <tag><port>value</port></tag>"
            raise ProtocolError(f"column {error.offset + 1}: {what} - {remedy}") from error
        except _Refused as error:
            raise ProtocolError(f"column {parser.CurrentColumnNumber + 1}: {error}") from error
        return Message(self.tag, tuple(self.items), sender)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self.depth += 1
        if self.depth == 1:
            self.tag = name
        elif self.depth == 2:
            self.count = _counted(attributes["count"]) if "count" in attributes else None
        else:
            raise _Refused(f"<{name[:60]}> within a value - write &lt; for a <")

    def _end(self, name: str) -> None:
        self.depth -= 1
        if self.depth == 1:
            self.items.append(Item(name, "".join(self.text), self.count))
            self.text.clear()

    def _text(self, text: str) -> None:
        if self.depth == 2:
            self.text.append(text)
        elif text.strip():
            # The log gets this: in a line for the bridge itself it may be the token.
            what = "text" if self.tag == "hri" else f'"{text[:60]}"'
            raise _Refused(f"{what} outside of a value - put it into <port>...</port>")

    def _doctype(self, *_: object) -> None:
        raise _Refused("a DOCTYPE - take it out")


def _counted(text: str) -> int:
    if not _COUNT.fullmatch(text):
        raise _Refused(f'a count of "{text[:20]}" - write 1 to 999999, or leave it out')
    return int(text)


class _Refused(Exception):
    """Well-formed XML, but no message."""
