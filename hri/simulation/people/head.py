"""A drawn head that turns: what a camera sees of a simulated person.

The face is a relief over the plane of the face (nose, sockets, lips, chin) with a drawn skin; it
sits on an ellipsoid skull with hair. Each picture is cast by parallel rays through the turned
head. Lengths of the head are in half heads: chin to crown is
2, x to the right of the picture, y down, z toward the camera, the origin in the middle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from hri.core.signals import Image
from hri.simulation.people.appearance import Looks
from hri.simulation.people.portrait import (
    CHIN_DROP,
    FACE,
    FACE_CENTER,
    MOUTH,
    STATES,
    Mien,
    column,
    relief,
    skin,
)
from hri.simulation.people.soft_edges import FINE_BITS, Field, fine, paint

LIGHT = np.array([-0.35, -0.55, 0.76], np.float32)
"""The direction to the light, in the axes of the picture."""
AMBIENT = 0.62
"""Part of the light that comes from everywhere."""
PIVOT = np.array([0.0, 0.35, -0.25], np.float32)
"""The joint on which the head turns."""
SKULL = np.array([0.70, 0.86, 0.86], np.float32)
"""Half axes of the skull."""
SKULL_CENTER = np.array([0.0, -0.16, -0.12], np.float32)

CASTS = 5
"""Corrections of a ray until it meets the relief."""


def paint_head(
    image: Image,
    looks: Looks,
    mien: Mien,
    angles: tuple[float, float, float],
    center: tuple[float, float],
    height: float,
) -> None:
    """Paint a head on a picture.

    `angles` are pitch, yaw and roll as in HeadPose, radians, all 0 face the camera; `center`
    and `height` of the head (chin to crown) are in pixels. What lies outside of the picture is
    left out.
    """
    window = _window((image.shape[1], image.shape[0]), center, height)
    if window is not None:
        _paint(image, window, Head(looks, mien, _rotation(*angles), center, height / 2))


def _rotation(pitch: float, yaw: float, roll: float) -> Field:
    """From the head's axes to those of the picture; roll is toward the person's left shoulder."""
    cp, sp, cy, sy = math.cos(pitch), math.sin(pitch), math.cos(yaw), math.sin(yaw)
    cr, sr = math.cos(roll), math.sin(roll)
    nod = np.array([[1, 0, 0], [0, cp, sp], [0, -sp, cp]])
    turn = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    tilt = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    rotation: Field = (tilt @ turn @ nod).astype(np.float32)
    return rotation


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


@dataclass(frozen=True, eq=False)
class Head:
    """A head as it is painted."""

    looks: Looks
    mien: Mien
    rotation: Field
    center: tuple[float, float]
    """Pixels."""
    scale: float
    """Pixels of a half head."""


def _paint(image: Image, window: tuple[slice, slice], head: Head) -> None:
    rows, columns = window
    x = (np.arange(columns.start, columns.stop, dtype=np.float32) - head.center[0]) / head.scale
    y = (np.arange(rows.start, rows.stop, dtype=np.float32) - head.center[1]) / head.scale
    grid = np.meshgrid(x, y)
    turned = head.rotation @ -PIVOT + PIVOT
    origins = [
        head.rotation[0, i] * (grid[0] - turned[0]) + head.rotation[1, i] * (grid[1] - turned[1])
        for i in range(3)
    ]
    direction, light = head.rotation[2], head.rotation.T @ LIGHT
    picture = image[window].astype(np.float32)
    corner = np.array(head.center, np.float32) - (columns.start, rows.start)
    nearer = 1 if direction[0] > 0 else -1
    ears = () if head.looks.hair_length else (-nearer, nearer)
    for side in ears[:1]:
        _paint_ear(picture, side, head, corner)
    paint(picture, *_cast_skull(origins, direction, light, head))
    for side in ears[1:]:
        _paint_ear(picture, side, head, corner)
    paint(picture, *_cast_face(origins, direction, light, head))
    image[window] = np.clip(picture, 0, 255).astype(np.uint8)


def _paint_ear(picture: Field, side: int, head: Head, corner: Field) -> None:
    """An ear, 1 on the right of the picture; `corner` is the head's middle in pixels."""
    steps = np.linspace(0, 2 * math.pi, 20)
    tone = np.array(head.looks.skin, np.float32)
    for size, color in ((1.0, tone), (0.62, tone * (0.82, 0.74, 0.73))):
        out, down = size * np.cos(steps), size * np.sin(steps)
        beside = head.looks.width * (0.70 + 0.07 * out)
        outline = np.array([side * beside, 0.10 + 0.03 * out + 0.18 * down, -0.10 - 0.09 * out])
        turned = head.rotation @ (outline - PIVOT[:, None]) + PIVOT[:, None]
        points = fine(turned[:2].T * head.scale + corner)
        cv2.fillPoly(picture, [points], (0.86 * color).tolist(), cv2.LINE_8, FINE_BITS)


