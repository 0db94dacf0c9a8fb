"""Blobs of learned colors in a picture: a table gives a mask, and its connected parts are blobs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import ColorBlob, Image
from hri.vision.color.blob_confidence import BRIGHTNESS, SHARE, ramp, set_apart
from hri.vision.color.color_constancy import Chromaticity, chromaticity
from hri.vision.color.color_mixture import ColorTable, ratio_table
from hri.vision.color.color_model import load_color

WIDEST = 320
"""Pixels; a wider picture is shrunk."""
LEAST = 0.001
"""Share of the picture below which a blob is noise."""
MOST = 50
"""Blobs of a color in a picture, the largest."""
LIKELY = 2.0
"""Log-likelihood ratio from which a pixel has the color ..."""
SURE = 3.0
"""... and at which its mean chroma makes a blob as likely a thing of this color as not."""
FOLLOWED = 0.1
"""Part of the way by which a table follows a change of light with each picture ..."""
FARTHEST = 12.0
"""... up to this many levels of chroma from where the color was learned."""
MARGIN = math.ceil(FARTHEST)

Contour = Any
Labels = NDArray[np.uint8]
"""The number of a color from 1, 0 for none."""


class ColorSegmenter:
    """Finds the blobs of colors, picture by picture, and follows slow changes of the light."""

    def __init__(self, tables: Mapping[str, ColorTable]) -> None:
        """`tables` are those of `ratio_table`, by the name of the color."""
        self._names: list[str] = []
        self._tables: list[ColorTable] = []
        self._wide: list[NDArray[np.float32]] = []
        """The ratios with a margin, in which they move with the light."""
        self._light: list[NDArray[np.float64]] = []
        """By color, how far its chroma has moved."""
        self._shifts: list[tuple[int, ...]] = []
        self._labels: Labels = np.zeros(65536, np.uint8)
        for name, table in tables.items():
            self.learn(name, table)

    def learn(self, name: str, table: ColorTable) -> None:
        """Look for one more color, or for one from now on in the light of now."""
        if name not in self._names:
            self._names.append(name)
            self._tables.append(table)
            self._wide.append(table.ratios)
            self._light.append(np.zeros(2))
        number = self._names.index(name)
        self._tables[number] = table
        self._wide[number] = np.pad(table.ratios, MARGIN, mode="edge")
        self._light[number] = np.zeros(2)
        self._shifts = []

    @property
    def light(self) -> dict[str, tuple[float, float]]:
        """By color, by how many levels of Cr and Cb it has moved with the light."""
        shifts = ((float(cr), float(cb)) for cr, cb in self._light)
        return dict(zip(self._names, shifts, strict=True))

    def segment(self, image: Image) -> tuple[ColorBlob, ...]:
        """The blobs of all colors (image: uint8, [height, width, 3], RGB), the largest first.

        A pixel has the one color that fits it best.
        """
        height, width = image.shape[:2]
        if not self._names or not height or not width:
            return ()
        small = _shrunk(image, min(1.0, WIDEST / width))
        scale = width / small.shape[1]
        seen = chromaticity(small)
        self._prepare()
        which = self._labels.take(seen.chroma.view("<u2")[..., 0])
        which *= seen.brightness > 0
        found: list[ColorBlob] = []
        for number, name in enumerate(self._names):
            mask = (which == number + 1).view(np.uint8)
            blobs = [
                _blob(name, part, count, scale, self._confidence(number, part, count, seen, mask))
                for count, part in _parts(mask, max(LEAST * mask.size, 1.0))
            ]
            self._follow(number, seen.chroma, mask if blobs else None)
            found += blobs
        return tuple(sorted(found, key=lambda blob: (-blob.area, blob.name, blob.x, blob.y)))

    def _prepare(self) -> None:
        """Make the labels again when the light has changed by a level."""
        shifts = [tuple(np.rint(light).astype(int).tolist()) for light in self._light]
        if shifts == self._shifts:
            return
        self._shifts = shifts
        best = np.full((256, 256), LIKELY, np.float32)
        labels = np.zeros((256, 256), np.uint8)
        for number, (ratios, (cr, cb)) in enumerate(zip(self._wide, shifts, strict=True)):
            moved = ratios[MARGIN - cr : MARGIN - cr + 256, MARGIN - cb : MARGIN - cb + 256]
            is_better = moved > best
            np.copyto(best, moved, where=is_better)
            np.copyto(labels, np.uint8(number + 1), where=is_better)
        self._labels = labels.T.ravel()

    def _confidence(
        self, number: int, part: Contour, pixels: float, seen: Chromaticity, mask: Labels
    ) -> float:
        """How likely a part of the mask is of this color, and is the thing that has it, 0 to 1."""
        left, top, width, height = cv2.boundingRect(part)
        box = slice(top, top + height), slice(left, left + width)
        red, blue = cv2.mean(seen.chroma[box], mask[box])[:2]
        ratios = [
            float(table.ratios[_level(red - shift[0]), _level(blue - shift[1])])
            for table, shift in zip(self._tables, self._shifts, strict=True)
        ]
        learned = self._tables[number].brightness
        known = [SURE if learned else 0.0, *ratios]
        sure = math.exp(ratios[number] - max(known))
        sure /= sum(math.exp(ratio - max(known)) for ratio in known)
        if not learned:
            return sure
        sure *= ramp(cv2.mean(seen.brightness[box], mask[box])[0] / learned, BRIGHTNESS)
        sure *= ramp(pixels / cv2.countNonZero(mask), SHARE)
        return sure * set_apart(part, pixels, seen.chroma, (red, blue))

    def _follow(self, number: int, chroma: NDArray[np.uint8], mask: Labels | None) -> None:
        """Move with the chroma of what has the color, within bounds; back where nothing has."""
        aim = np.zeros(2)
        if mask is not None:
            aim = np.array(cv2.mean(chroma, mask)[:2]) - self._tables[number].center
        light = self._light[number]
        light += FOLLOWED * (np.minimum(np.maximum(aim, -FARTHEST), FARTHEST) - light)


def tables_of(files: Iterable[Path]) -> dict[str, ColorTable]:
    """The tables of learned colors by their names. Raises HriError."""
    models = [load_color(file) for file in files]
    return {
        model.name: ratio_table(model.color, model.background, model.brightness) for model in models
    }


def _level(value: float) -> int:
    return min(255, max(0, int(value)))


def _shrunk(image: Image, scale: float) -> Image:
    if scale == 1.0:
        return image
    size = max(1, round(image.shape[1] * scale)), max(1, round(image.shape[0] * scale))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)


def _parts(mask: Labels, least: float) -> list[tuple[float, Contour]]:
    """The largest connected parts: how many pixels they have, and their outlines."""
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    sizes = [(_pixels(contour), contour) for contour in contours]
    return sorted((one for one in sizes if one[0] >= least), key=lambda one: -one[0])[:MOST]


def _pixels(contour: Contour) -> float:
    """How many pixels a contour holds, by Pick's theorem: it goes through their centers."""
    return cv2.contourArea(contour) + cv2.arcLength(contour, True) / 2 + 1


def _blob(name: str, contour: Contour, pixels: float, scale: float, confidence: float) -> ColorBlob:
    """In pixels of the whole picture; `scale` is how many of them make one of the mask."""
    left, top, width, height = cv2.boundingRect(contour)
    moments = cv2.moments(contour)
    x, y = left + (width - 1) / 2, top + (height - 1) / 2
    if moments["m00"] > 0:
        x, y = moments["m10"] / moments["m00"], moments["m01"] / moments["m00"]
    corners = cv2.approxPolyDP(contour, 1.0, True).reshape(-1, 2) * scale
    return ColorBlob(
        name=name,
        x=(x + 0.5) * scale - 0.5,
        y=(y + 0.5) * scale - 0.5,
        width=width * scale,
        height=height * scale,
        area=pixels * scale**2,
        outline=tuple((float(a), float(b)) for a, b in corners.tolist()),
        confidence=confidence,
    )
