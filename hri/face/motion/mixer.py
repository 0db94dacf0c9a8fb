"""Who owns which part of the face: layers become one set of weights.

From the bottom: mood, expression, gesture, speech, idle motion and gaze, blink, override. A gesture
replaces the expression in the regions it owns. Speech owns the mouth; of expression and gesture the
brows, eyes and cheeks stay, and about half of the corners, less where lips are round. A blink shuts
the lids from wherever they are, and changes nothing of eyes that are shut. Shut eyes do not follow
the gaze. An override wins everywhere it names.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Gaze
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel
from hri.face.motion.lids import OPEN, Closures, Lids
from hri.face.regions import NAMES, by_region

CORNER_SHARE = 0.5
"""What expression and gesture keep of the corners of a talking mouth."""
ROUND_SHARE = 0.15
"""What they keep of that while lips are fully round: a small mouth has no room for corners."""
ROUND = ("mouthFunnel", "mouthPucker")
KEPT = {**dict.fromkeys(NAMES, 1.0), "mouth": 0.0, "corners": CORNER_SHARE}
"""What they keep of each region while the face talks."""
INWARD = ("eyeLookInLeft", "eyeLookInRight")

Weighted = Vector | NDArray[np.float64]
"""One number for each channel."""


@dataclass(frozen=True)
class Layers:
    """What each layer asks for."""

    expression: Weighted
    """The mood, and the look shown instead of it."""
    viseme: Weighted
    talking: float = 0.0
    """How much speech owns the mouth, 0 to 1."""
    blink: Closures = OPEN
    """How far a blink shuts the eyes."""
    gaze: Gaze = field(default_factory=Gaze)
    """Of the eyes."""
    inward: float = 0.0
    """What each eye turns to the nose, of its range."""
    idle: Mapping[str, float] = field(default_factory=dict)
    """Weights of motions and pupils, added as they are."""
    gesture: Weighted | None = None
    owned: Weighted | None = None
    """How much of each channel the gesture owns, 0 to 1."""
    override: Weighted | None = None
    """Weights times how much they win."""
    overridden: Weighted | None = None
    """How much the override wins, 0 to 1."""


class Mixer:
    """Mixes layers for one face."""

    def __init__(self, model: FaceModel) -> None:
        self.model = model
        channels = model.channels
        self._lost = 1 - by_region(channels, KEPT)
        self._corners = CORNER_SHARE * (1 - ROUND_SHARE) * by_region(channels, {"corners": 1.0})
        self._round = np.flatnonzero([channel in ROUND for channel in channels])
        self._lids = Lids(model)
        gaze = model.settings.gaze
        self._gaze = np.array(
            [model.vector(w) for w in (gaze.right, gaze.left, gaze.up, gaze.down)]
        )
        self._inward = model.vector({name: 1.0 for name in INWARD if name in channels})
        self._eyes = np.flatnonzero(by_region(channels, {"eyes": 1.0}))

    def mix(self, layers: Layers) -> Vector:
        """One weight for each channel of the model."""
        mixed = np.asarray(layers.expression, float)
        blink, owned = layers.blink, layers.owned
        if layers.gesture is not None and owned is not None:
            mixed = _together(mixed * (1 - owned), layers.gesture)
            left = 1 - self._lids.owned(owned)
            blink = (left * blink[0], left * blink[1])
        mixed = mixed * (1 - layers.talking * self._lost_of(layers.viseme)) + layers.viseme
        for name, weight in layers.idle.items():
            number = self.model.index[name]
            mixed[number] += weight if owned is None else weight * (1 - owned[number])
        mixed += (1 - self._lids.shut(mixed)) * self._looks(layers)
        mixed = self._lids.blinking(mixed, blink)
        if layers.override is not None and layers.overridden is not None:
            mixed = mixed * (1 - layers.overridden) + layers.override
        return mixed.astype(np.float32)

    def _lost_of(self, viseme: Weighted) -> Weighted:
        """What expression and gesture lose of each channel to a talking mouth."""
        lost: Weighted = self._lost + np.clip(viseme[self._round].sum(), 0, 1) * self._corners
        return lost

    def gaze_left(self, owned: Weighted) -> float:
        """What a gesture leaves of the gaze: nothing when it owns the eyes."""
        return 1 - float(owned[self._eyes].max(initial=0.0))

    def _looks(self, layers: Layers) -> Weighted:
        x, y = layers.gaze.x, layers.gaze.y
        ways = np.array([max(x, 0.0), max(-x, 0.0), max(y, 0.0), max(-y, 0.0)])
        looks: Weighted = ways @ self._gaze + layers.inward * self._inward
        return looks


def _together(one: Weighted, other: Weighted) -> NDArray[np.float64]:
    """The sum, no farther out than 1 or the farther of the two: what laughs twice laughs once."""
    most = np.maximum(np.maximum(one, other), 1.0)
    least = np.minimum(np.minimum(one, other), -1.0)
    return np.asarray(np.clip(one + other, least, most), float)
