"""The face of any valence and arousal, blended from the expressions around that point.

Each expression stands at a point of Russell's circle of affect (`[affect]` in `face.toml`): valence
to the right, arousal up, neutral in the middle. Between them the nearest few are blended by inverse
distance with a local radius (Franke & Nielson 1980): exact at every expression, continuous
everywhere, and far-off expressions have no say. Marks such as tears (`signs`) are left out: they
belong to an expression that is meant.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel
from hri.face.vocabulary import EXPRESSIONS

UNPLACED = -0.4
"""Valence of the expressions that stand at no point: guilty, rejected, confused and the like."""
NEIGHBORS = 4
"""As many expressions are blended at most."""
CONTENT, SMILE = (0.6, -0.5), 0.35
"""Where calm and pleasure meet there is no label: valence and arousal of a slight smile, and how
much of "happy" that is."""
_NEAR = 1e-9
"""A distance, or a share, that counts as none."""


class AffectMap:
    """Expressions of one face by valence and arousal."""

    def __init__(self, model: FaceModel) -> None:
        self._places = points = {**model.settings.affect, "neutral": (0.0, 0.0)}
        self.labels = tuple(label for label in points if label in model.expressions)
        self._names = (*self.labels, "content")
        self._points = np.array(
            [*(_on_disc(*points[label]) for label in self.labels), _on_disc(*CONTENT)]
        )
        shown = np.array(
            [
                *(model.vector(model.expression(label)) for label in self.labels),
                SMILE * model.vector(model.expression("happy")),
            ]
        )
        # A half-visible sign looks like a ghost, not like half of a feeling.
        self._shown = shown * (model.vector(dict.fromkeys(model.settings.signs, 1.0)) == 0)

    def weights(self, valence: float, arousal: float) -> Vector:
        """Weights of all channels of the face for a valence and an arousal of -1 to 1.

        What lies beyond the circle counts as its rim. Raises HriError for a value that is not
        finite.
        """
        numbers, shares = self._nearest(valence, arousal)
        weights: Vector = (shares @ self._shown[numbers]).astype(np.float32)
        return weights

    def valence(self, label: str) -> float:
        """How pleasant an expression is, -1 to 1; 0 for a state such as "thinking"."""
        if label in self._places:
            return self._places[label][0]
        return UNPLACED if label in EXPRESSIONS and label != "asleep" else 0.0

    def shares(self, valence: float, arousal: float) -> dict[str, float]:
        """How much of which expression that is: labels, and "content", with shares that make 1."""
        numbers, shares = self._nearest(valence, arousal)
        return {
            self._names[n]: float(share)
            for n, share in zip(numbers, shares, strict=True)
            if share > _NEAR
        }

    def _nearest(
        self, valence: float, arousal: float
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Numbers of labels, and their shares."""
        for name, value in (("valence", valence), ("arousal", arousal)):
            if not math.isfinite(value):
                raise HriError(f"the {name} is {value} - give a number from -1 to 1")
        distances = np.hypot(*(self._points - _on_disc(valence, arousal)).T)
        order = np.argsort(distances, kind="stable")
        near, rest = order[:NEIGHBORS], order[NEIGHBORS:]
        # The first one that has no say sets the radius, so nobody comes in or drops out at once.
        radius = distances[rest[0]] if len(rest) else 2 * distances[near[-1]]
        away = np.maximum(distances[near], _NEAR)
        pull = np.maximum(1 / away - 1 / max(radius, 2 * _NEAR), 0.0) ** 2
        return near, pull / pull.sum()


def _on_disc(valence: float, arousal: float) -> tuple[float, float]:
    """The point itself, or the nearest one of the rim."""
    length = max(math.hypot(valence, arousal), 1.0)
    return valence / length, arousal / length
