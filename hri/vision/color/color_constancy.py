"""Color constancy: the color of things, whatever light they are in.

The light of a picture is estimated from the picture: its brightness from the brightest pixels, its
tint from a Minkowski mean of the pixels that are not colorful ("shades of gray": Finlayson and
Trezzi, "Shades of gray and colour constancy", 2004). Each channel is scaled by it (von Kries), and
then the chroma of each pixel by how bright that pixel is, so that neither a lamp nor a shadow
changes it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

NORM = 6
"""Of the Minkowski mean, as Finlayson and Trezzi found best."""
BELIEVED = 0.85
"""Part of a tint that is taken for the light's; the rest may be that of the room."""
STRONGEST = 1.5
"""Times, by which a tint changes a channel at most."""
COLORFUL = 0.65
"""Saturation, 0 to 1, from which a pixel shows the color of a thing, not that of the light ..."""
ENOUGH = 0.3
"""... and part of the picture that must be less: with fewer pixels less of the tint is believed."""
BRIGHTEST = 0.98
"""Part of the pixels that are at most as bright as what the light is measured by."""
CLIPPED = 250
"""Level from which a channel may have been brighter than a camera can tell."""
STANDARD = 230.0
"""Level of the brightest in the light that all pictures are brought to."""
STRETCHED = 6.0
"""Times, by which a dim picture becomes brighter at most."""
DARKEST, DIMMEST = 10.0, 23.0
"""Levels below which a pixel has no color that could be recognized: of the camera, whose noise is
some 3, and of standard light."""
SOFTENED = 16
"""Levels that are added to the brightness before chroma is divided by it: the darker a pixel, the
grayer it is taken for, since its chroma is noise."""
SAMPLED = 80
"""Columns of a picture that its light is measured in, about."""

Plane = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Chromaticity:
    """A picture without its light."""

    chroma: NDArray[np.uint8]
    """Shape [height, width, 2]: Cr and Cb that each pixel has when it is as bright as can be."""
    brightness: Plane
    """Shape [height, width]: the brightest channel in standard light; 0 where it is too dark to
    have a color."""


def chromaticity(image: Image) -> Chromaticity:
    """The color of each pixel of a picture (uint8, [height, width, 3], RGB) in standard light."""
    planes = cv2.split(image)
    gains, stretch = light_gains(planes)
    lit = [cv2.convertScaleAbs(one, alpha=gain) for one, gain in zip(planes, gains, strict=True)]
    brightness = cv2.max(cv2.max(lit[0], lit[1]), lit[2])
    _, red, blue = cv2.split(cv2.cvtColor(cv2.merge(lit), cv2.COLOR_RGB2YCrCb))
    divisor = brightness + np.int16(SOFTENED)
    chroma = cv2.merge([_scaled(red, divisor), _scaled(blue, divisor)])
    _, brightness = cv2.threshold(brightness, max(DIMMEST, DARKEST * stretch), 0, cv2.THRESH_TOZERO)
    return Chromaticity(np.asarray(chroma, np.uint8), np.asarray(brightness, np.uint8))


def _scaled(plane: Any, divisor: Any) -> Any:
    """Cr or Cb of pixels that are made as bright as can be."""
    scaled = cv2.divide(plane - np.int16(128), divisor, scale=255, dtype=cv2.CV_16S)
    return (scaled + np.int16(128)).astype(np.uint8)


def light_gains(planes: Any) -> tuple[NDArray[np.float64], float]:
    """By what to multiply red, green and blue for standard light, and how much brighter it is."""
    step = max(1, planes[0].shape[1] // SAMPLED)
    few = [np.ascontiguousarray(plane[::step, ::step]) for plane in planes]
    high, low = cv2.max(cv2.max(*few[:2]), few[2]), cv2.min(cv2.min(*few[:2]), few[2])
    counts = _counts(high, None).cumsum()
    brightest = float(np.searchsorted(counts, BRIGHTEST * counts[-1]))
    stretch = float(np.clip(STANDARD / max(1.0, brightest), 1.0, STRETCHED))
    is_gray = ((low >= (1 - COLORFUL) * high) & (high < CLIPPED)).view(np.uint8)
    share = np.count_nonzero(is_gray) / is_gray.size
    if share == 0:
        return np.full(3, stretch), stretch
    light = np.array([_minkowski(_counts(plane, is_gray)) for plane in few])
    tint = (light.mean() / light) ** (BELIEVED * min(1.0, share / ENOUGH))
    return stretch * np.clip(tint, 1 / STRONGEST, STRONGEST), stretch


def _counts(plane: Any, mask: Any) -> NDArray[np.float32]:
    """How many pixels have each level."""
    return np.asarray(cv2.calcHist([plane], [0], mask, [256], [0, 256]), np.float32).ravel()


_POWERS = (np.arange(256) / 255) ** NORM


def _minkowski(counts: NDArray[np.float32]) -> float:
    return float(255 * (_POWERS @ counts / counts.sum()) ** (1 / NORM)) + 1.0
