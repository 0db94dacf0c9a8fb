"""Who owns which part of the face: expression, speech, blink and gaze become one set of weights.

Speech owns the mouth; of the expression the brows, eyes and cheeks stay, and about half of the
corners. A blink shuts the lids from wherever they are. Shut eyes do not follow the gaze.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from hri.core.signals import Gaze
from hri.face.baking import Vector
from hri.face.model import FaceModel

MOUTH = ("mouth", "jaw", "tongue", "cheekPuff")
CORNERS = ("mouthSmile", "mouthFrown", "mouthDimple")
LIDS = ("eyeBlink", "eyeWide", "eyeSquint", "eyeDroop", "cheekSquint", "browDown", "eyeLookUp")
"""Beginnings of the names of channels."""
CORNER_SHARE = 0.5
"""What the expression keeps of the corners of a talking mouth."""


@dataclass(frozen=True)
class Layers:
    """What each layer asks for."""

    expression: Vector
    viseme: Vector
    talking: float = 0.0
    """How much speech owns the mouth, 0 to 1."""
    blink: float = 0.0
    """How far the lids are shut, 0 to 1."""
    gaze: Gaze = field(default_factory=Gaze)
    idle: Mapping[str, float] = field(default_factory=dict)
    """Weights of motions and pupils, added as they are."""


class Mixer:
    """Mixes layers for one face."""

    def __init__(self, model: FaceModel) -> None:
        self.model = model
        self._share = np.array([_share_of(channel) for channel in model.channels])
        self._lids = np.array([channel.startswith(LIDS) for channel in model.channels], float)
        self._shut = np.array([name.startswith("eyeBlink") for name in model.channels])
        self._blink = model.vector(model.settings.blink.weights)
        gaze = model.settings.gaze
        self._gaze = [model.vector(way) for way in (gaze.right, gaze.left, gaze.up, gaze.down)]

    def mix(self, layers: Layers) -> Vector:
        """One weight for each channel of the model."""
        kept = 1 - layers.talking * (1 - self._share)
        mixed = layers.expression * kept + layers.viseme
        mixed = mixed + self.model.vector(layers.idle)
        x, y = layers.gaze.x, layers.gaze.y
        shares = (max(x, 0.0), max(-x, 0.0), max(y, 0.0), max(-y, 0.0))
        shut = float(mixed[self._shut].mean()) if self._shut.any() else 0.0
        open_share = min(max(1 - shut, 0.0), 1.0)
        for share, way in zip(shares, self._gaze, strict=True):
            mixed = mixed + share * open_share * way
        mixed = mixed * (1 - layers.blink * self._lids) + layers.blink * self._blink
        return mixed.astype(np.float32)


def _share_of(channel: str) -> float:
    """What an expression keeps of a channel while the face talks."""
    if channel.startswith(CORNERS):
        return CORNER_SHARE
    return 0.0 if channel.startswith(MOUTH) else 1.0
