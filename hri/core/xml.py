"""XML files whose every element and attribute has a place.

expat reads them, since lxml gives no columns. A DOCTYPE is refused, and with it every entity a
file could define: nothing is expanded, nothing is fetched.

`format_xml` writes the canonical form, so that a file that is read and written again is the same
byte for byte: UTF-8, two spaces for each level, one tag a line with its attributes in one order,
comments and at most one blank line between tags where the author had them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.expression import evaluate
from hri.core.reading import read_bytes

MAX_DEPTH = 64
MAX_ELEMENTS = 50_000
DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>'
EDITOR_PREFIXES = ("xmlns:", "xsi:")
"""Attributes that point an editor to the XSD; ignored here."""

_ATTRIBUTE = re.compile(rb"""\s+([^\s=]+)\s*=\s*(?:"[^"]*"|'[^']*')""")
_TAG = re.compile(rb"[^\s/>]*")
_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"}
_ESCAPED = re.compile(r'[&<>"\t\n\r]')


NOWHERE = Place(Path("-"))
"""Where an element stands that was made by a program."""


@dataclass
class Element:
    """One element: its tag, attributes, children, and where all of it stands."""

    tag: str
    attributes: dict[str, str]
    place: Place = NOWHERE
    places: dict[str, Place] = field(default_factory=dict)
    """Where each attribute stands."""
    children: list[Element] = field(default_factory=list)
    text: str = ""
    """All of its text, without that of its children."""
    tail: str = ""
    """The text of its parent that stands after it."""
    leading: list[str] = field(default_factory=list)
    """Comments and processing instructions before it, and "" for a blank line."""
    trailing: list[str] = field(default_factory=list)
    """The same behind its last child."""

    def __iter__(self) -> Iterator[Element]:
        return iter(self.children)

    def error(self, what: str, remedy: str, attribute: str = "") -> AuthoringError:
        """The error to raise about this element or one of its attributes."""
        return AuthoringError(self.places.get(attribute, self.place), what, remedy)

    def get(self, attribute: str, default: str | None = None) -> str:
        """An attribute. Raises AuthoringError when it is missing and has no default."""
        if attribute in self.attributes:
            return self.attributes[attribute]
        if default is not None:
            return default
        remedy = did_you_mean(attribute, self.attributes, f'add {attribute}="..."')
        raise self.error(f'<{self.tag}> has no "{attribute}"', remedy)

    def number(self, attribute: str, default: float) -> float:
        """An attribute that is a number or an expression. Raises AuthoringError otherwise."""
        if attribute not in self.attributes:
            return default
        try:
            return evaluate(self.attributes[attribute])
        except ValueError as error:
            raise self.error(str(error), "write a number, such as 0.1", attribute) from error

    def check(self, tags: tuple[str, ...] = (), attributes: tuple[str, ...] = ()) -> None:
        """Refuse children, attributes and text that have no meaning here."""
        if self.text.strip():
            words = " ".join(self.text.split())
            raise self.error(f'the text "{words:.40}" has no place in <{self.tag}>', "delete it")
        for child in self.children:
            if child.tag not in tags:
                raise child.error(
                    f"<{child.tag}> has no place in <{self.tag}>", did_you_mean(child.tag, tags)
                )
        self.check_attributes(*attributes)

    def check_attributes(self, *known: str) -> None:
        """Refuse attributes that have no meaning here."""
        for name in self.attributes:
            if name not in known and not name.startswith(EDITOR_PREFIXES):
                what = f'<{self.tag}> has no attribute "{name}"'
                raise self.error(what, did_you_mean(name, known), name)

    def content(self) -> Iterator[str | Element]:
        """Its text and its children in the order in which they stand."""
        yield self.text[: len(self.text) - sum(len(child.tail) for child in self.children)]
        for child in self.children:
            yield child
            yield child.tail


def load_xml(path: Path, what: str = "XML file") -> Element:
    """The root element. Raises AuthoringError with the place, HriError if unreadable."""
    return parse_xml(read_bytes(path, what), path)


def parse_xml(data: bytes, path: Path) -> Element:
    """The root element of what a file has, or would have. Raises AuthoringError with the place."""
    return _Reader(path, data).read()


def format_xml(root: Element) -> str:
    """The canonical text of a file; attributes come in the order that the elements have."""
    lines = [DECLARATION]
    _format(root, "", lines)
    return "\n".join(lines) + "\n"


