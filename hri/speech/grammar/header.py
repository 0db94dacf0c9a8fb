"""The first line of a JSGF file: `#JSGF V1.0 UTF-8 en;`.

It is read as liberally as other programs read it: in small letters, with more spaces, and with
comments before and in it.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_COMMENT = r"/\*(?:[^*]|\*(?!/))*+\*/"
_BEFORE = re.compile(rf"(?:[\ufeff\s]++|//[^\n]*+|{_COMMENT})*+")
_GAP = rf"(?:[ \t]|{_COMMENT})"
_HEADER = re.compile(
    rf"#[ \t]*JSGF{_GAP}++V?[ \t]*1(?:\.[0-9]++)?(?:{_GAP}++(?P<encoding>[\w.:-]++))?"
    rf"(?:{_GAP}++(?P<locale>[\w-]++))?{_GAP}*+;",
    re.IGNORECASE,
)
_LOCALE = re.compile(r"[a-z]{2}([-_][A-Za-z]{2})?")
"""No encoding has a name of this form."""


class Header(NamedTuple):
    """What the first line says."""

    encoding: str
    """Empty when it names none."""
    locale: str
    """The language, such as "en" or "en-US"; empty when it names none."""
    end: int
    """The offset behind its ";"."""


def read_header(text: str) -> Header | None:
    """The header that a text begins with; None when there is none that is understood."""
    before = _BEFORE.match(text)
    match = _HEADER.match(text, before.end() if before else 0)
    if match is None:
        return None
    encoding, locale = match["encoding"] or "", match["locale"] or ""
    if not locale and _LOCALE.fullmatch(encoding):
        encoding, locale = "", encoding
    return Header(encoding, locale, match.end())
