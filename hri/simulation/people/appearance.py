"""What someone looks like: the measures and the colors of a drawn person.

Lengths are in half heads (chin to crown is 2); colors are red, green, blue, 0 to 255.
"""

from __future__ import annotations

from dataclasses import dataclass

from hri.simulation.people.soft_edges import Color

DEFAULT_ACTOR = "ada"
"""The default actor; see `actors.ACTORS`."""


@dataclass(frozen=True, slots=True)
class Outfit:
    """Clothes."""

    shirt: Color
    trousers: Color = (58, 58, 70)
    stripes: float = 0.0
    """How much darker every other stripe of the shirt is, 0 for a plain one to 1."""


@dataclass(frozen=True, slots=True)
class Looks:
    """One person's head and clothes. Everything that is a factor is about 1."""

    skin: Color = (226, 172, 142)
    hair: Color = (74, 50, 38)
    brows: Color = (62, 40, 32)
    lips: Color = (178, 92, 88)
    iris: Color = (84, 98, 78)
    shirt: Color = (62, 92, 120)
    width: float = 1.0
    """How wide the face is."""
    jaw: float = 1.0
    """How wide the chin is."""
    nose: float = 1.0
    """How far the nose stands out."""
    brow: float = 1.0
    """How far the bone above the eyes stands out."""
    eyes: float = 1.0
    """How large the eyes are."""
    mouth: float = 1.0
    """How wide the mouth is."""
    hairline: float = -0.62
    """Where the hair begins above the forehead."""
    hair_length: float = 0.0
    """How far the hair reaches below the ears, half heads; 0 for short hair."""
    beard: float = 0.0
    """How dense the beard is, 0 to 1."""
    has_glasses: bool = False
    is_for_tests: bool = False
    """Kept for held-out figures: nothing may be tuned on this face."""
