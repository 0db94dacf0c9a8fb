"""QR codes: where they are, and their texts, which are read and nothing else.

A text of a stranger's paper is data: it is cut to a length, what is not printable becomes a space,
and nothing in it is opened, looked up or obeyed.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import cv2
import numpy as np

from hri.core.geometry import Matrix
from hri.core.signals import Image

LONGEST = 300
"""Characters of a text; the rest is left out."""
MOST = 8
"""Codes of a picture that are read."""
NARROW, ENLARGED = 800, 2
"""A picture of fewer pixels across is enlarged by this factor: modules of under three pixels are
read then, too."""


def codes(gray: Image) -> Iterator[tuple[str, Matrix]]:
    """The text of each code and its corners, [4, 2]: its upper left one, then clockwise, pixels."""
    scale = ENLARGED if gray.shape[1] < NARROW else 1
    gray = np.asarray(
        cv2.resize(gray, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC), np.uint8
    )
    try:
        is_any, found = _detector().detectMulti(gray)
    except cv2.error:  # some pictures have what it takes for impossible codes
        return
    if not is_any or found is None:
        return
    for corners in np.asarray(found, np.float32).reshape(-1, 4, 2)[:MOST]:
        if np.isfinite(corners).all() and (text := _text(gray, corners)):
            yield text, (corners.astype(np.float64) + 0.5) / scale


def plain(text: str) -> str:
    """A text in one line and of one length."""
    return "".join(one if one.isprintable() else " " for one in text[:LONGEST]).strip()


def _text(gray: Image, corners: Image) -> str:
    """Of a code; empty where it cannot be read as one."""
    try:
        text, _ = _detector().decode(gray, corners[None])
    except (cv2.error, UnicodeDecodeError):
        return ""
    return plain(text)


@cache
def _detector() -> cv2.QRCodeDetector:
    return cv2.QRCodeDetector()
