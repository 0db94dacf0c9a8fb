"""A drawn head that turns: what a camera sees of the simulated person.

The face is a relief over the plane of the face (nose, sockets, lips, chin) with a drawn skin; it
sits on an ellipsoid skull with hair, on a neck and shoulders, before a room. Each picture is cast
by parallel rays through the turned head. Lengths of the head are in half heads: chin to crown is
2, x to the right of the picture, y down, z toward the camera, the origin in the middle.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image

Field = NDArray[np.float32]
"""A value, or a few, for each point of a plane: shape [height, width] or [height, width, n]."""
Angles = tuple[float, float, float]
"""Pitch, yaw, roll as in HeadPose, radians."""
Point = tuple[float, float]
Color = tuple[float, float, float]
"""Red, green, blue, 0 to 255."""

SKIN, HAIR, EAR, LIPS, SHIRT = np.array(
    [(226, 172, 142), (74, 50, 38), (186, 128, 104), (178, 92, 88), (62, 92, 120)], np.float32
)
"""Red, green, blue; EAR is the hollow of the ear."""

LIGHT = np.array([-0.35, -0.55, 0.76], np.float32)
"""The direction to the light, in the axes of the picture."""
AMBIENT = 0.62
"""Part of the light that comes from everywhere."""
PIVOT = np.array([0.0, 0.35, -0.25], np.float32)
"""The joint on which the head turns."""
SKULL = np.array([0.70, 0.86, 0.86], np.float32)
"""Half axes of the skull."""
SKULL_CENTER = np.array([0.0, -0.16, -0.12], np.float32)

FACE = np.array([0.69, 1.04, 0.74], np.float32)
"""Half axes of the ellipsoid under the relief of the face."""

DENSITY = 96
"""Points of the face's skin to a half head."""
REACH = 1.15
"""Half heads from the middle of the skin to its edge."""
STATES = 6
"""Steps between a shut and an open mouth, and between shut and open eyes."""
CASTS = 3
"""Corrections of a ray until it meets the relief."""
FINE_BITS = 4
"""Outlines are drawn to a sixteenth of a pixel."""


def render_head(
    pitch: float,
    yaw: float,
    roll: float,
    *,
    center: tuple[float, float],
    height: float,
    size: tuple[int, int] = (320, 240),
    mouth: float = 0.0,
    lids: float = 1.0,
) -> Image:
    """The picture of a person's head and shoulders in a room; the same for the same arguments.

    Angles as in HeadPose, radians, all 0 look at the camera. `center` and `height` of the
    head (chin to crown) in pixels; `size` is width and height. `mouth` 0 shut to 1 open, `lids`
    0 shut to 1 open. A head outside of the picture leaves the room empty.
    """
    image = _scene(size, (round(center[0], 1), round(center[1], 1)), round(height, 1)).copy()
    window = _window(size, center, height)
    if window is not None:
        skin = _skin(_step(mouth), _step(lids))
        _paint_head(image, window, center, height / 2, _rotation(pitch, yaw, roll), skin)
    return image


def _step(part: float) -> int:
    return round(min(1.0, max(0.0, part)) * STATES)


def _rotation(pitch: float, yaw: float, roll: float) -> Field:
    """From the head's axes to those of the picture; roll is toward the person's left shoulder."""
    cp, sp, cy, sy = math.cos(pitch), math.sin(pitch), math.cos(yaw), math.sin(yaw)
    cr, sr = math.cos(roll), math.sin(roll)
    nod = np.array([[1, 0, 0], [0, cp, sp], [0, -sp, cp]])
    turn = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    tilt = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    rotation: Field = (tilt @ turn @ nod).astype(np.float32)
    return rotation


# ---------------------------------------------------------------- the head, cast by rays


