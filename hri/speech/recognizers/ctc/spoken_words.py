"""What was said in a free slot: a known word, or phones that are spelled.

The slot stands between words that were found, or at an edge of the piece. Where it begins and ends
is uncertain, so all ways count in which those words fill the frames around it. What is usually said
there is held against the best phones of all, which have a price (I. Bazzi's thesis on words out
of the vocabulary, MIT 2002).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import HeardSlot
from hri.hal.word_graph import SpokenSlot
from hri.speech.grammar.free_slots import Limits
from hri.speech.grammar.words import free_words
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.phones import Phones
from hri.speech.pronunciation.sound_to_letter import load, spellings
from hri.speech.pronunciation.spelling import vocabulary
from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.free_phones import free_phones
from hri.speech.recognizers.ctc.known_words import (
    CLASS_OF,
    KnownWords,
    known_words,
    remembered_words,
)
from hri.speech.recognizers.ctc.lattice import Path
from hri.speech.recognizers.ctc.phone_graph import Floats, Pronouncing
from hri.speech.sayings import chance

Doubles = NDArray[np.float64]

UNLISTED = -3.0
"""Natural log: what it costs that a word is none of the known ones, beside its phones."""
NEXT_WORD = -4.0
"""Natural log: what a word more costs: one name of no list may sound like two short words."""
MOST_LOOKED_AT = 6
"""Candidates of a kind."""
MOST_OTHERS = 9
"""What else a slot may have been."""
MOST_CONTINUED = 2
"""Words behind which others are looked for."""
PEAK_PRICE = 1.5
"""Natural log: what each phone to come costs at least, in the choice of those words."""
SPELLED = 3
"""Spellings that are tried where the author limits them."""
Taught = tuple[tuple[str, Phones], ...]
"""What people said in a slot, each text with its phones."""
MOST_KEPT = 8
"""Lists whose sounds are kept; that of 5,000 names has 1 MB."""


class Sound(NamedTuple):
    """The frames of a slot and of the words beside it."""

    rows: Doubles
    """[frames, classes] Probabilities: the exponential of `confidence.scores_of`."""
    come: Doubles
    """[frames + 1] How likely the word before has ended after some frames."""
    gone: Doubles
    """[frames + 1] How likely the word behind begins then, and fills the rest."""


class Candidate(NamedTuple):
    """What may have been said."""

    score: float
    """Natural log; the higher, the likelier."""
    phones: Phones
    text: str = ""
    """Its known words."""
    prior: float = 0.0
    """What is in the score beside the sound, where its words are known."""
    ends_free: int = 0
    """The number of phones of its known words, where one of none is behind them."""


def sound_of(
    scores: Floats, before: Sequence[Sequence[str]] = (), behind: Sequence[Sequence[str]] = ()
) -> Sound:
    """The sound of a slot in scores [frames, classes], which hold the words beside it, too: each
    in one of some pronunciations, none where there is no such word.
    """
    rows = np.exp(scores[:, : len(CLASSES)].astype(np.float64))
    come = _still(rows)
    if before:
        come = np.sum([_said(rows, phones, come)[0] for phones in before], axis=0)
    gone = np.zeros(len(rows) + 1)
    gone[-1] = 1.0
    if behind:
        turned = rows[::-1]
        ways = [_said(turned, phones[::-1], _still(turned))[1] for phones in behind]
        gone = np.sum(ways, axis=0)[::-1]
    return Sound(rows, come, gone)


def _still(rows: Doubles) -> Doubles:
    """[frames + 1] How likely nothing was said in some frames."""
    return np.concatenate([[1.0], rows[:, BLANK].cumprod()])


def _said(rows: Doubles, phones: Sequence[str], come: Doubles) -> tuple[Doubles, Doubles]:
    """[frames + 1] How likely phones have been said after some frames, and that the last of them
    still sounds; `come` is how likely what is before them has ended.
    """
    classes = np.array([CLASS_OF[phone] for phone in phones])
    doubled = np.flatnonzero(classes[1:] == classes[:-1]) + 1
    phone, blank = np.zeros(len(classes)), np.zeros(len(classes))
    whole, sounding = np.zeros(len(rows) + 1), np.zeros(len(rows) + 1)
    for frame, row in enumerate(rows):
        states = phone + blank
        coming = np.concatenate([come[frame : frame + 1], states[:-1]])
        coming[doubled] = blank[doubled - 1]
        blank = states * row[BLANK]
        phone = (phone + coming) * row[classes]
        whole[frame + 1], sounding[frame + 1] = phone[-1] + blank[-1], phone[-1]
    return whole, sounding


class SpokenWords:
    """What may stand in the slots of a grammar, and how it is heard."""

    def __init__(
        self, slots: Mapping[str, SpokenSlot], lexicon: Lexicon, heard_as: Pronouncing
    ) -> None:
        """`slots` by their labels; `heard_as` are the sounds of the words beside them."""
        self._heard_as = heard_as
        self._slots = slots
        if slots:
            load()
        self._lexicon = lexicon
        self._listed = {label: _listed(slot.known, lexicon) for label, slot in slots.items()}

    def heard(
        self, path: Path, scores: Floats, taught: Mapping[str, Taught]
    ) -> dict[int, HeardSlot]:
        """The slots among the words of a path, by their places, in scores [frames, classes].

        `taught` are words that people said in slots before, by the names of these.
        """
        return {
            place: slot
            for place, word in enumerate(path.words)
            if word in self._slots and (slot := self._slot(path, place, scores, taught)) is not None
        }

    def _slot(
        self, path: Path, place: int, scores: Floats, taught: Mapping[str, Taught]
    ) -> HeardSlot | None:
        slot, known = self._slots[path.words[place]], [self._listed[path.words[place]]]
        if words := taught.get(slot.name):
            known.append(remembered_words(words, self._lexicon.known))
        first, before = self._beside(path, place - 1, place)
        last, behind = self._beside(path, place + 1, place)
        rows = scores[path.spans[first].start : path.spans[last].end]
        sound = sound_of(rows, before, behind)
        limits = Limits(slot.name, slot.letters, slot.like, slot.without)
        found = _spelled(candidates(sound, known, slot.least, slot.most), limits)
        if not found:
            return None
        best, others = found[0], found[1 : 1 + MOST_OTHERS]
        return HeardSlot(
            slot.name,
            best.text,
            best.phones,
            chance([one.score for one in found]),
            tuple(one.text for one in others),
            tuple(one.phones for one in others),
            tuple(round(one.score, 2) for one in (best, *others)),
        )

    def _beside(self, path: Path, beside: int, place: int) -> tuple[int, Sequence[Sequence[str]]]:
        """Where a word stands and how it may sound; of free words, and none, only the slot."""
        if not 0 <= beside < len(path.words) or free_words(path.words[beside]) is not None:
            return place, ()
        return beside, self._heard_as.pronunciations(path.words[beside])


def _listed(texts: tuple[str, ...], lexicon: Lexicon) -> KnownWords:
    """The list of an author; common words where there is none."""
    return _kept(texts or tuple(sorted(vocabulary())), _Same(lexicon, lexicon.of_users()))


class _Same(NamedTuple):
    """A lexicon, equal to those in which the user wrote the same."""

    lexicon: Lexicon
    written: frozenset[tuple[str, tuple[Phones, ...]]]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self.written == other.written

    def __hash__(self) -> int:
        return hash(self.written)


@lru_cache(maxsize=MOST_KEPT)
def _kept(texts: tuple[str, ...], same: _Same) -> KnownWords:
    return known_words(texts, same.lexicon)


def _spelled(found: Sequence[Candidate], limits: Limits) -> list[Candidate]:
    """Those that an author allows, each with its letters, no text and no sound twice."""
    spelled: dict[str, Candidate] = {}
    for one in found:
        if len(spelled) > MOST_OTHERS:
            break
        text = one.text
        if not text or one.ends_free:
            ends = spellings(one.phones[one.ends_free :], SPELLED)
            texts = (f"{text} {end}".strip() for end in ends)
            text = next(filter(limits.allow, texts), "")
        if text and limits.allow(text):
            spelled.setdefault(text, one._replace(text=text))
    return list(spelled.values())


def candidates(sound: Sound, known: Sequence[KnownWords], least: int, most: int) -> list[Candidate]:
    """Known words, and phones of none, of some words; the likeliest first, no sound twice."""
    found: list[Candidate] = []
    begun = [(Candidate(0.0, (), ""), sound)]
    for number in range(1, most + 1):
        for first, rest in begun:
            if number >= least:
                found += [_after(first, one) for one in _single(rest, known)]
        best = max(found, default=None)
        if number == most or (best is not None and best.text and not best.ends_free):
            break
        begun = [
            (_after(first, one), rest._replace(come=_said(rest.rows, one.phones, rest.come)[0]))
            for first, rest in begun
            for one in _beginnings(rest, known)
        ][:MOST_CONTINUED]
    heard: dict[Phones, Candidate] = {}
    for one in sorted(found, key=lambda one: -one.score):
        heard.setdefault(one.phones, one)
    return list(heard.values())


def _after(first: Candidate, one: Candidate) -> Candidate:
    """A word behind others, in whose sound the others count already."""
    price = NEXT_WORD if first.text else 0.0
    return Candidate(
        first.prior + one.score + price,
        (*first.phones, *one.phones),
        f"{first.text} {one.text}".strip(),
        first.prior + one.prior + price,
        len(first.phones) if not one.text else 0,
    )


def _single(sound: Sound, known: Sequence[KnownWords]) -> list[Candidate]:
    free = free_phones(*sound, most=MOST_LOOKED_AT)
    found = [Candidate(UNLISTED + one.score, one.phones) for one in free]
    for words in known:
        found += _best(words, words.heard(*sound), MOST_LOOKED_AT)
    return found


def _beginnings(sound: Sound, known: Sequence[KnownWords]) -> list[Candidate]:
    """Known words that the sound may begin with."""
    peaks = sound.rows[:, 1:].max(axis=1) > sound.rows[:, BLANK]
    ahead = np.exp(-PEAK_PRICE * np.concatenate([peaks[::-1].cumsum()[::-1], [0]]))
    found = [
        one
        for words in known
        for one in _best(words, words.heard(sound.rows, sound.come, ahead), MOST_CONTINUED)
    ]
    return sorted(found, key=lambda one: -one.score)[:MOST_CONTINUED]


def _best(words: KnownWords, scores: Doubles, most: int) -> list[Candidate]:
    order = np.argsort(-scores, kind="stable")[:most].tolist()
    return [
        Candidate(float(scores[at]), words.sounds[at], words.texts[at], float(words.priors[at]))
        for at in order
        if math.isfinite(scores[at])
    ]
