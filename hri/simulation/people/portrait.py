"""The face of a simulated person: its relief, and the skin drawn on it.

Lengths are in half heads: chin to crown is 2, x to the right of the picture, y down, z toward the
camera, the origin in the middle of the face. Where eyes, nose, mouth and chin lie and how far they
stand out follows the mean face that the face mesh was fitted to (MediaPipe's canonical face: 89 mm
between the outer corners of the eyes, which lie 43 mm behind the tip of the nose), so that a mesh
fitted to the picture turns as far as the head does.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from hri.simulation.people.appearance import Looks
from hri.simulation.people.soft_edges import Color, Field, Point, filled, paint

FACE = np.array([0.69, 1.04, 0.88], np.float32)
"""Half axes of the ellipsoid under the relief of the face."""
FACE_CENTER = np.array([0.0, 0.0, -0.12], np.float32)

DENSITY = 96
"""Points of the face's skin to a half head."""
REACH = 1.15
"""Half heads from the middle of the skin to its edge."""
STATES = 6
"""Steps between a shut and an open mouth, and of all else that the face does."""

EYE = (0.266, 0.05)
"""Middle of the left eye on the picture's right."""
MOUTH = 0.60
"""Height of the mouth."""
CHIN_DROP = 0.09
"""How far the chin goes down with an open mouth."""

EYES_PART = slice(int((REACH - 0.42) * DENSITY), int((REACH + 0.26) * DENSITY))
MOUTH_PART = slice(int((REACH + 0.36) * DENSITY), int((REACH + 0.98) * DENSITY))
"""Rows of the skin that brows and eyes, and the mouth, take."""


@dataclass(frozen=True, slots=True)
class Mien:
    """What a face does, in whole steps: mouth, lids and smile from 0 to STATES, brows from minus
    that."""

    mouth: int = 0
    lids: int = STATES
    smile: int = 0
    brows: int = 0

    @classmethod
    def of(cls, mouth: float, lids: float, smile: float, brows: float) -> Mien:
        """From parts: 0 to 1, brows from -1."""
        return cls(_step(mouth, 0), _step(lids, 0), _step(smile, 0), _step(brows, -1))


def _step(part: float, least: float) -> int:
    return round(min(1.0, max(least, part)) * STATES)


def column(length: Field) -> Field:
    """Where a coordinate of the head lies on the skin, in its points."""
    return (length + REACH) * DENSITY


@lru_cache(maxsize=1)
def _plane() -> tuple[Field, Field]:
    line = np.arange(-REACH, REACH, 1 / DENSITY, dtype=np.float32)
    x, y = np.meshgrid(line, line)
    return x, y


def _bump(x: float, y: float, width: float, height: float) -> Field:
    """A soft hill of height 1 at (x, y) and at its mirror image."""
    px, py = _plane()
    hill: Field = np.exp(-(((np.abs(px) - x) / width) ** 2) - ((py - y) / height) ** 2)
    return hill


def _half_width(looks: Looks) -> Field:
    """Of the face at each height: wide at the cheeks and narrow at the chin."""
    jaw = np.clip((_plane()[1] - 0.15) / 0.85, 0, 1)
    half: Field = FACE[0] - (0.69 - 0.45 * looks.jaw) * jaw**1.8
    return half


def _within_face(looks: Looks) -> Field:
    """1 in the middle of the face, 0 at its edge."""
    x, y = _plane()
    edge = np.where(y > 0, 3.2, 2.6)
    within: Field = 1 - np.abs(x / _half_width(looks)) ** 2.4 - np.abs(y / FACE[1]) ** edge
    return within


HILLS = (
    (0.0, 0.20, 0.075, 0.17, 0.15),  # bridge of the nose
    (0.0, 0.36, 0.10, 0.10, 0.26),  # its tip
    (0.10, 0.40, 0.05, 0.05, 0.07),  # its wings
    (0.25, -0.14, 0.22, 0.08, 0.115),  # brows
    (0.28, 0.06, 0.14, 0.09, -0.1),  # eye sockets
    (0.40, 0.30, 0.20, 0.16, 0.05),  # cheeks
    (0.0, 0.60, 0.16, 0.10, 0.09),  # lips
    (0.0, 0.76, 0.16, 0.05, -0.03),  # below the lips
    (0.0, 0.92, 0.20, 0.10, 0.09),  # chin
)
"""Hills and hollows of the relief: x, y, width, height, how high; the first three are the nose."""
NOSE, BROW = range(3), 3


