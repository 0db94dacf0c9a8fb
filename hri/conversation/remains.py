"""Searches all files that the program wrote for someone who was forgotten.

`hri.conversation.personal_data` forgets kind by kind; this looks at the bytes, whoever wrote them.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

from hri.conversation import memory_file
from hri.conversation.personal_data import (
    KEPT,
    lines_of,
    people as known_people,
    remembered,
    texts_of,
)
from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import is_named
from hri.core.reading import read_bytes
from hri.core.recorded import parts
from hri.emotion.emotions import NAMES
from hri.emotion.stimulus import load_stimuli

SHORTEST = 3
"""Letters of words of a fact that are searched for: shorter ones are everywhere."""
SHORTEST_IN_BYTES = 5
"""Letters of a name that are searched for in what is not text: chance writes shorter ones."""
_HEAD = 4096
"""Bytes that show whether a file is text."""


def remains(
    names: Collection[str], told: Iterable[str] = (), spared: Collection[Path] = ()
) -> list[tuple[Path, str]]:
    """Files that still hold the name of someone, or words that they told, each with one of these.

    What others who are known have told, too, does not count, nor do the places in `spared`.
    """
    known = {text for one in remembered() for text in one.texts()}
    # A note of where something lies is not about anyone, if what lies there is not.
    places = {str(place) for kept in KEPT for place in kept.places()}
    others = sorted({*known, *known_people(), *places, str(paths.home())}, key=len, reverse=True)
    # Feelings are full of words of the program.
    own = {*NAMES, *load_stimuli()}
    long = [word for word in told if len(word) >= SHORTEST and word.casefold() not in own]
    found = []
    for file in dict.fromkeys(_written(spared)):
        # The user wrote the settings, for reasons that have nothing to do with what someone told.
        is_setting = paths.settings_folder() in file.parents
        words = dict.fromkeys(names if is_setting else (*names, *long))
        if (word := _first_in(file, words, others)) is not None:
            found.append((file, word))
    return found


def _written(spared: Collection[Path]) -> Iterator[Path]:
    """The files of the program's own folders, and of all places that were noted."""
    places = [place for kept in KEPT for place in kept.places()]
    for folder in (*paths.own_folders(), *places):
        for file in _files(folder):
            if not any(place in (file, *file.parents) for place in spared):
                yield file


def _files(place: Path) -> Iterator[Path]:
    """The files of a place; of a recording those that are the robot's."""
    if place.is_file():
        yield place
    elif place in paths.own_folders():
        fetched = paths.data_folder() / "models"
        for folder, below, names in os.walk(place):
            below[:] = [name for name in below if Path(folder, name) != fetched]
            yield from (Path(folder, name) for name in sorted(names))
    else:
        yield from parts(place)


def _first_in(file: Path, words: Iterable[str], others: Iterable[str]) -> str | None:
    """The first of the words that a file holds; None if it holds none."""
    if memory_file.is_database(file):
        return _first_in_database(file, words)
    if not _is_text(file):
        is_cache = paths.cache_folder() in file.parents
        return None if is_cache else _first_in_bytes(file, words)
    texts = [_without(text, others) for line in lines_of(file) for text in texts_of(line)]
    named = (word for word in words if any(is_named(word, text) for text in (*texts, file.name)))
    return next(named, None)


def _without(text: str, others: Iterable[str]) -> str:
    """A text without texts that do not count."""
    text = text.casefold()
    for other in others:
        text = text.replace(other.casefold(), " ")
    return text


def _first_in_database(file: Path, words: Iterable[str]) -> str | None:
    """In the bytes of the memory of people, but for what it says of those who are remembered."""
    data = _bytes(file)
    for text in sorted(memory_file.texts(file), key=len, reverse=True):
        data = data.replace(text.encode().lower(), b"\0")
    return next((word for word in words if word.encode().lower() in data), None)


def _first_in_bytes(file: Path, words: Iterable[str]) -> str | None:
    long = [word for word in words if len(word) >= SHORTEST_IN_BYTES]
    data = _bytes(file) if long else b""
    return next((word for word in long if word.encode().lower() in data), None)


def _is_text(file: Path) -> bool:
    try:
        with file.open("rb") as opened:
            return b"\0" not in opened.read(_HEAD)
    except OSError:
        return False


def _bytes(file: Path) -> bytes:
    """The bytes of a file, in small letters; none of one that cannot be read."""
    try:
        return read_bytes(file, "file", 1 << 30).lower()
    except HriError:
        return b""