def _format(element: Element, indent: str, lines: list[str], is_first: bool = True) -> None:
    # A blank line below an opening tag separates nothing.
    leading = element.leading[1:] if is_first and element.leading[:1] == [""] else element.leading
    lines.extend(indent + line if line else "" for line in leading)
    attributes = "".join(f' {name}="{escape(v)}"' for name, v in element.attributes.items())
    if not element.children and not element.trailing:
        lines.append(f"{indent}<{element.tag}{attributes}/>")
        return
    lines.append(f"{indent}<{element.tag}{attributes}>")
    for number, child in enumerate(element):
        _format(child, indent + "  ", lines, is_first=number == 0)
    lines.extend(indent + "  " + line if line else "" for line in element.trailing)
    lines.append(f"{indent}</{element.tag}>")


def escape(text: str) -> str:
    """A text as the value of an attribute in double quotes."""
    return _ESCAPED.sub(lambda found: _ESCAPES.get(found[0], f"&#{ord(found[0])};"), text)


class _Reader:
    def __init__(self, path: Path, raw: bytes) -> None:
        self.path = path
        self.raw = raw
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.count = 0
        self.between: list[str] = []
        self.parser = expat.ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.CommentHandler = self._comment
        self.parser.ProcessingInstructionHandler = self._instruction
        self.parser.StartDoctypeDeclHandler = self._doctype

    def read(self) -> Element:
        try:
            self.parser.Parse(self.raw, True)
        except expat.ExpatError as error:
            place = Place(self.path, error.lineno, error.offset + 1)
            remedy = "fix the XML here"
            if self.stack and error.code in (3, 7):  # XML_ERROR_NO_ELEMENTS, _TAG_MISMATCH
                unclosed = self.stack[-1]
                remedy = f"close <{unclosed.tag}> of line {unclosed.place.line}"
            raise AuthoringError(place, expat.ErrorString(error.code), remedy) from error
        except (LookupError, ValueError) as error:
            raise AuthoringError(Place(self.path), str(error), "save it as UTF-8") from error
        assert self.root is not None, "expat refuses a document without a root"
        self.root.trailing.extend(self.between)
        return self.root

    def _here(self) -> Place:
        return Place(self.path, self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        place = self._here()
        self.count += 1
        if len(self.stack) >= MAX_DEPTH or self.count > MAX_ELEMENTS:
            raise AuthoringError(place, "too deep or too many elements", "split the file")
        places = self._attribute_places(place, attributes)
        is_first = not self.stack or not self.stack[-1].children
        leading = self._take_between(is_first)
        element = Element(tag, attributes, place, places, leading=leading)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def _attribute_places(self, place: Place, attributes: dict[str, str]) -> dict[str, Place]:
        """Find each `name=` after the start of the tag; expat gives only the start of the tag."""
        start = self.parser.CurrentByteIndex
        places: dict[str, Place] = {}
        line, line_start, seen = place.line, start - place.column + 1, start
        tag = _TAG.match(self.raw, start + 1)
        assert tag is not None, "the pattern fits any text"
        at = tag.end()
        while len(places) < len(attributes) and (found := _ATTRIBUTE.match(self.raw, at)):
            begin, at = found.start(1), found.end()
            if newlines := self.raw.count(b"\n", seen, begin):
                line += newlines
                line_start = self.raw.rfind(b"\n", seen, begin) + 1
            seen = begin
            name = found[1].decode(errors="replace")
            places[name] = Place(self.path, line, begin - line_start + 1)
        return places

    def _end(self, tag: str) -> None:
        element = self.stack.pop()
        element.trailing = self._take_between(is_first=not element.children)
        if element.trailing[-1:] == [""]:
            element.trailing.pop()

    def _text(self, text: str) -> None:
        if self.stack:
            self.stack[-1].text += text
            for child in self.stack[-1].children[-1:]:
                child.tail += text
        if not text.strip() and text.count("\n") > 1 and self.between[-1:] != [""]:
            self.between.append("")

    def _comment(self, text: str) -> None:
        self.between.append(f"<!--{text}-->")

    def _instruction(self, target: str, data: str) -> None:
        self.between.append(f"<?{target} {data}?>" if data else f"<?{target}?>")

    def _take_between(self, is_first: bool) -> list[str]:
        """What stood since the last tag; a blank line below an opening tag does not count."""
        taken, self.between = self.between, []
        return taken[1:] if is_first and taken[:1] == [""] else taken

    def _doctype(self, *_: object) -> None:
        before = self.raw[: self.raw.find(b"<!DOCTYPE")]
        line = before.count(b"\n") + 1
        place = Place(self.path, line, len(before) - before.rfind(b"\n"))
        raise AuthoringError(place, "a DOCTYPE is not allowed", "delete the <!DOCTYPE ...>")