@lru_cache(maxsize=16)
def relief(looks: Looks) -> tuple[Field, Field]:
    """How far the face stands out at each point, and its normals."""
    x, y = _plane()
    # Chin and jaw stand out as far as the mouth: below the eyes the face is upright.
    upright = np.where(y > 0, np.abs(y / 1.14) ** 8, np.abs(y / FACE[1]) ** 2.6)
    within = 1 - np.abs(x / _half_width(looks)) ** 2.4 - upright
    depth = FACE_CENTER[2] + FACE[2] * looks.width * np.sqrt(np.clip(within, 0, 1))
    factors = {**dict.fromkeys(NOSE, looks.nose), BROW: looks.brow}
    for number, (px, py, width, height, high) in enumerate(HILLS):
        depth = depth + factors.get(number, 1.0) * high * _bump(px, py, width, height)
    depth = cv2.GaussianBlur(depth, (0, 0), 2.5)
    dy, dx = np.gradient(depth, 1 / DENSITY)
    normals = np.dstack([-dx, -dy, np.ones_like(dx)])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return depth.astype(np.float32), normals.astype(np.float32)


def skin(looks: Looks, mien: Mien) -> Field:
    """The colors of the face and, fourth, its cover."""
    skin = _blank(looks).copy()
    skin[EYES_PART] = _eyes(looks, mien.lids, mien.brows)
    skin[MOUTH_PART] = _mouth(looks, mien.mouth, mien.smile)
    return skin


@lru_cache(maxsize=16)
def _blank(looks: Looks) -> Field:
    """A face without eyes and mouth."""
    x, y = _plane()
    skin = np.ones((*x.shape, 4), np.float32)
    tone = np.array(looks.skin, np.float32)
    skin[..., :3] = tone
    blush = tone * (1.0, 0.70, 0.73)
    dark = tone * (0.66, 0.52, 0.52)
    _tint(skin, 0.35 * _bump(0.42, 0.36, 0.18, 0.16), blush)
    _tint(skin, 0.30 * _bump(EYE[0], 0.03, 0.19, 0.10), dark)
    _tint(skin, 0.45 * _bump(0.07, 0.43, 0.045, 0.022), 0.55 * dark)
    _tint(skin, 0.25 * _bump(0.0, 0.45, 0.14, 0.04), dark)
    _tint(skin, 0.20 * _bump(0.0, 0.73, 0.15, 0.03), dark)
    if looks.beard:
        _tint(skin, looks.beard * _beard(), 0.8 * np.array(looks.brows, np.float32))
    hairline = looks.hairline + 0.9 * np.abs(x / 0.69) ** 6 + 0.05 * np.sin(x * 5 - 0.6)
    strands = 1 + 0.10 * np.sin(60 * np.abs(x + 0.25) + 14 * y)
    hair = np.clip((hairline - y) * 12, 0, 1) * np.clip((0.12 - y) * 8, 0, 1)
    _tint(skin, hair, np.multiply.outer(strands, np.array(looks.hair, np.float32)))
    above_skull = np.clip((-0.8 - y) * 8, 0, 1)
    skin[..., 3] = np.clip(_within_face(looks) * 9, 0, 1) * (1 - above_skull)
    return skin


def _beard() -> Field:
    """Where a full beard grows: cheeks below the mouth's height, chin and upper lip."""
    x, y = _plane()
    edge = 0.52 - 0.9 * np.clip(np.abs(x) - 0.30, 0, 1)
    lower: Field = np.clip((y - edge - 0.04) * 10, 0, 1)
    bare = 0.9 * _bump(0.0, MOUTH + 0.02, 0.20, 0.075)
    lip = np.clip(1.3 - np.abs(y - 0.505) * 26, 0, 1) * np.clip((0.22 - np.abs(x)) * 9, 0, 1)
    dice = np.random.default_rng(1)
    grain = cv2.GaussianBlur(dice.normal(0.9, 0.35, x.shape).astype(np.float32), (0, 0), 1.0)
    beard: Field = np.asarray(np.clip(np.maximum(lower * (1 - bare), lip) * grain, 0, 1))
    return beard


@lru_cache(maxsize=1)
def _glasses() -> tuple[Field, Field]:
    """Where a frame with its temples covers the skin, and where the lenses shine."""
    rims, holes, temples, glares = [], [], [], []
    for side in (-1, 1):
        x, y = side * 0.275, 0.07
        rims.append(_box(x, y, 0.215, 0.165))
        holes.append(_box(x, y, 0.190, 0.140))
        edge = x + side * 0.21
        temples.append([(edge, 0.0), (side * 0.8, -0.04), (side * 0.8, 0.0), (edge, 0.04)])
        glares.append([(x - 0.14, 0.02), (x - 0.05, -0.06), (x - 0.02, -0.06), (x - 0.12, 0.04)])
    bridge = [[(-0.08, 0.02), (0.08, 0.02), (0.08, 0.05), (-0.08, 0.05)]]
    frame = np.clip(_shape(rims) - _shape(holes) + _shape(temples) + _shape(bridge), 0, 1)
    return np.asarray(0.92 * frame, np.float32), 0.35 * _shape(glares)