def _window(
    size: tuple[int, int], center: tuple[float, float], height: float
) -> tuple[slice, slice] | None:
    """Rows and columns of the picture that the head may touch."""
    wide, high = 0.56 * height, 0.62 * height
    left, right = (min(size[0], max(0, int(center[0] + s * wide))) for s in (-1, 1))
    top, bottom = (min(size[1], max(0, int(center[1] + s * high))) for s in (-1, 1))
    if right - left < 2 or bottom - top < 2:
        return None
    return slice(top, bottom), slice(left, right)


def _paint_head(
    image: Image,
    window: tuple[slice, slice],
    center: tuple[float, float],
    scale: float,
    rotation: Field,
    skin: Field,
) -> None:
    rows, columns = window
    x = (np.arange(columns.start, columns.stop, dtype=np.float32) - center[0]) / scale
    y = (np.arange(rows.start, rows.stop, dtype=np.float32) - center[1]) / scale
    grid = np.meshgrid(x, y)
    turned = rotation @ -PIVOT + PIVOT
    origins = [
        rotation[0, i] * (grid[0] - turned[0]) + rotation[1, i] * (grid[1] - turned[1])
        for i in range(3)
    ]
    direction, light = rotation[2], rotation.T @ LIGHT
    picture = image[window].astype(np.float32)
    corner = np.array([center[0] - columns.start, center[1] - rows.start], np.float32)
    nearer = 1 if direction[0] > 0 else -1
    _paint_ear(picture, -nearer, rotation, corner, scale)
    _paint(picture, *_cast_skull(origins, direction, light, scale / 2))
    _paint_ear(picture, nearer, rotation, corner, scale)
    _paint(picture, *_cast_face(origins, direction, light, skin))
    image[window] = np.clip(picture, 0, 255).astype(np.uint8)


def _paint(picture: Field, color: Field, cover: Field) -> None:
    """Lay a color over the picture where `cover` is 1, in part where it is less."""
    picture += (color - picture) * cover[..., None]


def _paint_ear(picture: Field, side: int, rotation: Field, corner: Field, scale: float) -> None:
    """An ear, 1 on the right of the picture; `corner` is the head's middle in pixels."""
    steps = np.linspace(0, 2 * math.pi, 20)
    for size, color in ((1.0, SKIN), (0.62, EAR)):
        out, down = size * np.cos(steps), size * np.sin(steps)
        outline = np.array(
            [side * (0.70 + 0.07 * out), 0.10 + 0.03 * out + 0.18 * down, -0.10 - 0.09 * out]
        )
        turned = rotation @ (outline - PIVOT[:, None]) + PIVOT[:, None]
        points = _fine(turned[:2].T * scale + corner)
        cv2.fillPoly(picture, [points], (0.86 * color).tolist(), cv2.LINE_8, FINE_BITS)


def _cast_skull(
    origins: list[Field], direction: Field, light: Field, softness: float
) -> tuple[Field, Field]:
    """Color and cover, 0 to 1, of skull, hair and the skin behind the cheeks."""
    middled = [origin - center for origin, center in zip(origins, SKULL_CENTER, strict=True)]
    point, _, inside = _meet(middled, direction, SKULL)
    shade = sum(point[i] * (light[i] / SKULL[i] * 0.8) for i in range(3))
    shade = AMBIENT + (1 - AMBIENT) * np.maximum(shade, 0)
    # The hair ends at a line that drops from the forehead to the neck.
    hair = np.clip((0.16 - 0.55 * point[2] - point[1]) * 14, 0, 1)[..., None]
    strands = 1 + 0.10 * np.sin(point[0] * 34 + 5 * point[1])[..., None]
    color = 0.9 * SKIN * (1 - hair) + HAIR * strands * hair
    cover: Field = np.clip(inside * softness * 0.8, 0, 1)
    return np.asarray(color * shade[..., None], np.float32), cover


