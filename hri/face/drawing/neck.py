"""What of a drawing moves with the head: all above the neck, nothing below it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from hri.face.drawing.baking import DisplayList, Item, Opening, Shape, Vector


def following(display: DisplayList, top: float, bottom: float) -> Vector:
    """How much each point [n] goes with the head, 0 to 1, by its height in the drawing at rest.

    `top` and `bottom` are the heights between which that falls from 1 to 0, smoothly. Anchors of a
    gradient count as within the height of their shape, so that light stays where it is drawn.
    """
    heights = display.neutral[1 : 2 * display.points : 2].copy()
    for shape in _shapes(display.items):
        first, last = shape.contours[0][0], shape.anchors[0]
        outline = heights[first:last]
        anchors = heights[last : shape.anchors[1]]
        np.clip(anchors, outline.min(), outline.max(), out=anchors)
    share = np.clip((bottom - heights) / (bottom - top), 0, 1)
    return np.asarray(share * share * (3 - 2 * share), np.float32)


def _shapes(items: Sequence[Item]) -> Iterator[Shape]:
    for item in items:
        if isinstance(item, Opening):
            yield item.clip
            yield from _shapes(item.content)
        else:
            yield item
