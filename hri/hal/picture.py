"""Whatever array a source of pictures gives, as the picture that all others expect."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

LARGEST_SIDE = 8192
"""Pixels; a larger picture is refused before it can fill the memory."""
MOST_PIXELS = 7680 * 4320
"""Of a picture in a file, which is in the memory three times while it is decoded."""
TURNS = {"0": 0, "90": -1, "180": 2, "270": 1}
"""Quarter turns, counter-clockwise, for degrees clockwise."""


def as_picture(array: NDArray[Any]) -> Image:
    """The array as uint8 [height, width, 3], RGB; the same object where it is that already.

    Taken are one channel (gray), three, and four (the last is left out), of 8 or 16 bits. Raises
    ValueError, with the reason, for anything else, for no pixel and for more than 8192 a side.
    """
    if not isinstance(array, np.ndarray) or array.ndim not in (2, 3):
        raise ValueError(f"no picture but {_kind(array)}")
    height, width = array.shape[:2]
    if not 0 < height <= LARGEST_SIDE or not 0 < width <= LARGEST_SIDE:
        raise ValueError(f"a picture of {width} x {height} pixels")
    if array.dtype == np.uint16:
        array = (array >> 8).astype(np.uint8)
    if array.dtype != np.uint8:
        raise ValueError(f"pixels of the kind {array.dtype}, not of 8 or 16 bits")
    if array.ndim == 2 or array.shape[2] == 1:
        return np.ascontiguousarray(
            np.broadcast_to(array.reshape(height, width, 1), (height, width, 3))
        )
    if array.shape[2] not in (3, 4):
        raise ValueError(f"a picture of {array.shape[2]} channels")
    return np.ascontiguousarray(array[:, :, :3])


def oriented(image: Image, turn: str, is_mirrored: bool) -> Image:
    """The picture turned by "0", "90", "180" or "270" degrees clockwise, then mirrored back."""
    if turn != "0":
        image = np.rot90(image, TURNS[turn])
    if is_mirrored:
        image = image[:, ::-1]
    return np.ascontiguousarray(image)


def _kind(thing: object) -> str:
    if isinstance(thing, np.ndarray):
        return f"an array of {thing.ndim} dimensions"
    return f"a {type(thing).__name__}"


Resize = Callable[[Image, int, int], NDArray[np.uint8]]
"""Resizes a picture to a number of columns and rows."""


def nearest(image: Image, columns: int, rows: int) -> NDArray[np.uint8]:
    """The picture in another size; each pixel is the nearest one of before."""
    across = np.arange(columns) * image.shape[1] // columns
    return image[np.ix_(np.arange(rows) * image.shape[0] // rows, across)]


def fitted(image: Image, width: int, height: int, resize: Resize = nearest) -> Image:
    """A picture scaled to fit into another size, with black bars where the shapes differ."""
    if image.shape[:2] == (height, width):
        return image
    scale = min(height / image.shape[0], width / image.shape[1])
    rows, columns = (max(1, round(size * scale)) for size in image.shape[:2])
    canvas: Image = np.zeros((height, width, 3), np.uint8)
    top, left = (height - rows) // 2, (width - columns) // 2
    canvas[top : top + rows, left : left + columns] = resize(image, columns, rows)
    return canvas
