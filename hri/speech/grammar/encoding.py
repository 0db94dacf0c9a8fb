"""The text of a grammar file: its header names an encoding, and its bytes show whether it has it.

Many files say ISO8859-1 and are UTF-8, since PocketSphinx does not look at the name. Letters beyond
ASCII that are valid UTF-8 are hardly ever anything else (RFC 3629, section 1), so they win.
"""

from __future__ import annotations

import codecs
import re
from pathlib import Path
from typing import NamedTuple

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place
from hri.core.reading import read_bytes, read_text
from hri.speech.grammar.formats import format_of
from hri.speech.grammar.header import Header, read_header

LONGEST_HEADER = 4000
"""Bytes in which the header must stand."""

_KNOWN = re.compile(
    r"ascii|utf-(8|16|32).*|iso8859.*|iso2022.*|cp\d+|koi8.*|mac.*|euc.*|shift.*|gb.*|hz|big5.*"
)
"""Python's names of encodings of text; others are transformations, and some take for ever."""
_OTHER_NAMES = {"jis": "iso2022_jp", "8859_1": "iso8859-1", "eucjis": "euc_jp", "ansi": "cp1252"}
"""Names that Java knows and Python does not; JIS is in an example of the standard."""
_DOUBLE_BYTE = re.compile(r"cp9\d\d|euc.*|shift.*|gb.*|big5.*")
"""Two bytes for a letter, which now and then are those of a letter in UTF-8."""
_WIDER = {
    "iso8859-1": "cp1252", "gb2312": "gb18030", "gbk": "gb18030", "shift_jis": "cp932",
    "euc_kr": "cp949", "big5": "cp950",
}  # fmt: skip
"""What files really have that say they have the narrower one, as browsers take them
(encoding.spec.whatwg.org)."""
_CONTROL = re.compile("[\x80-\x9f]")
"""Letters that no text has: they are quotes and dashes in cp1252."""
_REMEDY = 'save it as UTF-8 and write "#JSGF V1.0 UTF-8 en;"'


class Source(NamedTuple):
    """The text of a file."""

    text: str
    doubt: AuthoringError | None = None
    """What is wrong with the encoding that its header names."""


def read_source(path: Path) -> Source:
    """The text of a grammar file, in the encoding that its bytes show, or else its header names.

    Raises HriError when it cannot be read, AuthoringError when it is not a text in that encoding.
    """
    if paths.exists(path) and path.is_dir():
        raise HriError(f"{path}: this is a folder - name a grammar file in it")
    if not paths.exists(path):
        raise HriError(f"{path}: no such grammar file - check the path")
    raw = read_bytes(path, "grammar")
    if (utf16 := _utf16_of(raw)) is not None:
        return Source(_decoded(raw, utf16, path))
    begin = raw[:LONGEST_HEADER].removeprefix(codecs.BOM_UTF8)
    header = read_header(begin.decode("latin-1"))
    if header is None and _attempted(raw, "utf-8") is None:
        other = raw.decode("latin-1")
        if format_of(other) is not None:  # which is told, rather than its encoding
            return Source(other)
    if header is None or _codec(header.encoding or "utf-8") == "utf-8":
        return Source(read_text(path, "grammar"))
    return _weighed(raw, header, path)


def _utf16_of(raw: bytes) -> str | None:
    """The name of UTF-16 that a file begins in: with its mark, or with a letter of ASCII in it."""
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if len(raw) < 2 or raw.count(0, 0, 2) != 1:
        return None
    return "utf-16-be" if raw[0] == 0 else "utf-16-le"


def _weighed(raw: bytes, header: Header, path: Path) -> Source:
    """The text, decoded by weighing its header against its bytes."""
    codec, unicode = _codec(header.encoding), _attempted(raw, "utf-8-sig")
    if unicode is not None and (not codec or codec.startswith("utf-") or _is_sure(unicode, codec)):
        return Source(unicode, _doubt(header, "UTF-8" if codec else "", path))
    if not codec:
        what = f'unknown encoding "{header.encoding}"'
        raise AuthoringError(Place(path), what, _REMEDY)
    text, wider = _attempted(raw, codec), _WIDER.get(codec, "")
    if wider and (text is None or (codec == "iso8859-1" and _CONTROL.search(text))):
        other = _attempted(raw, wider)
        if other is not None:
            return Source(other, _doubt(header, wider, path))
    if text is None and unicode is not None:
        return Source(unicode, _doubt(header, "UTF-8", path))
    return Source(_decoded(raw, header.encoding, path) if text is None else text)


def _is_sure(unicode: str, codec: str) -> bool:
    """Whether a text that is valid UTF-8 is nothing else."""
    least = "\u0800" if _DOUBLE_BYTE.fullmatch(codec) else "\x80"
    return any(letter >= least for letter in unicode)


def _codec(encoding: str) -> str:
    """Python's name of an encoding of text; empty when it knows none."""
    try:
        name = codecs.lookup(_OTHER_NAMES.get(encoding.lower(), encoding)).name
    except LookupError:
        return ""
    return name if _KNOWN.fullmatch(name) else ""


def _attempted(raw: bytes, codec: str) -> str | None:
    try:
        return raw.decode(codec)
    except UnicodeError:
        return None


def _decoded(raw: bytes, encoding: str, path: Path) -> str:
    try:
        return raw.decode(_codec(encoding))
    except UnicodeError as error:
        raise AuthoringError(Place(path), f"not {encoding} text", _REMEDY) from error


def _doubt(header: Header, found: str, path: Path) -> AuthoringError:
    """A header that is wrong; `found` is empty when nobody knows the encoding that it names."""
    what = f"the header says {header.encoding}, but this file is {found}"
    if not found:
        what = f'unknown encoding "{header.encoding}", read as UTF-8'
    said = f'write "#JSGF V1.0 UTF-8{" " + header.locale if header.locale else ""};"'
    remedy = said if found in ("", "UTF-8") else f"save it as UTF-8 and {said}"
    return AuthoringError(Place(path), what, remedy)
