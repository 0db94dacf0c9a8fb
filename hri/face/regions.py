"""The regions of a face: which channels are brows, lids, eyes, cheeks, mouth, corners and head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

REGIONS: Mapping[str, tuple[str, ...]] = {
    "brows": ("brow",),
    "lids": ("eyeBlink", "eyeWide", "eyeSquint", "eyeDroop"),
    "eyes": ("eyeLook", "pupil"),
    "corners": ("mouthSmile", "mouthFrown", "mouthDimple"),
    "mouth": ("mouth", "jaw", "tongue", "cheekPuff"),
    "cheeks": ("cheek", "nose", "blush", "tear"),
    "head": ("head",),
}
"""Beginnings of the names of channels, by region; the first that fits counts."""

OTHER = "other"
"""The region of what a face has beside: antennas, ears, hair."""
NAMES = (*REGIONS, OTHER)


def region_of(channel: str) -> str:
    """The region a channel belongs to."""
    for region, beginnings in REGIONS.items():
        if channel.startswith(beginnings):
            return region
    return OTHER


def by_region(channels: Sequence[str], values: Mapping[str, float]) -> NDArray[np.float64]:
    """One number for each channel: that of its region, 0 for regions that are not named."""
    return np.array([values.get(region_of(channel), 0.0) for channel in channels])
