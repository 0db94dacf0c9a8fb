"""How the network hears common words otherwise than the dictionary says.

Its teachers pronounced some words as they are spelled, or as another language does: "me" like
"may", "have" like "gave", "one" with an "own" in it. So it gives these sounds for them, whether
people or synthesizers speak. `habits.txt` has such words, in the format of a lexicon. Each of 1,380
common words was spoken eight times by five synthetic voices; it stands there when three voices or
more had the same other phones, in a third of the cases or more, and the dictionary's own were
rarer. What only noise or haste explains (a lost consonant at an end) was left out by hand, and a
few words were added from clean sentences and recordings.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files

from hri.speech.recognizers.ctc.phone_graph import Pronouncing


class Habits:
    """A lexicon, and beside each word what the network makes of it."""

    def __init__(self, lexicon: Pronouncing) -> None:
        self._lexicon = lexicon
        self._heard = heard_otherwise()

    def pronunciations(self, word: str) -> Sequence[Sequence[str]]:
        """All ways in which a word may be heard. Raises HriError as the lexicon does."""
        return [*self._lexicon.pronunciations(word), *self._heard.get(word, ())]


@cache
def heard_otherwise() -> Mapping[str, Sequence[Sequence[str]]]:
    """The entries of `habits.txt`."""
    text = files(__package__).joinpath("habits.txt").read_text(encoding="utf-8")
    entries: dict[str, list[Sequence[str]]] = {}
    for line in text.splitlines():
        word, *phones = line.split()
        entries.setdefault(word, []).append(phones)
    return entries
