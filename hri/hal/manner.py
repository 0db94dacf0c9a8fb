"""How a velocity is to be carried out, by whoever asks for it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.core.signals import Twist

UNBOUND = Twist(math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class Manner:
    """Bounds that a command brings along; the stricter of these and of those of the base count."""

    fastest: Twist = UNBOUND
    """m/s and rad/s."""
    acceleration: Twist = UNBOUND
    """Away from rest, m/s² and rad/s²."""
    deceleration: Twist = UNBOUND
    """Toward rest, where nothing makes it stop."""
    free: float = math.inf
    """Meters free ahead, as far as whoever asks can see."""
    clearance: float = 0.0
    """Meters of these that must stay free."""


FREELY = Manner()
"""As the base allows."""