def _box(x: float, y: float, half: float, high: float, count: int = 40) -> list[Point]:
    """A rectangle with round corners."""
    points = []
    for step in np.linspace(0, 2 * math.pi, count, endpoint=False):
        cos, sin = math.cos(step), math.sin(step)
        points.append((x + half * _root(cos), y + high * _root(sin)))
    return points


def _root(part: float) -> float:
    return math.copysign(abs(part) ** 0.5, part)


def _tint(skin: Field, how_much: Field, color: Color | Field) -> None:
    paint(skin[..., :3], np.asarray(color, np.float32), how_much)


def _shape(outlines: Sequence[Sequence[Point]], soft: float = 1.0) -> Field:
    """Where the skin lies inside of outlines given in half heads; softened by a number of
    points.
    """
    inside = [column(np.array(outline, np.float32)) for outline in outlines]
    return filled(_plane()[0].shape, inside, soft)


def _arc(x: float, y: float, half: float, up: float, down: float, count: int = 24) -> list[Point]:
    """The outline of an almond: half as wide, so far up and down in its middle."""
    steps = np.linspace(0, math.pi, count)
    above = [(x - half * math.cos(t), y - up * math.sin(t)) for t in steps]
    below = [(x + half * math.cos(t), y + down * math.sin(t)) for t in steps]
    return above + below


@lru_cache(maxsize=96)
def _eyes(looks: Looks, lids: int, brows: int) -> Field:
    """The rows of the skin with brows and eyes."""
    skin, open_, raised = _blank(looks).copy(), lids / STATES, brows / STATES
    hairs, lashes, whites, irises, pupils, glints = [], [], [], [], [], []
    size = looks.eyes
    for side in (-1, 1):
        x, y = side * EYE[0], EYE[1]
        up, down = size * (0.004 + 0.064 * open_), size * (0.010 + 0.028 * open_)
        inner, outer = x - side * (0.14 + 0.02 * min(0.0, raised)), x + side * 0.17
        lift = 0.05 * raised + 0.02 * min(0.0, raised)
        high = y - lift
        hairs.append([(inner, high - 0.175 - lift), (x + side * 0.03, high - 0.205)])
        hairs[-1] += [(outer, high - 0.12), (x + side * 0.03, high - 0.16)]
        hairs[-1] += [(inner, high - 0.135 - lift)]
        lashes.append(_arc(x, y, 0.128 * size, up + 0.022, down + 0.008))
        whites.append(_arc(x, y + 0.004, 0.112 * size, up, down))
        irises.append(_arc(x, y - 0.012, 0.056 * size, 0.056 * size, 0.056 * size))
        pupils.append(_arc(x, y - 0.012, 0.027 * size, 0.027 * size, 0.027 * size))
        glints.append(_arc(x - 0.022, y - 0.034, 0.012, 0.012, 0.012))
    eye = _shape(whites, 0.8)
    _tint(skin, 0.92 * _shape(hairs, 1.4), looks.brows)
    _tint(skin, 0.9 * _shape(lashes, 1.0), np.minimum(looks.brows, (58.0, 36.0, 32.0)))
    _tint(skin, eye, (238, 234, 230))
    _tint(skin, eye * _shape(irises), looks.iris)
    _tint(skin, eye * _shape(pupils), (18, 14, 14))
    _tint(skin, eye * _shape(glints, 0.6), (255, 255, 255))
    if looks.has_glasses:
        frame, glare = _glasses()
        _tint(skin, frame, (34, 30, 34))
        _tint(skin, glare, (236, 240, 246))
    return skin[EYES_PART].copy()


@lru_cache(maxsize=96)
def _mouth(looks: Looks, mouth: int, smile: int) -> Field:
    """The rows of the skin with the mouth."""
    skin, open_, smiling = _blank(looks).copy(), mouth / STATES, smile / STATES
    gap, half = 0.13 * open_, looks.mouth * (0.205 + 0.045 * smiling - 0.02 * open_)

    def lips(width: float, up: float, down: float) -> list[Point]:
        bend = 0.6 + 2.2 * smiling
        return [(x, y - bend * x * x) for x, y in _arc(0.0, MOUTH, width, up, down)]

    _tint(skin, 0.85 * _shape([lips(half, 0.048, 0.075 + gap)], 1.4), looks.lips)
    _tint(skin, _shape([lips(0.92 * half, 0.002, 0.012 + gap)], 0.8), (96, 36, 36))
    if open_ > 0.3:
        _tint(skin, 0.9 * _shape([lips(0.65 * half, -0.008, 0.038)], 0.8), (236, 230, 222))
    return skin[MOUTH_PART].copy()
