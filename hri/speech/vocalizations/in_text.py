"""Sounds in a text: "[giggle] That tickles." or "[sigh long]"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from hri.core.errors import HriError, did_you_mean
from hri.speech.vocalizations.vocalization import (
    LENGTHS,
    STRENGTHS,
    Vocalization,
    load_sounds,
)

_MARK = re.compile(r"\[([a-z]{1,20}(?:-[a-z]{1,20})?\??)((?: [a-z]{4,6}){0,2})\]")


@dataclass(frozen=True, slots=True)
class SoundMark:
    """A sound that a text asks for."""

    text: str
    """As it is written, brackets included."""
    name: str
    strength: str = ""
    """One of STRENGTHS."""
    length: str = ""
    """One of LENGTHS."""


def parted(
    text: str, sounds: Mapping[str, Vocalization] | None = None
) -> Iterator[str | SoundMark]:
    """The words of a text and the sounds among them, in order; blank words are left out.

    `sounds` are those that are known, else those of the file that is in use. What stands in
    brackets and is not a sound is text like any other.
    """
    begin = 0
    marks = _MARK.finditer(text) if "[" in text else ()
    if marks and sounds is None:
        sounds = load_sounds()
    for found in marks:
        mark = _marked(found, sounds or {})
        if mark is None:
            continue
        if words := text[begin : found.start()].strip():
            yield words
        yield mark
        begin = found.end()
    if words := text[begin:].strip():
        yield words


def check_sounds(text: str) -> None:
    """Raises HriError for a word in brackets that names no sound, as a slip does in a reply."""
    sounds = load_sounds() if "[" in text else {}
    for found in _MARK.finditer(text):
        if _marked(found, sounds) is None:
            near = did_you_mean(found[1], sounds)
            remedy = "write soft or strong, short or long" if found[1] in sounds else near
            raise HriError(f"no sound {found[0]} - {remedy}")


def has_sounds(text: str) -> bool:
    """Whether a text asks for a sound."""
    return "[" in text and any(isinstance(part, SoundMark) for part in parted(text))


def _marked(found: re.Match[str], sounds: Mapping[str, Vocalization]) -> SoundMark | None:
    name, ways = found[1], found[2].split()
    strengths = [way for way in ways if way in STRENGTHS]
    lengths = [way for way in ways if way in LENGTHS]
    is_known = len(strengths) <= 1 and len(lengths) <= 1 and len(strengths + lengths) == len(ways)
    if not is_known or name not in sounds:
        return None
    return SoundMark(found[0], name, "".join(strengths), "".join(lengths))
