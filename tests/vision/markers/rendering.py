"""Markers as a camera sees them, for tests; the pictures behind them are made up."""

import cv2
import numpy as np

from benchmarks.vision.marker_scenes import SIZE


def ground(seed=0):
    """A picture without markers: soft shapes, lines and noise."""
    draw = np.random.default_rng(seed)
    small = draw.integers(40, 216, (9, 12, 3)).astype(np.uint8)
    picture = cv2.resize(small, SIZE, interpolation=cv2.INTER_CUBIC)
    for _ in range(30):
        start, end = (tuple(int(v) for v in draw.integers(0, SIZE)) for _ in range(2))
        color = tuple(int(v) for v in draw.integers(0, 256, 3))
        cv2.rectangle(picture, start, end, color, int(draw.integers(1, 5)))
    return picture
