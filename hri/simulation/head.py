"""A drawn head that turns: what a camera sees of the simulated person.

The face is a relief over the plane of the face (nose, sockets, lips, chin) with a drawn skin; it
sits on an ellipsoid skull with hair, on a neck and shoulders, before a room. Each picture is cast
by parallel rays through the turned head. Lengths of the head are in half heads: chin to crown is
2, x to the right of the picture, y down, z toward the camera, the origin in the middle.
"""

from __future__ import annotations

import math

import cv2
import numpy as np

from hri.core.signals import Image
from hri.simulation.backdrop import scene
from hri.simulation.drawing import FINE_BITS, Field, fine, paint
from hri.simulation.portrait import FACE, HAIR, SKIN, STATES, column, relief, skin

EAR = np.array((186, 128, 104), np.float32)
"""Red, green, blue of the hollow of the ear."""

LIGHT = np.array([-0.35, -0.55, 0.76], np.float32)
"""The direction to the light, in the axes of the picture."""
AMBIENT = 0.62
"""Part of the light that comes from everywhere."""
PIVOT = np.array([0.0, 0.35, -0.25], np.float32)
"""The joint on which the head turns."""
SKULL = np.array([0.70, 0.86, 0.86], np.float32)
"""Half axes of the skull."""
SKULL_CENTER = np.array([0.0, -0.16, -0.12], np.float32)

CASTS = 3
"""Corrections of a ray until it meets the relief."""


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
    image = scene(size, (round(center[0], 1), round(center[1], 1)), round(height, 1)).copy()
    window = _window(size, center, height)
    if window is not None:
        surface = skin(_step(mouth), _step(lids))
        _paint_head(image, window, center, height / 2, _rotation(pitch, yaw, roll), surface)
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
    surface: Field,
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
    paint(picture, *_cast_skull(origins, direction, light, scale / 2))
    _paint_ear(picture, nearer, rotation, corner, scale)
    paint(picture, *_cast_face(origins, direction, light, surface))
    image[window] = np.clip(picture, 0, 255).astype(np.uint8)


def _paint_ear(picture: Field, side: int, rotation: Field, corner: Field, scale: float) -> None:
    """An ear, 1 on the right of the picture; `corner` is the head's middle in pixels."""
    steps = np.linspace(0, 2 * math.pi, 20)
    for size, color in ((1.0, SKIN), (0.62, EAR)):
        out, down = size * np.cos(steps), size * np.sin(steps)
        outline = np.array(
            [side * (0.70 + 0.07 * out), 0.10 + 0.03 * out + 0.18 * down, -0.10 - 0.09 * out]
        )
        turned = rotation @ (outline - PIVOT[:, None]) + PIVOT[:, None]
        points = fine(turned[:2].T * scale + corner)
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
    origins: list[Field], direction: Field, light: Field, surface: Field
) -> tuple[Field, Field]:
    """Color and cover of the face: from an ellipsoid, rays go on until they meet the relief."""
    heights, normals = relief()
    point, ray, _ = _meet(origins, direction, FACE)
    normal = [point[i] / FACE[i] for i in range(3)]
    toward = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]
    # Newton's step, with the slope of the ellipsoid for that of the relief.
    step = np.clip(normal[2] / np.maximum(toward, 0.1), 0, 1.2)
    for _ in range(CASTS):
        x, y = (column(origins[i] + ray * direction[i]) for i in range(2))
        depth = cv2.remap(heights, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        ray += step * (depth - origins[2] - ray * direction[2])
    x, y = (column(origins[i] + ray * direction[i]) for i in range(2))
    colors = cv2.remap(surface, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
    shade = cv2.remap(normals @ light, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    shade = AMBIENT + (1 - AMBIENT) * np.maximum(shade, 0)
    missed = np.abs(depth - origins[2] - ray * direction[2])
    cover: Field = colors[..., 3] * np.clip(2 - missed * 12, 0, 1)
    return np.asarray(colors[..., :3] * shade[..., None], np.float32), cover
