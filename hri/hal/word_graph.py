"""What an engine gets of a grammar: a graph whose paths are the sentences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

SILENT = -1
"""The label of an arc that is passed without a word."""
MOST_LETTERS = 1000
"""Of the words of a free slot, where the grammar gives no number."""


@dataclass(frozen=True, slots=True)
class SpokenSlot:
    """Words that nobody listed and that are a value: `<name.spoken>` in a grammar."""

    name: str
    """Of the tag that its words are the value of."""
    least: int
    most: int
    """How many words."""
    known: tuple[str, ...] = ()
    """What it usually is, lower case words with one space between; it may be anything else."""
    letters: tuple[int, int] = (1, MOST_LETTERS)
    """How many letters and digits its words have together, least and most."""
    like: str = ""
    """A pattern that it has, lower case, as in `fnmatch`; empty for none."""
    without: frozenset[str] = frozenset()
    """Words that it never has, lower case."""


@dataclass(frozen=True, eq=False)
class WordGraph:
    """Which word may follow which: paths from `start` to `final` are the sentences.

    Nodes are the numbers 0 to `size` - 1. Silent arcs never form a circle, every node lies on a
    way from `start` to `final`, and nothing leads to `start`.
    """

    size: int
    start: int
    final: int
    """The one node where sentences end; nothing leaves it."""
    sources: NDArray[np.int32]
    """The node that each arc leaves, in ascending order. [arcs]"""
    targets: NDArray[np.int32]
    """The node that each arc leads to. [arcs]"""
    labels: NDArray[np.int32]
    """The word of each arc, an index into `words`; SILENT for none. [arcs]"""
    weights: NDArray[np.float32]
    """Natural logarithm of how likely each arc is among those of its source, and what free words
    cost beside; <= 0. [arcs]"""
    words: tuple[str, ...]
    """All words, lower case, each once. `<any>`, `<any 1-3>` and `<name.spoken>` are as many that
    nobody listed (`hri.speech.grammar.words.free_words`)."""
    entries: Mapping[str, int]
    """Public rule: the node its own words begin at. One silent arc leads there, from `start` or
    from behind what may be said before many rules."""
    expected: frozenset[str] = frozenset()
    """The public rules that are likelier than others whenever they count."""
    slots: Mapping[str, SpokenSlot] = field(default_factory=dict)
    """The free slots among `words`, by how they are written there."""