def _meet(origins: list[Field], direction: Field, axes: Field) -> tuple[list[Field], Field, Field]:
    """Where rays meet an ellipsoid with these half axes, as a point of the unit sphere.

    Also how far along the ray that is, and a number below 0 where a ray misses.
    """
    o = [origin / axis for origin, axis in zip(origins, axes, strict=True)]
    d = direction / axes
    a = float(d @ d)
    b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2]
    c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - 1
    inside = b * b - a * c
    ray = (np.sqrt(np.maximum(inside, 0)) - b) / a
    return [o[i] + ray * d[i] for i in range(3)], ray, inside


def _cast_face(
    origins: list[Field], direction: Field, light: Field, skin: Field
) -> tuple[Field, Field]:
    """Color and cover of the face: from an ellipsoid, rays go on until they meet the relief."""
    relief, normals = _relief()
    point, ray, _ = _meet(origins, direction, FACE)
    normal = [point[i] / FACE[i] for i in range(3)]
    toward = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]
    # Newton's step, with the slope of the ellipsoid for that of the relief.
    step = np.clip(normal[2] / np.maximum(toward, 0.1), 0, 1.2)
    for _ in range(CASTS):
        x, y = (_column(origins[i] + ray * direction[i]) for i in range(2))
        depth = cv2.remap(relief, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        ray += step * (depth - origins[2] - ray * direction[2])
    x, y = (_column(origins[i] + ray * direction[i]) for i in range(2))
    colors = cv2.remap(skin, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
    shade = cv2.remap(normals @ light, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    shade = AMBIENT + (1 - AMBIENT) * np.maximum(shade, 0)
    missed = np.abs(depth - origins[2] - ray * direction[2])
    cover: Field = colors[..., 3] * np.clip(2 - missed * 12, 0, 1)
    return np.asarray(colors[..., :3] * shade[..., None], np.float32), cover


def _column(length: Field) -> Field:
    """Where a coordinate of the head lies on the skin, in its points."""
    return (length + REACH) * DENSITY


# ---------------------------------------------------------------- relief and skin of the face


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


def _within_face() -> Field:
    """1 in the middle of the face, 0 at its edge, wide at the cheeks and narrow at the chin."""
    x, y = _plane()
    jaw = np.clip((y - 0.15) / 0.85, 0, 1)
    half_width = FACE[0] - 0.24 * jaw**1.8
    within: Field = 1 - np.abs(x / half_width) ** 2.4 - np.abs(y / FACE[1]) ** 2.6
    return within


HILLS = (
    (0.0, 0.20, 0.075, 0.17, 0.09),  # bridge of the nose
    (0.0, 0.35, 0.10, 0.10, 0.13),  # its tip
    (0.10, 0.39, 0.05, 0.05, 0.05),  # its wings
    (0.25, -0.14, 0.22, 0.08, 0.035),  # brows
    (0.28, 0.06, 0.16, 0.10, -0.055),  # eye sockets
    (0.40, 0.30, 0.20, 0.16, 0.035),  # cheeks
    (0.0, 0.62, 0.20, 0.08, 0.04),  # lips
    (0.0, 0.76, 0.16, 0.05, -0.025),  # below the lips
    (0.0, 0.90, 0.16, 0.10, 0.05),  # chin
)
"""Hills and hollows of the relief: x, y, width, height, how high."""


@lru_cache(maxsize=1)
def _relief() -> tuple[Field, Field]:
    """How far the face stands out at each point, and its normals."""
    depth = FACE[2] * np.sqrt(np.clip(_within_face(), 0, 1))
    for px, py, width, height, high in HILLS:
        depth = depth + high * _bump(px, py, width, height)
    depth = cv2.GaussianBlur(depth, (0, 0), 2.5)
    dy, dx = np.gradient(depth, 1 / DENSITY)
    normals = np.dstack([-dx, -dy, np.ones_like(dx)])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return depth.astype(np.float32), normals.astype(np.float32)


@lru_cache(maxsize=(STATES + 1) ** 2)
def _skin(mouth: int, lids: int) -> Field:
    """The colors of the face and, fourth, its cover, for a mouth and eyes so far open."""
    x, y = _plane()
    skin = np.ones((*x.shape, 4), np.float32)
    skin[..., :3] = SKIN
    _tint(skin, 0.35 * _bump(0.42, 0.36, 0.18, 0.16), (226, 120, 104))
    _tint(skin, 0.30 * _bump(0.28, 0.03, 0.19, 0.10), (150, 90, 74))
    _tint(skin, 0.45 * _bump(0.07, 0.45, 0.05, 0.025), (96, 48, 40))
    _tint(skin, 0.25 * _bump(0.0, 0.47, 0.14, 0.04), (150, 90, 74))
    _paint_eyes(skin, lids / STATES)
    _paint_mouth(skin, mouth / STATES)
    hairline = -0.62 + 0.9 * np.abs(x / 0.69) ** 6 + 0.05 * np.sin(x * 5 - 0.6)
    strands = 1 + 0.10 * np.sin(60 * np.abs(x + 0.25) + 14 * y)
    hair = np.clip((hairline - y) * 12, 0, 1) * np.clip((0.12 - y) * 8, 0, 1)
    _tint(skin, hair, np.multiply.outer(strands, HAIR))
    above_skull = np.clip((-0.8 - y) * 8, 0, 1)
    skin[..., 3] = np.clip(_within_face() * 9, 0, 1) * (1 - above_skull)
    return skin


def _tint(skin: Field, how_much: Field, color: Color | Field) -> None:
    _paint(skin[..., :3], np.asarray(color, np.float32), how_much)


def _shape(outlines: Sequence[Sequence[Point]], soft: float = 1.0) -> Field:
    """Where the skin lies inside of outlines given in half heads; softened by so many points."""
    inside = [_column(np.array(outline, np.float32)) for outline in outlines]
    return _filled(_plane()[0].shape, inside, soft)


def _filled(shape: tuple[int, ...], outlines: Sequence[NDArray[Any]], soft: float) -> Field:
    """1 inside of the outlines, 0 outside, with an edge some pixels soft."""
    mask = np.zeros(shape[:2], np.uint8)
    for outline in outlines:
        cv2.fillPoly(mask, [_fine(outline)], 255, cv2.LINE_AA, FINE_BITS)
    return np.asarray(cv2.GaussianBlur(mask, (0, 0), soft), np.float32) / np.float32(255)


def _fine(points: NDArray[Any]) -> NDArray[np.int32]:
    """Pixels as OpenCV's drawing takes them: whole numbers of sixteenths."""
    fine: NDArray[np.int32] = np.rint(points * 2**FINE_BITS).astype(np.int32)
    return fine


def _arc(x: float, y: float, half: float, up: float, down: float, count: int = 24) -> list[Point]:
    """The outline of an almond: half as wide, so far up and down in its middle."""
    steps = np.linspace(0, math.pi, count)
    above = [(x - half * math.cos(t), y - up * math.sin(t)) for t in steps]
    below = [(x + half * math.cos(t), y + down * math.sin(t)) for t in steps]
    return above + below


def _paint_eyes(skin: Field, open_: float) -> None:
    brows, lashes, whites, irises, pupils, glints = [], [], [], [], [], []
    for side in (-1, 1):
        x, y = side * 0.28, 0.05
        up, down = 0.005 + 0.075 * open_, 0.012 + 0.033 * open_
        inner, outer = x - side * 0.16, x + side * 0.19
        brows.append([(inner, y - 0.19), (x + side * 0.03, y - 0.225), (outer, y - 0.13)])
        brows[-1] += [(x + side * 0.03, y - 0.175), (inner, y - 0.145)]
        lashes.append(_arc(x, y, 0.155, up + 0.025, down + 0.008))
        whites.append(_arc(x, y + 0.004, 0.135, up, down))
        irises.append(_arc(x, y - 0.015, 0.068, 0.068, 0.068))
        pupils.append(_arc(x, y - 0.015, 0.034, 0.034, 0.034))
        glints.append(_arc(x - 0.025, y - 0.04, 0.014, 0.014, 0.014))
    eye = _shape(whites, 0.8)
    _tint(skin, 0.92 * _shape(brows, 1.4), (62, 40, 32))
    _tint(skin, 0.9 * _shape(lashes, 1.0), (58, 36, 32))
    _tint(skin, eye, (238, 234, 230))
    _tint(skin, eye * _shape(irises), (84, 98, 78))
    _tint(skin, eye * _shape(pupils), (18, 14, 14))
    _tint(skin, eye * _shape(glints, 0.6), (255, 255, 255))


def _paint_mouth(skin: Field, open_: float) -> None:
    gap = 0.13 * open_
    _tint(skin, 0.85 * _shape([_smiling(0.225, 0.048, 0.075 + gap)], 1.4), LIPS)
    _tint(skin, _shape([_smiling(0.205, 0.002, 0.012 + gap)], 0.8), (96, 36, 36))
    if open_ > 0.3:
        _tint(skin, 0.9 * _shape([_smiling(0.14, -0.008, 0.038)], 0.8), (236, 230, 222))


def _smiling(half: float, up: float, down: float) -> list[Point]:
    """An arc at the mouth, its corners raised."""
    return [(x, y - 1.1 * x * x) for x, y in _arc(0.0, 0.645, half, up, down)]


# ---------------------------------------------------------------- body and room

Outline = tuple[Point, ...]

NECK: Outline = ((-0.40, 0.3), (-0.42, 1.15), (-0.62, 1.36), (0.0, 1.62))
SHIRT_EDGE: Outline = (
    (0.0, 1.60),
    (-0.36, 1.42),
    (-0.60, 1.27),
    (-1.30, 1.50),
    (-1.66, 1.80),
    (-1.86, 2.60),
    (-1.95, 6.0),
)
"""The left half of the outlines, in half heads from the middle of the head."""

WALL: tuple[Color, Color] = ((206, 198, 184), (168, 156, 142))
"""At the top and at the bottom."""
FURNITURE: tuple[tuple[float, float, float, float, Color], ...] = (
    (0.03, 0.08, 0.25, 0.62, (236, 238, 236)),  # window frame
    (0.05, 0.11, 0.135, 0.59, (178, 206, 226)),
    (0.145, 0.11, 0.23, 0.59, (188, 214, 232)),
    (0.05, 0.42, 0.23, 0.59, (150, 176, 150)),  # trees in it
    (0.76, 0.16, 0.98, 0.60, (128, 96, 68)),  # shelf
    (0.775, 0.19, 0.965, 0.37, (92, 68, 50)),
    (0.775, 0.40, 0.965, 0.57, (92, 68, 50)),
    (0.785, 0.22, 0.805, 0.37, (150, 62, 54)),  # books
    (0.81, 0.24, 0.835, 0.37, (64, 96, 112)),
    (0.84, 0.21, 0.86, 0.37, (190, 164, 98)),
    (0.865, 0.25, 0.895, 0.37, (84, 112, 84)),
    (0.90, 0.23, 0.92, 0.37, (120, 84, 110)),
    (0.80, 0.43, 0.82, 0.57, (70, 84, 120)),
    (0.825, 0.45, 0.855, 0.57, (176, 120, 70)),
    (0.86, 0.42, 0.885, 0.57, (110, 60, 60)),
    (0.93, 0.44, 0.955, 0.57, (196, 188, 170)),
    (0.0, 0.90, 1.0, 0.915, (214, 208, 198)),  # skirting
)
"""Left, top, right, bottom as parts of the picture, color."""


@lru_cache(maxsize=4)
def _room(size: tuple[int, int]) -> Image:
    """A room behind the person, a little out of focus."""
    width, height = size
    blend = np.linspace(0, 1, height)[:, None, None]
    wall = np.array(WALL[0]) * (1 - blend) + np.array(WALL[1]) * blend
    glow = 1.08 - 0.16 * np.linspace(0, 1, width)[None, :, None]
    image: Image = np.clip(wall * glow, 0, 255).astype(np.uint8)
    for left, top, right, bottom, color in FURNITURE:
        corners = (
            (round(left * width), round(top * height)),
            (
                round(right * width),
                round(bottom * height),
            ),
        )
        cv2.rectangle(image, *corners, color, cv2.FILLED)
    return cv2.GaussianBlur(image, (0, 0), max(0.5, width / 160)).astype(np.uint8)


@lru_cache(maxsize=8)
def _scene(size: tuple[int, int], center: tuple[float, float], height: float) -> Image:
    """The room with neck and shoulders of somebody whose head is there."""
    scale = height / 2
    image = _room(size).copy()
    left, right = (min(size[0], max(0, round(center[0] + s * 2 * scale))) for s in (-1, 1))
    top = min(size[1], max(0, round(center[1] + 0.3 * scale)))
    if left == right or top == size[1]:
        return image
    x = (np.arange(left, right, dtype=np.float32)[None, :, None] - center[0]) / scale
    y = (np.arange(top, size[1], dtype=np.float32)[:, None, None] - center[1]) / scale
    turned_away = np.clip(1.05 - 0.10 * x - 0.05 * x * x, 0.3, 1.1)
    below_chin = 0.5 + 0.5 * np.clip((y - 0.75) / 0.5, 0, 1)
    body = image[top:, left:right].astype(np.float32)
    corner = np.array(center) - (left, top)
    for outline, color in ((NECK, SKIN * below_chin), (SHIRT_EDGE, SHIRT)):
        whole = np.array([*outline, *((-x, y) for x, y in reversed(outline))])
        cover = _filled(body.shape, [whole * scale + corner], 0.6)
        _paint(body, color * turned_away, cover)
    image[top:, left:right] = np.clip(body, 0, 255).astype(np.uint8)
    return image


# ---------------------------------------------------------------- how people move their heads

SWAY = (
    ((0.9, 0.11), (0.5, 0.29)),
    ((1.6, 0.07), (0.8, 0.23)),
    ((0.8, 0.09), (0.3, 0.31)),
)
"""Waves of pitch, yaw and roll of a head at rest: degrees and hertz; too slow for a gesture."""


def nod_angles(
    time: float, *, amplitude: float = math.radians(8), frequency: float = 1.8, cycles: float = 2.0
) -> Angles:
    """A nod that begins at time 0 with the head going down; radians, hertz, ups and downs."""
    return _swings(time, amplitude, frequency, cycles), 0.0, 0.0


def shake_angles(
    time: float, *, amplitude: float = math.radians(14), frequency: float = 1.8, cycles: float = 2.0
) -> Angles:
    """A shake of the head that begins at time 0 to the person's left."""
    return 0.0, _swings(time, amplitude, frequency, cycles), 0.0


def idle_angles(time: float, seed: int = 0) -> Angles:
    """The small sway of a head at rest at a time; each seed sways in its own way."""
    phases = np.random.default_rng(seed).uniform(0, 2 * math.pi, (3, 2))
    pitch, yaw, roll = (
        sum(
            math.radians(degrees) * math.sin(2 * math.pi * hertz * time + phase)
            for (degrees, hertz), phase in zip(waves, row, strict=True)
        )
        for waves, row in zip(SWAY, phases, strict=True)
    )
    return pitch, yaw, roll


def _swings(time: float, amplitude: float, frequency: float, cycles: float) -> float:
    """A sine that swells and fades within a quarter of a cycle."""
    phase = time * frequency
    edge = min(1.0, 4 * max(0.0, min(phase, cycles - phase)))
    return amplitude * edge * edge * (3 - 2 * edge) * math.sin(2 * math.pi * phase)
