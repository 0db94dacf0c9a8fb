"""The way OpenCV's tutorial recognizes an object, as a peer of the recognizer.

SIFT, nearest neighbors by FLANN, the ratio test, and a homography with at least ten inliers.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from benchmarks.vision.stamps import Stamp
from hri.core.signals import Image

RATIO = 0.75
INLIERS = 10


class PlainMatching:
    """Names the object of a picture."""

    def __init__(self, stamps: Sequence[Stamp]) -> None:
        self._sift = cv2.SIFT.create(1000)
        self._matcher = cv2.FlannBasedMatcher({"algorithm": 1, "trees": 4}, {"checks": 32})
        self._names = [stamp.name for stamp in stamps]
        found = [self._sift.detectAndCompute(stamp.picture, stamp.mask) for stamp in stamps]
        self._points = [points for points, _ in found]
        self._matcher.add([described for _, described in found])
        self._matcher.train()

    def recognize(self, image: Image) -> str:
        """The name of the object with the most inliers; empty when none has enough."""
        points, described = self._sift.detectAndCompute(image, None)
        pairs = self._matcher.knnMatch(described, k=2)
        good = [
            pair[0]
            for pair in pairs
            if len(pair) == 2 and pair[0].distance < RATIO * pair[1].distance
        ]
        best, most = "", INLIERS - 1
        for number, name in enumerate(self._names):
            matches = [match for match in good if match.imgIdx == number]
            if len(matches) <= most:
                continue
            known = np.array([self._points[number][match.trainIdx].pt for match in matches])
            there = np.array([points[match.queryIdx].pt for match in matches])
            _, agreeing = cv2.findHomography(known, there, cv2.RANSAC, 5.0)
            if agreeing is not None and agreeing.sum() > most:
                best, most = name, int(agreeing.sum())
        return best
