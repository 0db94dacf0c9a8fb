"""XML files whose every element and attribute has a place.

expat reads them, since lxml tells no columns. A DOCTYPE is refused, and with it every entity a
file could define: nothing is expanded, nothing is fetched.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from hri.core.errors import AuthoringError, HriError, Place, did_you_mean

MAX_BYTES = 4_000_000
MAX_DEPTH = 64
MAX_ELEMENTS = 50_000


@dataclass
class Element:
    """One element: its tag, attributes, children, and where all of it stands."""

    tag: str
    attributes: dict[str, str]
    place: Place
    places: dict[str, Place] = field(default_factory=dict)
    """Where each attribute stands."""
    children: list[Element] = field(default_factory=list)
    text: str = ""

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

    def check(self, tags: tuple[str, ...] = (), attributes: tuple[str, ...] = ()) -> None:
        """Refuse children and attributes that have no meaning here."""
        for child in self.children:
            if child.tag not in tags:
                raise child.error(
                    f"<{child.tag}> has no place in <{self.tag}>", did_you_mean(child.tag, tags)
                )
        for name in self.attributes:
            if name not in attributes:
                what = f'<{self.tag}> has no attribute "{name}"'
                raise self.error(what, did_you_mean(name, attributes), name)


def load_xml(path: Path, what: str = "XML file") -> Element:
    """The root element. Raises AuthoringError with the place, HriError if unreadable."""
    try:
        raw = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot read this {what}: {reason} - check the path") from error
    if len(raw) > MAX_BYTES:
        raise HriError(f"{path}: {len(raw)} bytes are too many - keep it below {MAX_BYTES}")
    return _Reader(path, raw).read()


class _Reader:
    def __init__(self, path: Path, raw: bytes) -> None:
        self.path = path
        self.raw = raw
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.count = 0
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.StartDoctypeDeclHandler = self._doctype

    def read(self) -> Element:
        try:
            self.parser.Parse(self.raw, True)
        except expat.ExpatError as error:
            place = Place(self.path, error.lineno, error.offset + 1)
            remedy = "mend the XML here"
            if self.stack and error.code in (3, 7):  # XML_ERROR_NO_ELEMENTS, _TAG_MISMATCH
                unclosed = self.stack[-1]
                remedy = f"close <{unclosed.tag}> of line {unclosed.place.line}"
            raise AuthoringError(place, expat.ErrorString(error.code), remedy) from error
        except (LookupError, ValueError) as error:
            raise AuthoringError(Place(self.path), str(error), "save it as UTF-8") from error
        assert self.root is not None, "expat refuses a document without a root"
        return self.root

    def _here(self) -> Place:
        return Place(self.path, self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        place = self._here()
        self.count += 1
        if len(self.stack) >= MAX_DEPTH or self.count > MAX_ELEMENTS:
            raise AuthoringError(place, "too deep or too many elements", "split the file")
        places = self._attribute_places(place, attributes)
        element = Element(tag, attributes, place, places)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def _attribute_places(self, place: Place, attributes: dict[str, str]) -> dict[str, Place]:
        """Find `name=` behind the start of the tag; expat tells only where the tag begins."""
        start = self.parser.CurrentByteIndex
        end = self.raw.find(b">", start)
        places = {}
        for name in attributes:
            at = start
            while (at := self.raw.find(name.encode(), at + 1, end)) >= 0:
                if (
                    self.raw[at - 1 : at].isspace()
                    and self.raw[at + len(name) :].lstrip()[:1] == b"="
                ):
                    line = place.line + self.raw.count(b"\n", start, at)
                    column = at - self.raw.rfind(b"\n", 0, at)
                    places[name] = Place(self.path, line, column)
                    break
        return places

    def _end(self, tag: str) -> None:
        self.stack.pop()

    def _text(self, text: str) -> None:
        if self.stack:
            self.stack[-1].text += text

    def _doctype(self, *_: object) -> None:
        before = self.raw[: self.raw.find(b"<!DOCTYPE")]
        line = before.count(b"\n") + 1
        place = Place(self.path, line, len(before) - before.rfind(b"\n"))
        raise AuthoringError(place, "a DOCTYPE is not allowed", "delete the <!DOCTYPE ...>")