def _wide(looks: Looks) -> Field:
    return np.array([looks.width, 1, looks.width], np.float32)


def _cast_skull(
    origins: list[Field], direction: Field, light: Field, head: Head
) -> tuple[Field, Field]:
    """Color and cover, 0 to 1, of skull, hair and the skin behind the cheeks."""
    looks = head.looks
    axes = SKULL * _wide(looks)
    middled = [origin - center for origin, center in zip(origins, SKULL_CENTER, strict=True)]
    point, _, inside = _meet(middled, direction, axes)
    shade = sum(point[i] * (light[i] / axes[i] * 0.8) for i in range(3))
    shade = AMBIENT + (1 - AMBIENT) * np.maximum(shade, 0)
    # The hair ends at a line that drops from the forehead to the neck.
    lowest = 1.4 if looks.hair_length else 0.16
    hair = np.clip((lowest - 0.55 * point[2] - point[1]) * 14, 0, 1)[..., None]
    strands = 1 + 0.10 * np.sin(point[0] * 34 + 5 * point[1])[..., None]
    color = np.array(looks.skin) * 0.9 * (1 - hair) + np.array(looks.hair) * strands * hair
    cover: Field = np.clip(inside * head.scale * 0.4, 0, 1)
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
    origins: list[Field], direction: Field, light: Field, head: Head
) -> tuple[Field, Field]:
    """Color and cover of the face: from an ellipsoid, rays go on until they meet the relief."""
    heights, normals = relief(head.looks)
    drop = CHIN_DROP * head.mien.mouth / STATES
    axes = FACE * _wide(head.looks)
    middled = [origin - center for origin, center in zip(origins, FACE_CENTER, strict=True)]
    point, ray, _ = _meet(middled, direction, axes)
    normal = [point[i] / axes[i] for i in range(3)]
    toward = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]
    # Newton's step, with the slope of the ellipsoid for that of the relief.
    step = np.clip(normal[2] / np.maximum(toward, 0.1), 0, 1.2)

    def on_skin() -> tuple[Field, Field]:
        """Where the rays are on the skin: it is stretched below an open mouth."""
        x = (origins[0] + ray * direction[0]) / head.looks.width
        y = origins[1] + ray * direction[1]
        if drop:
            y -= drop * np.clip((y - MOUTH) / (1 - MOUTH), 0, 1)
        return column(x), column(y)

    for _ in range(CASTS):
        depth = _looked_up(heights, *on_skin())
        ray += step * (depth - origins[2] - ray * direction[2])
    x, y = on_skin()
    surface = skin(head.looks, head.mien)
    colors = cv2.remap(surface, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
    shade = AMBIENT + (1 - AMBIENT) * np.maximum(_looked_up(normals @ light, x, y), 0)
    missed = np.abs(depth - origins[2] - ray * direction[2])
    cover: Field = colors[..., 3] * np.clip(2 - missed * 12, 0, 1)
    return np.asarray(colors[..., :3] * shade[..., None], np.float32), cover


def _looked_up(table: Field, x: Field, y: Field) -> Field:
    found = cv2.remap(table, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found, np.float32)
