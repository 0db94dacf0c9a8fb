"""The color of skin, learned from the faces that are seen now, in the light of now.

No skin is assumed: neither light nor dark. What is around the faces is the background.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hri.core.signals import FaceBox, Image
from hri.vision.color.color_constancy import chromaticity
from hri.vision.color.color_mixture import ColorTable, Samples, fit, ratio_table

SKIN = "skin"
"""The name of its blobs."""
CHEEKS = 0.5
"""Part of a face's box, in each direction, that is skin: no hair, no background."""
AROUND = 0.3
"""Of its size, by which a face may reach out of its box, and is not background there."""
MOST = 4000
"""Pixels of each kind."""
COMPONENTS, BEHIND = 1, 4


def skin_samples(image: Image, faces: Iterable[FaceBox]) -> tuple[Samples, Samples]:
    """The chroma of faces and that of the rest of a picture, in standard light, [n, 2] each."""
    height, width = image.shape[:2]
    inside, outside = np.zeros((height, width), bool), np.ones((height, width), bool)
    for face in faces:
        inside[_part(face, CHEEKS, image)] = True
        outside[_part(face, 1 + 2 * AROUND, image)] = False
    seen = chromaticity(image)
    pixels, has_light = seen.chroma.astype(float), seen.brightness > 0
    return _some(pixels[inside & has_light]), _some(pixels[outside & has_light])


def skin_table(skin: Samples, background: Samples) -> ColorTable:
    """How much likelier each chroma is in skin. Raises HriError for too few pixels."""
    return ratio_table(fit(skin, COMPONENTS), fit(background, BEHIND))


def _part(face: FaceBox, share: float, image: Image) -> tuple[slice, slice]:
    """The middle of a face's box, as rows and columns of the picture."""
    x, y = face.x + face.width / 2, face.y + face.height / 2
    half = face.width * share / 2, face.height * share / 2
    rows = slice(max(0, int(y - half[1])), max(0, int(y + half[1])))
    return rows, slice(max(0, int(x - half[0])), max(0, int(x + half[0])))


def _some(pixels: Samples) -> Samples:
    """Evenly spread, and not more than needed."""
    return pixels[:: max(1, len(pixels) // MOST)]
