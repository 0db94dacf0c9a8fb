"""What the robot thinks of people: a number from -1 (hated) to 1 (loved), 0 for a stranger.

It is the tanh of a regard that stimuli add to and that fades over a month, so that it stays within
its range and things of the same instant commute. It scales a person's effect on the robot: pleasant
things count for more from someone it likes, hurtful ones from someone it dislikes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hri.emotion.emotions import EMOTIONS, INDEX, PART_OF

FADES_S = 30 * 86400.0
"""Seconds in which a regard falls to 1/e."""
PRAISED = 0.1
"""What a deed of full praiseworthiness adds to the regard for who did it."""
WEIGHT = 0.5
"""How much more, or less, a person of relation 1 moves the robot than a stranger."""
MOST = 200
"""People that are remembered; of more the most indifferent one is forgotten."""

SIGNS = {part: 1.0 if EMOTIONS[INDEX[name]].is_positive else -1.0 for part, name in PART_OF.items()}
"""1 for each part of an emotion that pleases, -1 for the others."""
MISSED_S = 3600.0
"""Seconds without a friend after which two thirds of how much it can miss them is reached."""


def is_unnamed(person: str) -> bool:
    """Whether this is not a name but the id of someone in sight: "p1", "p2" (see `Person.id`).

    The next time it is someone else's: what the robot thinks of them ends with its run.
    """
    return person[:1] == "p" and person[1:].isdecimal()


def relation_of(regard: float) -> float:
    """The relation, -1 to 1, of a regard."""
    return math.tanh(regard)


def weighted(charges: Mapping[str, float], relation: float) -> dict[str, float]:
    """What a person of this relation, -1 to 1, charges where a stranger charges this."""
    return {
        name: charge * (1.0 + WEIGHT * relation * SIGNS[name]) for name, charge in charges.items()
    }
