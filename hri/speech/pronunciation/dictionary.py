"""The CMU Pronouncing Dictionary, for hearing and for speaking: looked up in the file itself.

The words are sorted by their bytes, their variants behind them ("a", "a(2)", "a's"), so a word is
found by halving the file some twenty times, and nothing has to be read. The words that were looked
up last are kept: a grammar and its rivals ask for the same ones each time.
"""

from __future__ import annotations

import mmap
from functools import cache, lru_cache
from pathlib import Path

from hri.core.errors import NotAvailable
from hri.speech.pronunciation.phones import Phones

DICTIONARY = Path(__file__).with_name("cmudict-en-us.dict")
"""134,000 lines, sorted by bytes: a word, spaces, its phones with stress."""
MOST_KEPT = 5000
"""Words."""


class Dictionary:
    """Pronunciations of 126,000 English words, with stress."""

    def __init__(self, path: Path) -> None:
        with path.open("rb") as file:
            self._lines = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        self._looked_up = lru_cache(maxsize=MOST_KEPT)(self._look_up)

    def __contains__(self, word: str) -> bool:
        return self._find(word.encode()) is not None

    def pronunciations(self, word: str) -> tuple[Phones, ...]:
        """All ways to say a word, the likeliest first; empty when it is not there."""
        return self._looked_up(word)

    def _look_up(self, word: str) -> tuple[Phones, ...]:
        sought = word.encode()
        start = self._find(sought)
        found: list[Phones] = []
        while start is not None and start < len(self._lines):
            end = self._lines.find(b"\n", start)
            end = end if end >= 0 else len(self._lines)
            name, *phones = self._lines[start:end].split()
            if _without_number(name) != sought:
                break
            found.append(tuple(phone.decode() for phone in phones))
            start = end + 1
        return tuple(found)

    def _find(self, sought: bytes) -> int | None:
        """Where the first line of a word begins."""
        low, high = 0, len(self._lines)
        while low < high:
            # `low` and `high` stay at beginnings of lines.
            start = self._lines.rfind(b"\n", low, (low + high) // 2) + 1 or low
            end = self._lines.find(b" ", start)
            if _without_number(self._lines[start:end]) < sought:
                low = self._lines.find(b"\n", end) + 1 or len(self._lines)
            else:
                high = start
        return low if self._lines[low : low + len(sought) + 1] == sought + b" " else None


def _without_number(name: bytes) -> bytes:
    """The word of a line: "read" for "read(2)"."""
    return name.partition(b"(")[0]


def cmu_dictionary() -> Dictionary:
    """The dictionary that comes with `hri`. Raises NotAvailable in a copy that lacks it."""
    if not DICTIONARY.is_file():
        raise NotAvailable(f"the dictionary {DICTIONARY} is missing - install hri again")
    return _opened(DICTIONARY)


@cache
def _opened(path: Path) -> Dictionary:
    return Dictionary(path)
