"""Anchors: where the proposals of MediaPipe's detectors lie, of which each says what is around it.

MediaPipe's SsdAnchorsCalculator with fixed sizes, as the graphs of faces and of palms use it.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray


def ssd_anchors(grids: Iterable[tuple[int, int]]) -> NDArray[np.float32]:
    """The middle of the cell of each proposal, shape [n, 2], 0 to 1.

    `grids` are pairs of cells along a side and proposals for each cell.
    """
    middles = [
        ((x + 0.5) / cells, (y + 0.5) / cells)
        for cells, proposals in grids
        for y in range(cells)
        for x in range(cells)
        for _ in range(proposals)
    ]
    return np.array(middles, np.float32)
