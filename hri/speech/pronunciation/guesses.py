"""Guessed pronunciations, kept on disk: asking espeak-ng takes milliseconds a word."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.ownership import is_of_user
from hri.core.privacy import close_to_others, folder_for, private_file
from hri.core.writing import PRIVATE, append_line, write_text
from hri.speech.pronunciation.letter_to_sound import guesses
from hri.speech.pronunciation.phones import PHONES, Phones

EDITION = "2"
"""Changes when the rules of `letter_to_sound` do; guesses of another edition are not read."""
GUESSES = "guessed-words-*.txt"
"""Files of all editions, in the folder of caches."""
LARGEST_CACHE = 1_000_000
"""Bytes; a larger file is begun again."""
_KNOWN = frozenset(PHONES)


class Guesses:
    """What letter-to-sound rules make of words, asked once for each word of the machine.

    The file is only a shortcut: when it is damaged, or cannot be read or written, nothing is lost.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path or paths.cache_folder() / f"guessed-words-{EDITION}.txt"
        self._known: dict[str, tuple[Phones, ...]] | None = None
        self._is_private = False
        """Whether the file is there, and nobody else can read it."""

    def __getitem__(self, word: str) -> tuple[Phones, ...]:
        """Raises HriError when the word cannot be spoken as English."""
        if self._known is None:
            self._known = _read(self._path)
        if word not in self._known:
            self._known[word] = found = guesses(word)
            self._keep(word, found)
        return self._known[word]

    def _keep(self, word: str, found: tuple[Phones, ...]) -> None:
        line = "\t".join([word, *(" ".join(phones) for phones in found)])
        with suppress(OSError, HriError):
            if self._path.exists() and not self._path.is_file():
                return  # A pipe would wait for a reader for ever.
            if not self._is_private:
                folder_for(self._path)
                private_file(self._path)
                self._is_private = True
            if self._path.stat().st_size > LARGEST_CACHE:
                write_text(self._path, "", PRIVATE)
            append_line(self._path, line)


def _read(path: Path) -> dict[str, tuple[Phones, ...]]:
    """The words of a cache file; lines that make no sense are left out."""
    if not path.is_file():
        return {}
    if not is_of_user(path):  # who wrote it may say anything
        with suppress(OSError):
            path.unlink()
        return {}
    close_to_others(path)
    try:
        with path.open("rb") as file:
            lines = file.read(LARGEST_CACHE * 2).decode("utf-8", errors="replace").splitlines()
    except OSError:
        return {}
    known: dict[str, tuple[Phones, ...]] = {}
    for line in lines:
        word, *spelt = line.split("\t")
        found = tuple(tuple(phones.split(" ")) for phones in spelt)
        if word and found and all(_KNOWN.issuperset(phones) for phones in found):
            known[word] = found
    return known
