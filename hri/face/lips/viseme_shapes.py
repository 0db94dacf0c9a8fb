"""A track of visemes as weights of one face: lips, jaw and tongue, each where it is."""

from __future__ import annotations

import numpy as np

from hri.face.drawing.baking import Vector
from hri.face.lips.lipsync import ARTICULATORS, LipTrack
from hri.face.model import FaceModel
from hri.face.vocabulary import VISEMES


class VisemeShapes:
    """What a face does to make the visemes, by articulator."""

    def __init__(self, model: FaceModel) -> None:
        shapes = np.array([model.vector(model.viseme(viseme)) for viseme in VISEMES])
        articulators = np.array([articulator_of(channel) for channel in model.channels])
        self._shapes = {
            articulator: shapes * (articulators == articulator) for articulator in ARTICULATORS
        }

    def vector(self, track: LipTrack, position: float) -> Vector:
        """Weights of all channels at a position in the speech, seconds."""
        vector = np.zeros(next(iter(self._shapes.values())).shape[1], np.float32)
        for articulator, shapes in self._shapes.items():
            for viseme, weight in track.weights(position, articulator).items():
                vector += np.float32(weight) * shapes[VISEMES.index(viseme)]
        return vector


def articulator_of(channel: str) -> str:
    """What a channel belongs to when the face speaks; all but jaw and tongue goes with the lips."""
    for articulator in ("jaw", "tongue"):
        if channel.startswith(articulator):
            return articulator
    return "lips"
