"""Lids: how far eyes are shut, and what a blink adds to that.

A blink shuts each eye by as much as it is open. So it changes nothing of eyes that are shut. What
bends the lids stays as it is where a drawing says how they are shut with it (a corrective such as
`eyeBlink+eyeWide`), and for as much as it says: from 0 to 1, and of two with their own corrective
one gives way. The rest is taken away while the eyes are shut.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.face.model import FaceModel
from hri.face.vocabulary import SIDES

SHUT = "eyeBlink"
"""Beginning of the names of the channels that shut the eyes."""
BENT = ("eyeWide", "eyeSquint", "eyeDroop", "eyeLookUp", "cheekSquint", "browDown")
"""Beginnings of the names of those that open or bend the lids, the ones that give way first."""
WAY = 4.0
"""One that gives way is gone where the other is at 1 / WAY."""

Weights = NDArray[np.float64]
"""One number for each channel."""
Closures = tuple[float, float]
"""How far the left and the right eye are shut, 0 to 1; sides are those of the face."""
OPEN: Closures = (0.0, 0.0)


class Lids:
    """The lids of one face."""

    def __init__(self, model: FaceModel) -> None:
        channels, pairs = model.channels, set(model.display.products)
        shut = [name for name in channels if name.startswith(SHUT)]
        drawn = {name for pair in pairs if not set(shut).isdisjoint(pair) for name in pair}
        self._shut = np.flatnonzero([name in shut for name in channels])
        self._eye_of = np.array([_eye_of(name, shut) for name in channels])
        self._sides = np.array([_sides_of(name) for name in channels])
        self._bent = np.array([name.startswith(BENT) for name in channels], float)
        self._drawn = np.array([name in drawn for name in channels], float)
        self._rivals = np.zeros((len(channels), len(channels)))
        for pair in pairs:
            if all(name.startswith(BENT) for name in pair):
                first, second = sorted(pair, key=_order)
                self._rivals[channels.index(first), channels.index(second)] = WAY
        self._blink = model.vector(model.settings.blink.weights).astype(float)

    def shut(self, weights: Weights) -> float:
        """How far both eyes are shut, 0 to 1."""
        shut = float(weights[self._shut].mean()) if len(self._shut) else 0.0
        return min(max(shut, 0.0), 1.0)

    def owned(self, owned: NDArray[np.floating]) -> float:
        """Lid ownership implied by per-channel ownership."""
        return float(owned[self._shut].max(initial=0.0))

    def blinking(self, weights: Weights, blink: Closures) -> Weights:
        """The weights with as much of a blink at each eye.

        What is on neither side takes the mean of both.
        """
        if blink == OPEN:
            return weights
        share = self._sides @ blink * np.maximum(1 - self._eye_of @ weights[self._shut], 0.0)
        whole = np.minimum(share, 1.0) * self._bent
        as_drawn = np.clip(weights, 0.0, 1.0)
        kept = as_drawn * self._drawn * (1 - np.minimum(self._rivals @ as_drawn, 1.0))
        shut: Weights = weights + whole * (kept - weights) + share * self._blink
        return shut


def _order(channel: str) -> int:
    """The place of a channel in `BENT`."""
    return next(n for n, beginning in enumerate(BENT) if channel.startswith(beginning))


def _sides_of(channel: str) -> Closures:
    """How much the left and the right eye count for a channel."""
    left, right = (float(channel.endswith(side)) for side in SIDES)
    return (left, right) if left or right else (0.5, 0.5)


def _eye_of(channel: str, shut: Sequence[str]) -> list[float]:
    """How much each channel that shuts an eye counts for a channel: those of its side."""
    side = next((side for side in SIDES if channel.endswith(side)), "")
    same = [name.endswith(side) for name in shut]
    return [float(is_same) / max(sum(same), 1) for is_same in same]
