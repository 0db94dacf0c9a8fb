"""What is said to measure slots: sentences in and outside of two grammars, and people's orders.

`house` is what is measured: its grammar was written before anyone knew the sentences outside of it,
which two other people wrote. `cafe` shares no sentence with it and is for fitting.
"""

from __future__ import annotations

import random
import zlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any, Literal

import numpy as np

from benchmarks.speech.accuracy import outside
from benchmarks.speech.conditions import heard_in, padded
from benchmarks.speech.texts import lines
from benchmarks.speech.voices import VOICES, spoken
from hri.bench.speech.samples import ORDERS, Clip, Recordings
from hri.bench.speech.scoring import slots
from hri.core.errors import NotAvailable
from hri.core.signals import Samples
from hri.speech.grammar import Grammar, Parse, load_grammar
from hri.speech.grammar.expansion import random_sentences
from hri.speech.grammar.matching import parse

Kind = Literal["outside", "inside", "orders"]
HERE = Path(__file__).parent
GRAMMARS: Mapping[str, Path] = {
    "house": HERE / "house.jsgf",
    "cafe": HERE / "cafe.jsgf",
    "orders": ORDERS,
}
SPOKEN = ("house", "cafe")
"""Sets that voices say."""
SPEAKERS = ("heart", "en-us", "en-gb+f3")
INSIDE = 150
"""Sentences inside of a grammar, of which chance draws those that nobody wrote."""
LEVELS: Mapping[str, Sequence[str]] = {
    "clean": ("clean",),
    "12 dB": ("12 dB", "12 dB in a kitchen", "12 dB over pink noise"),
    "6 dB": ("6 dB", "6 dB in a kitchen", "6 dB over pink noise"),
}
"""Conditions by how loud the noise is. A spoken sentence is heard in one of them, an order of
people in all."""
STAND_INS: Mapping[str, Sequence[str]] = {
    "house": ("cup", "kitchen", "anna", "claude monet", "lamp", "red"),
    "cafe": (
        *("latte macchiato", "bagel", "natalie", "counter", "johann sebastian bach", "two"),
        *("milk", "napkins", "espresso machine", "onions"),
    ),
}
"""One entry of each kind of slot."""
STRANGE = 3
"""Words in a row that alone differ, of a sentence that is near to one of the grammar."""
TALKING = 8
"""Sentences of the babble, in each voice."""


@dataclass(frozen=True, eq=False)
class Saying:
    """A clip and what it means."""

    clip: Clip
    set: str
    kind: Kind
    condition: str
    meant: Mapping[str, Any] | None
    """The rule and the tags, or the slots of an order; None outside of the grammar."""
    same: Mapping[str, Any] | None = None
    """The rule and the tags that mean the same, of a sentence outside."""
    other: Clip | None = field(default=None, repr=False)
    """The same order in other noise: what is said when it is asked for again."""

    def is_meant(self, rule: str, tags: Mapping[str, Any]) -> bool:
        """Whether something that was understood is what was said, in these or other words."""
        wanted = self.meant or self.same
        return wanted is not None and meaning(self.set, rule, tags) == wanted


def meaning(set_: str, rule: str, tags: Mapping[str, Any]) -> dict[str, Any]:
    """What a command means, as `Saying.meant` has it."""
    return slots(tags) if set_ == "orders" else {"rule": rule, "tags": dict(tags)}


@cache
def grammar(set_: str) -> Grammar:
    """The grammar of a set."""
    return load_grammar(GRAMMARS[set_])


def sayings(
    set_: str,
    level: str,
    people: Recordings | None,
    cache_folder: Path | None = None,
    voices: Collection[str] = SPEAKERS,
    step: int = 1,
    draw: int = 0,
) -> Iterator[Saying]:
    """The clips of a set at a level of noise; every `step`th sentence or recording.

    `draw` chooses other noise. Sound of the voices is kept in the folder, if one is given.
    Raises NotAvailable without recordings for the orders.
    """
    if set_ == "orders":
        yield from _orders(level, people, cache_folder, step, draw)
        return
    said = [*_outside(set_), *_inside(set_)]
    for number, saying in enumerate(said[::step]):
        condition = LEVELS[level][number % len(LEVELS[level])]
        for voice in voices:
            clip = _said(saying.clip.sentence, voice, cache_folder)
            (noisy,) = heard_in(condition, [clip], _talkers(cache_folder), draw)
            yield replace(saying, clip=noisy, condition=condition)


def _outside(set_: str) -> Iterator[Saying]:
    """Of `SET_outside.txt`; the sentence behind "=>" means the same."""
    for line in lines(f"{set_}_outside.txt"):
        sentence, _, same = line.partition(" => ")
        equivalent = _meant(set_, same) if same else None
        yield Saying(Clip(sentence, _NOTHING, sentence), set_, "outside", "clean", None, equivalent)


def _inside(set_: str) -> Iterator[Saying]:
    """What others said that the grammar allows, and what chance makes of it."""
    name = f"{set_}_inside.txt"
    written = lines(name) if (HERE / name).exists() else []
    drawn = (text for text in random_sentences(grammar(set_), random.Random(52)) if text)
    for sentence in islice(dict.fromkeys([*written, *islice(drawn, 2 * INSIDE)]), INSIDE):
        clip = Clip(sentence, _NOTHING, sentence)
        yield Saying(clip, set_, "inside", "clean", _meant(set_, sentence))


@cache
def is_near(set_: str, sentence: str) -> bool:
    """Whether only an entry of a list is missing for the grammar to allow a sentence."""
    words = sentence.split()
    return any(
        parse(grammar(set_), " ".join([*words[:first], stand_in, *words[last:]])) is not None
        for first in range(len(words))
        for last in range(first + 1, min(len(words), first + STRANGE) + 1)
        for stand_in in STAND_INS[set_]
    )


def _orders(
    level: str, people: Recordings | None, cache_folder: Path | None, step: int, draw: int
) -> Iterator[Saying]:
    if people is None:
        raise NotAvailable("no recordings of people - name their folder with --recordings")
    orders = people.orders[::step]
    for condition in LEVELS[level]:
        said = orders if level == "clean" else [padded(clip) for clip in orders]
        talkers = _talkers(cache_folder)
        first = heard_in(condition, said, talkers, 2 * draw)
        again = heard_in(condition, said, talkers, 2 * draw + 1)
        for clip, other in zip(first, again, strict=True):
            yield Saying(clip, "orders", "orders", condition, dict(clip.slots), other=other)


def _meant(set_: str, sentence: str) -> dict[str, Any]:
    found: Parse | None = parse(grammar(set_), sentence)
    assert found is not None, f"{GRAMMARS[set_]} does not allow {sentence!r}"
    return meaning(set_, found.rule, found.tags)


@cache
def _talkers(cache_folder: Path | None) -> tuple[Clip, ...]:
    """Who talks to each other in the noise: the same three voices, about other things."""
    sentences = outside()[:: len(outside()) // TALKING]
    return tuple(_said(text, voice, cache_folder) for text in sentences for voice in SPEAKERS)


def _said(sentence: str, voice: str, folder: Path | None) -> Clip:
    """A sentence in a voice; synthesized once where a folder keeps it."""
    if folder is None:
        (clip,) = spoken([sentence], [voice])
        return clip
    file = folder / f"{voice}-{zlib.crc32(sentence.encode()):08x}.npy"
    if not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        np.save(file, VOICES[voice](sentence))
    samples: Samples = np.load(file)
    return Clip(f"{voice}/{sentence}", samples, sentence, voice=voice)


_NOTHING: Samples = np.zeros(0, np.int16)
