"""Of thousands of descriptors, the nearest to each of a picture's, and whose they are.

Muja and Lowe, "Fast approximate nearest neighbors with automatic algorithm configuration" (2009).
The ratio test compares with the best match of another *object*: several views of one object would
otherwise veto each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.vision.objects.decoys import decoys
from hri.vision.objects.local_features import ORB, SIFT, Descriptors, rooted

NEIGHBORS = 6
"""How many are looked up: one object seldom takes all of them."""
TREES, CHECKS = 4, 24
"""Of the k-d forest of SIFT: more are slower and miss less."""
LSH = {"table_number": 8, "key_size": 14, "multi_probe_level": 1}
"""Tables of hashes for ORB, bits of a hash, and how many bits may differ."""
KD_FOREST, LSH_INDEX = 1, 6
"""Numbers of FLANN's algorithms."""
RATIO = {SIFT: 0.85, ORB: 0.85}
"""A match counts when the best of another object is farther by this factor."""
FARTHEST = {SIFT: 0.5, ORB: 64}
"""The largest distance of a match: of two vectors of length 1, or differing bits of 256."""
NOBODY = -1
"""Owner of the decoys."""
SEED = 20_040_101
"""Of the trees: the same set gives the same index."""

Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Matches:
    """Features of a picture, each with the feature of an object that is like it."""

    queries: Indices
    """Their numbers in the picture."""
    entries: Indices
    """The numbers of the features in the index."""


class DescriptorIndex:
    """The descriptors of many objects, and for each of them its owner."""

    def __init__(self, method: str, descriptors: Sequence[Descriptors], owners: Sequence[int]):
        """`owners[i]` is the number of the object that all of `descriptors[i]` belong to."""
        self._method = method
        parts = [*descriptors, decoys(method)]
        self._all = self._compared(np.concatenate(parts))
        self._owners = np.repeat([*owners, NOBODY], [len(part) for part in parts])
        cv2.setRNGSeed(SEED)
        self._index: Any = cv2.flann.Index(self._all, _parameters(method))

    @property
    def size(self) -> int:
        """Bytes of the descriptors."""
        return int(self._all.nbytes)

    def _compared(self, descriptors: Descriptors) -> NDArray[Any]:
        return rooted(descriptors) if self._method == SIFT else descriptors

    def match(self, descriptors: Descriptors) -> Matches:
        """Those of a picture that are like one of an object, and clearly less like any other's."""
        if not len(descriptors):
            return Matches(np.zeros(0, np.intp), np.zeros(0, np.intp))
        count = min(NEIGHBORS, len(self._all))
        found, distances = self._index.knnSearch(
            self._compared(descriptors), count, params={"checks": CHECKS}
        )
        is_valid = found >= 0
        distances = np.where(is_valid, distances, np.inf).astype(np.float64)
        if self._method == SIFT:
            distances = np.sqrt(distances)
        owners = np.where(is_valid, self._owners[found], NOBODY)
        others = np.where(owners != owners[:, :1], distances, np.inf).min(axis=1)
        nearest = distances[:, 0]
        good = owners[:, 0] != NOBODY
        good &= (nearest < RATIO[self._method] * others) & (nearest <= FARTHEST[self._method])
        queries = np.flatnonzero(good)
        return Matches(queries, found[queries, 0].astype(np.intp))


def _parameters(method: str) -> dict[str, bool | int | float | str]:
    if method == ORB:
        return {"algorithm": LSH_INDEX, **LSH}
    return {"algorithm": KD_FOREST, "trees": TREES}
