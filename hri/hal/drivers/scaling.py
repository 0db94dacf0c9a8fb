"""Pictures in another size, by OpenCV."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image


def by_area(image: Image, columns: int, rows: int) -> NDArray[np.uint8]:
    """The picture in another size; a pixel is the mean of those that lie under it."""
    return np.asarray(cv2.resize(image, (columns, rows), interpolation=cv2.INTER_AREA), np.uint8)
