"""Layers of a drawing: its parts by what they are, for pictures of some of them and for one bit.

    [layers]
    body = ["shell", "ear*"]
    face = ["plate"]
    ink = ["eye*", "brow*"]
    lit = ["body", "face"]

A part is in one layer at most: of several patterns that fit its id the last one counts.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase

from hri.core.errors import did_you_mean
from hri.core.toml import Table
from hri.face.drawing.svg import STROKE

LAYERS = ("body", "face", "ink")
"""Head and everything behind it, the surface that the features lie on, and the features."""
LIT = ("body", "face")
"""What is light in one bit, unless the table says otherwise."""


@dataclass(frozen=True, slots=True)
class Layers:
    """The table [layers] of a face; without patterns where it has none."""

    patterns: Mapping[str, str]
    """Layers by pattern of ids, such as "eye*", in the order of the file."""
    lit: tuple[str, ...] = LIT
    """The layers that are light in one bit; the others are dark."""

    def of(self, id: str) -> str | None:
        """The layer of a part; None for one that is in none."""
        part = id.removesuffix(STROKE)
        fitting = [layer for pattern, layer in self.patterns.items() if fnmatchcase(part, pattern)]
        return fitting[-1] if fitting else None


def read_layers(table: Table) -> Layers:
    """Raises AuthoringError for a layer that there is not, or a pattern in two of them."""
    lit = tuple(table.strings("lit", LIT))
    for layer in lit:
        _check(table, "lit", layer)
    patterns: dict[str, str] = {}
    for layer in table.data:
        if layer == "lit":
            continue
        _check(table, layer, layer)
        for pattern in table.strings(layer):
            if pattern in patterns:
                what = f'"{pattern}" is in {patterns[pattern]} and in {layer}'
                raise table.error(layer, what, "write it in one of them")
            patterns[pattern] = layer
    return Layers(patterns, lit)


def _check(table: Table, key: str, layer: str) -> None:
    if layer not in LAYERS:
        raise table.error(key, f'no layer "{layer}"', did_you_mean(layer, LAYERS))
