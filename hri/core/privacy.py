"""Privacy: files and folders that only their owner can read, and names of people in texts."""

from __future__ import annotations

import os
import re
import stat
import unicodedata
from contextlib import suppress
from pathlib import Path

from hri.core import paths
from hri.core.open_files import AT_ONCE, BINARY
from hri.core.writing import PRIVATE, make_folder, not_written

PRIVATE_FOLDER = 0o700
"""Permissions of a folder that only its owner may enter."""
_OTHERS = stat.S_IRWXG | stat.S_IRWXO


def is_same_name(one: str, other: str) -> bool:
    """Whether two names are the same but for capital letters and how accents are written."""
    return _folded(one) == _folded(other)


def is_named(person: str, text: str) -> bool:
    """Whether a person is named in a text, in capital letters or not.

    Names are words of letters, which end at anything else and at a capital: Anna is named in
    `IMG_anna2.jpg`, in `annaCup`, in "anna's cup" and "Annas cup", and not in Joanna.
    """
    words = _in_words(person).split()
    if not words:
        return bool(person.strip()) and _folded(person) in _folded(text)
    plain = _folded(_without_marks(text))
    if not all(word.replace(JOINT, "") in plain for word in words):
        return False
    name = f"[ {JOINT}]?".join(f"{JOINT}?".join(word.replace(JOINT, "")) for word in words)
    return re.search(rf"[ {JOINT}]{name}(?:[ {JOINT}]|s[ {JOINT}]\w)", _in_words(text)) is not None


JOINT = "-"
"""Between two parts of a word that is written in camel case, or of letters and digits."""


def _in_words(text: str) -> str:
    """The letters and digits of a text, folded: words between blanks, their parts at a JOINT."""
    made, last = [" "], " "
    composed = unicodedata.normalize("NFC", _without_marks(text))
    kinds = [unicodedata.category(character) for character in composed]
    for character, kind, after in zip(composed, kinds, [*kinds[1:], " "], strict=False):
        if kind[0] == "M":  # an accent that NFC leaves alone belongs to the letter before it
            made.append(character)
            continue
        if kind[0] not in "LN":
            character = kind = " "
        elif last != " " and _is_joint(last, kind, after):
            made.append(JOINT)
        if kind != " " or last != " ":
            made.append(character)
        last = kind
    return _folded("".join(made)).rstrip(" ") + " "


def _is_joint(before: str, kind: str, after: str) -> bool:
    """Whether a part of a word begins, by the categories of a character and those beside it."""
    if before[0] != kind[0]:
        return True
    return kind == "Lu" and (before != "Lu" or after == "Ll")


def _without_marks(text: str) -> str:
    """Without invisible characters, such as soft hyphens."""
    if text.isprintable():
        return text
    return "".join(one for one in text if unicodedata.category(one) != "Cf")


def _folded(text: str) -> str:
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", text).casefold())


def private_folder(folder: Path) -> None:
    """Make a folder that only its owner may enter; one that is there is closed to others.

    Raises NotWritten.
    """
    make_folder(folder, PRIVATE_FOLDER)
    close_to_others(folder)


def folder_for(file: Path) -> None:
    """Make the folder of a private file, where it is missing; our own is closed to others.

    One that someone else made for more than this file stays as it is. Raises NotWritten.
    """
    if file.parent in paths.own_folders():
        private_folder(file.parent)
    else:
        make_folder(file.parent, PRIVATE_FOLDER)


def private_file(path: Path) -> None:
    """Make an empty file that only its owner may read; one that is there is closed to others.

    For what a library opens and writes itself. Raises NotWritten.
    """
    try:
        os.close(os.open(path, os.O_WRONLY | os.O_CREAT | AT_ONCE | BINARY, PRIVATE))
    except OSError as error:
        raise not_written(path, error) from error
    close_to_others(path)


def close_to_others(path: Path) -> None:
    """Take from the group and from all others what they may do with a file or a folder.

    What is missing, belongs to someone else, or is neither, such as a device, is left alone.
    """
    with suppress(OSError):
        mode = path.stat().st_mode
        if (stat.S_ISREG(mode) or stat.S_ISDIR(mode)) and mode & _OTHERS:
            path.chmod(stat.S_IMODE(mode) & ~_OTHERS)
