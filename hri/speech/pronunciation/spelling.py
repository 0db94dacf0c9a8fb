"""What an author may have meant by a word that no dictionary knows."""

from __future__ import annotations

import string
from collections.abc import Iterator

from hri.speech.pronunciation.lexicon import Lexicon

LONGEST_WORD = 30
"""Letters; a longer word is not looked into."""
SHORTEST_PART = 3
"""Letters of each of two words that were written as one."""
_LETTERS = string.ascii_lowercase + "'"


def split(word: str, lexicon: Lexicon) -> str:
    """Known words that were written as one: "footpath" as "foot path", "turn_on"; else empty."""
    parts = [part for part in word[:LONGEST_WORD].split("_") if part]
    if "_" in word:
        return " ".join(parts) if parts and all(part in lexicon for part in parts) else ""
    cuts = range(SHORTEST_PART, min(len(word), LONGEST_WORD) - SHORTEST_PART + 1)
    ways = (f"{word[:cut]} {word[cut:]}" for cut in cuts if _are_known(word, cut, lexicon))
    return next(ways, "")


def _are_known(word: str, cut: int, lexicon: Lexicon) -> bool:
    return word[:cut] in lexicon and word[cut:] in lexicon


def near(word: str, lexicon: Lexicon) -> str:
    """A known word that is one slip of the fingers away, with the same first letter; else empty."""
    if not 4 <= len(word) <= LONGEST_WORD:
        return ""
    return next((meant for meant in _slips(word) if meant != word and meant in lexicon), "")


def _slips(word: str) -> Iterator[str]:
    """Words with two letters swapped, one more, one fewer, one other: likeliest slips first."""
    places = range(1, len(word))
    for place in range(1, len(word) - 1):
        yield word[:place] + word[place + 1] + word[place] + word[place + 2 :]
    for place in (*places, len(word)):
        yield from (word[:place] + letter + word[place:] for letter in _LETTERS)
    for place in places:
        yield word[:place] + word[place + 1 :]
    for place in places:
        yield from (word[:place] + letter + word[place + 1 :] for letter in _LETTERS)
