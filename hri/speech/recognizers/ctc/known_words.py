"""What usually stands in a free slot, as one tree of phones: all of it is held against a sound."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.speech.pronunciation.names import first_names
from hri.speech.pronunciation.phones import Phones
from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.phone_graph import Pronouncing

Doubles = NDArray[np.float64]
Indices = NDArray[np.intp]

LISTED = 0.5
"""How much it counts against the sound that a list is long: a power of the share of each word."""
REMEMBERED = -0.5
"""Natural log of how likely a word is that people taught."""
COMMON = 1.0
"""Natural log: how much likelier a name is that many people have."""
RARER = -1.0
"""Natural log: how much likelier the first way is to say a word than each other one."""
MOST_WAYS = 8
"""Ways to say several words."""
CLASS_OF: Mapping[str, int] = {name: number for number, name in enumerate(CLASSES)}


@dataclass(frozen=True, eq=False)
class KnownWords:
    """Texts and how each sounds. State s of the tree follows `parents[s]`, none where that is -1.

    One text has an entry for each of its sounds.
    """

    texts: tuple[str, ...]
    sounds: tuple[Phones, ...]
    priors: Doubles
    """[entries] Natural log."""
    phones: Indices
    """[states] Class of the network."""
    parents: Indices
    doubled: Indices
    """States that repeat the phone of their parent: CTC wants a blank between the two."""
    ends: Indices
    """[entries] The state of the last phone."""

    def heard(self, rows: Doubles, come: Doubles, gone: Doubles) -> Doubles:
        """[entries] Natural log of how likely each was said in the frames between two other
        words, its prior in it.

        `rows` [frames, classes] are probabilities; `come` [frames + 1] is how likely the words
        before have ended after some frames, `gone` how likely those behind begin then.
        """
        phone, blank = np.zeros(len(self.phones)), np.zeros(len(self.phones))
        found = np.zeros(len(self.ends))
        roots, before = np.flatnonzero(self.parents < 0), self.parents[self.doubled]
        for frame, row in enumerate(rows):
            states = phone + blank
            coming = states[self.parents]
            coming[roots] = come[frame]
            coming[self.doubled] = blank[before]
            blank = states * row[BLANK]
            phone += coming
            phone *= row[self.phones]
            if gone[frame + 1] > 0.0:
                found += (phone + blank)[self.ends] * gone[frame + 1]
        with np.errstate(divide="ignore"):
            return np.log(found) + self.priors


def known_words(texts: Iterable[str], lexicon: Pronouncing) -> KnownWords:
    """The words of a list; what nobody can pronounce is left out."""
    listed = tuple(texts)
    share, common = -LISTED * math.log(max(len(listed), 1)), first_names()
    entries: dict[tuple[str, Phones], float] = {}
    for text in listed:
        prior = share + (COMMON if text in common else 0.0)
        for rank, sound in enumerate(_said(text, lexicon)):
            entries[text, sound] = prior + (RARER if rank else 0.0)
    return _tree(entries)


def remembered_words(
    taught: Iterable[tuple[str, Phones]], known: Callable[[str], Sequence[Phones]]
) -> KnownWords:
    """Texts as people said them, and as a dictionary has them, which is looked up by `known`.

    They are not guessed: guesses are kept on disk, and what people said is theirs.
    """
    entries: dict[tuple[str, Phones], float] = {}
    for text, phones in taught:
        entries |= {(text, sound): REMEMBERED for sound in (phones, *known(text)) if sound}
    return _tree(entries)


def _said(text: str, lexicon: Pronouncing) -> list[Phones]:
    """The phones of all ways to say a text; none where one of its words has none."""
    try:
        words = [lexicon.pronunciations(word) for word in text.split()]
    except HriError:
        return []
    ways = [tuple(phone for word in way for phone in word) for way in product(*words)]
    return list(dict.fromkeys(ways))[:MOST_WAYS]


def _tree(entries: Mapping[tuple[str, Phones], float]) -> KnownWords:
    phones: list[int] = []
    parents: list[int] = []
    ends: list[int] = []
    children: dict[tuple[int, str], int] = {}
    for _, sound in entries:
        state = -1
        for phone in sound:
            child = children.setdefault((state, phone), len(phones))
            if child == len(phones):
                phones.append(CLASS_OF[phone])
                parents.append(state)
            state = child
        ends.append(state)
    of, before = np.array(phones, np.intp), np.array(parents, np.intp)
    inner = np.flatnonzero(before >= 0)
    return KnownWords(
        tuple(text for text, _ in entries),
        tuple(sound for _, sound in entries),
        np.array(list(entries.values()), np.float64),
        of,
        before,
        inner[of[inner] == of[before[inner]]],
        np.array(ends, np.intp),
    )
