"""Pictures of things for the benches: the stamps of Tux Paint, cut out on transparent ground.

Debian and its kin have them as the package `tuxpaint-stamps-default`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from hri.core.errors import NotAvailable
from hri.core.signals import Image
from hri.vision.objects.cutout import opaque, whole
from hri.vision.objects.object_model import Outline

FOLDER = Path("/usr/share/tuxpaint/stamps")
SIDE = 360
"""Pixels, the longer side of a thing."""
SHOWN = 0.4
"""How large the benches show a thing, of `SIDE`."""
TEXTURED = 40
"""Features of SIFT, as OpenCV sets it, that a textured thing has at that size."""
SOLID = 0.5
"""Of its convex hull: through less than that one sees what is behind it."""
SMALLEST = 48
"""Pixels, the shorter side of a thing in its file."""
ALIKE = ("_mirror", "money", "dreydl", "pig_golden2")
"""In the names of files that show nearly the same as another: nobody could tell them apart."""
SEED = 11


@dataclass(frozen=True, slots=True, eq=False)
class Stamp:
    """A flat thing."""

    name: str
    picture: Image
    """Uint8, [height, width, 3], RGB."""
    mask: Image
    """Uint8, [height, width]: 255 where the thing is."""

    @property
    def outline(self) -> Outline:
        """As the robot cuts it out."""
        outline = opaque(self.picture, self.mask)
        return whole(self.picture) if outline is None else outline


def read_stamps() -> tuple[list[Stamp], list[Stamp]]:
    """Those that are textured, and the others, in an order of chance that stays the same.

    Raises NotAvailable where the package is not installed.
    """
    paths = sorted(FOLDER.rglob("*.png"))
    if not paths:
        raise NotAvailable(f"no pictures in {FOLDER} - apt install tuxpaint-stamps-default")
    distinct = (path for path in paths if not any(word in path.as_posix() for word in ALIKE))
    found = [stamp for path in distinct if (stamp := _read(path)) is not None]
    # Some lie in two folders.
    stamps = list({stamp.picture.tobytes(): stamp for stamp in found}.values())
    stamps = [stamps[index] for index in np.random.default_rng(SEED).permutation(len(stamps))]
    sift = cv2.SIFT.create()
    textured = [stamp for stamp in stamps if _is_textured(stamp, sift)]
    return textured, [stamp for stamp in stamps if stamp not in textured]


def is_solid(stamp: Stamp) -> bool:
    """Whether one hardly sees through it."""
    points = cv2.findNonZero((stamp.mask > 127).astype(np.uint8))
    return len(points) >= SOLID * cv2.contourArea(cv2.convexHull(points))


def _is_textured(stamp: Stamp, sift: Any) -> bool:
    picture, mask = (
        cv2.resize(each, None, fx=SHOWN, fy=SHOWN, interpolation=cv2.INTER_AREA)
        for each in (stamp.picture, stamp.mask)
    )
    return is_solid(stamp) and len(sift.detect(picture, mask)) >= TEXTURED


def _read(path: Path) -> Stamp | None:
    """None for a picture without a transparent ground, or of a few pixels."""
    read = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if read is None or read.ndim != 3 or read.shape[2] != 4:
        return None
    left, top, width, height = cv2.boundingRect((read[..., 3] > 127).astype(np.uint8))
    if min(width, height) < SMALLEST:
        return None
    scale = SIDE / max(width, height)
    how = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    cut = read[top : top + height, left : left + width]
    cut = np.asarray(cv2.resize(cut, None, fx=scale, fy=scale, interpolation=how), np.uint8)
    mask = np.array(cut[..., 3], np.uint8)
    opaque = np.array(cut[..., 2::-1], np.uint8)
    opaque[mask <= 127] = 127
    return Stamp(path.relative_to(FOLDER).with_suffix("").as_posix(), opaque, mask)


def generated(number: int, dice: np.random.Generator) -> Stamp:
    """A card with shapes of all sizes and a number, where there are not enough pictures."""
    card = np.full((SIDE, SIDE, 3), dice.integers(0, 256, 3), np.uint8)
    for _ in range(60):
        center, color = dice.integers(0, SIDE, 2), [int(part) for part in dice.integers(0, 256, 3)]
        corners = center + dice.normal(0, min(90.0, 6 / dice.uniform(0.05, 1)), (5, 2))
        cv2.fillPoly(card, [cv2.convexHull(corners.astype(np.int32))], color, cv2.LINE_AA)
    cv2.putText(card, f"{number}", (30, 200), cv2.FONT_HERSHEY_DUPLEX, 3, (255, 255, 255), 5)
    soft = np.asarray(cv2.GaussianBlur(card, (0, 0), 0.8), np.uint8)
    whole: Image = np.full((SIDE, SIDE), 255, np.uint8)
    return Stamp(f"card {number}", soft, whole)
