"""A hand of bones and skin that takes any shape, rendered into a picture.

The skin is the generic hand of the WebXR input profiles (MIT; `npm pack
@webxr-input-profiles/assets`, in it dist/profiles/generic-hand/left.glb). It is not in this tree:
whoever measures brings it.
"""

from __future__ import annotations

import json
import math
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.signals import Image

Points = NDArray[np.float64]
"""Shape [n, 3] or [n, 2]."""

FINGERS = ("thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger")
JOINTS = ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")
STRAIGHT = (0.0, 0.0, 0.0)
"""Degrees by which the three joints of a finger are bent, from its root."""
CURLED = (80.0, 95.0, 55.0)
TUCKED = (35.0, 45.0, 40.0)
"""Of a thumb across the palm."""
KINDS = {5126: np.float32, 5123: np.uint16, 5121: np.uint8}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
FINE = 3
"""The hand is drawn at this many times its size, and averaged."""


@dataclass(frozen=True)
class Bent:
    """The shape of a hand: how each finger is bent, degrees, the thumb first."""

    fingers: tuple[tuple[float, float, float], ...] = (STRAIGHT,) * 5
    spread: float = 0.0
    """Degrees between the fingers beside those of a flat hand."""

    def shaken(self, random: np.random.Generator, degrees: float = 6.0) -> Bent:
        """A little else, as no two people hold a hand alike."""
        bent = np.array(self.fingers) + random.normal(0, degrees, (5, 3))
        rows = tuple(tuple(max(-10.0, angle) for angle in row) for row in bent.tolist())
        return Bent(rows, self.spread + float(random.uniform(-1, 3)))


def shown(*straight: int) -> Bent:
    """A hand with these fingers straight, 0 the thumb, and the others curled."""
    rows = [CURLED if finger else TUCKED for finger in range(5)]
    for finger in straight:
        rows[finger] = STRAIGHT
    return Bent(tuple(rows))


@dataclass(frozen=True)
class Placed:
    """Where a hand is, and how it looks there."""

    x: float
    """Pixels, the middle of the palm."""
    y: float
    length: float
    """Pixels from the wrist to the tip of the middle finger of a flat hand seen from the front."""
    turn: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))
    """Of a hand whose palm looks at the camera and whose fingers point up; x right, y down."""
    is_left: bool = True
    skin: tuple[float, float, float] = (205, 155, 125)
    sleeve: tuple[float, float, float] = (60, 70, 90)
    elbow: tuple[float, float] | None = None
    """Pixels; None draws no arm."""
    light: tuple[float, float, float] = (-0.4, -0.6, -0.7)
    """From where it comes."""
    shade: float = 0.45
    """How bright a part is that no light reaches."""


def turned(roll: float = 0.0, yaw: float = 0.0, pitch: float = 0.0) -> NDArray[np.float64]:
    """Turned about the line of sight, then the vertical, then the horizontal; degrees."""
    r, y, p = (math.radians(angle) for angle in (roll, yaw, pitch))
    rolled = [[math.cos(r), -math.sin(r), 0], [math.sin(r), math.cos(r), 0], [0, 0, 1]]
    yawed = [[math.cos(y), 0, math.sin(y)], [0, 1, 0], [-math.sin(y), 0, math.cos(y)]]
    pitched = [[1, 0, 0], [0, math.cos(p), -math.sin(p)], [0, math.sin(p), math.cos(p)]]
    turn: NDArray[np.float64] = np.array(pitched) @ np.array(yawed) @ np.array(rolled)
    return turn


class HandMesh:
    """The skin over its bones. Raises HriError for a file that is not that hand."""

    def __init__(self, file: Path) -> None:
        try:
            self._read(file.read_bytes())
        except (OSError, ValueError, KeyError, IndexError, struct.error) as error:
            remedy = "npm pack @webxr-input-profiles/assets; generic-hand/left.glb of it"
            raise HriError(f"{file}: not the left hand of WebXR: {error} - {remedy}") from error

    def _read(self, content: bytes) -> None:
        size = struct.unpack("<I", content[12:16])[0]
        head, data = json.loads(content[20 : 20 + size]), content[28 + size :]

        def read(number: int) -> NDArray[Any]:
            accessor = head["accessors"][number]
            view, width = head["bufferViews"][accessor["bufferView"]], WIDTHS[accessor["type"]]
            start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            count = accessor["count"] * width
            found = np.frombuffer(data, KINDS[accessor["componentType"]], count, start)
            return found.reshape(-1, width)

        primitive = head["meshes"][0]["primitives"][0]
        places = primitive["attributes"]
        skin = head["skins"][0]
        names = [head["nodes"][node]["name"] for node in skin["joints"]]
        self._bones = {name: index for index, name in enumerate(names)}
        self._points = read(places["POSITION"]).astype(np.float64)
        self._normals = read(places["NORMAL"]).astype(np.float64)
        self._owners = read(places["JOINTS_0"]).astype(np.int64)
        self._weights = read(places["WEIGHTS_0"]).astype(np.float64)
        self._faces = read(primitive["indices"]).reshape(-1, 3).astype(np.int64)
        inverse = read(skin["inverseBindMatrices"]).reshape(-1, 4, 4).astype(np.float64)
        self._inverse = inverse.transpose(0, 2, 1)
        self._bind = np.linalg.inv(self._inverse)

    def bent(self, shape: Bent) -> tuple[Points, Points, Points]:
        """Places of the skin, its normals, and of the bones, in meters.

        Fingers up (-y), palm to the camera (-z), thumb to the left; 0 is the middle of the palm.
        """
        poses = self._bind.copy()
        for finger, (name, bends) in enumerate(zip(FINGERS, shape.fingers, strict=True)):
            joints = JOINTS if finger else (JOINTS[0], JOINTS[1], JOINTS[3], JOINTS[4])
            chain = [self._bones[f"{name}-{joint}"] for joint in joints]
            first = 1 if finger else 0
            aside = shape.spread * (finger - 2.5) if finger else 0.0
            for place, bend in enumerate(bends):
                joint, below = chain[first + place], chain[first + place :]
                turns = _about(poses[joint], 0, -bend)
                if place == 0 and aside:
                    turns = turns @ _about(poses[joint], 1, aside)
                for lower in below:
                    poses[lower] = turns @ poses[lower]
        moves = poses @ self._inverse
        blend = np.einsum("vj,vjab->vab", self._weights, moves[self._owners])
        ones = np.ones((len(self._points), 1))
        skin = np.einsum("vab,vb->va", blend, np.hstack([self._points, ones]))[:, :3]
        normals = np.einsum("vab,vb->va", blend[:, :3, :3], self._normals)
        bones = poses[:, :3, 3]
        middle = (self._bind[self._bones["wrist"]] + self._bind[self._middle()])[:3, 3] / 2
        return _upright(skin - middle), _upright(normals), _upright(bones - middle)

    def bone(self, name: str) -> int:
        """The row of a bone, "index-finger-tip"."""
        return self._bones[name]

    def _middle(self) -> int:
        return self._bones["middle-finger-phalanx-proximal"]

    @property
    def length(self) -> float:
        """Meters from the wrist to the tip of the middle finger, of a flat hand."""
        ends = (self._bones["wrist"], self._bones["middle-finger-tip"])
        first, last = (self._bind[end][:3, 3] for end in ends)
        return float(np.linalg.norm(first - last))

    def draw(self, image: Image, shape: Bent, placed: Placed) -> Points:
        """Paint it into a picture; the pixels [bones, 2] of its bones."""
        skin, normals, bones = self.bent(shape)
        mirror = np.array((1.0 if placed.is_left else -1.0, 1.0, 1.0))
        scale = placed.length / self.length
        # As seen from three hand lengths more than its size says it is away: mild perspective.
        away = 4.0 * self.length

        def seen(points: Points) -> Points:
            there = (points * mirror) @ placed.turn.T
            near = away / (away + there[:, 2:])
            spots: Points = there[:, :2] * near * scale + (placed.x, placed.y)
            return spots

        spots, depth = seen(skin), ((skin * mirror) @ placed.turn.T)[:, 2]
        looks = (normals * mirror) @ placed.turn.T
        light = np.array(placed.light) / np.linalg.norm(placed.light)
        bright = placed.shade + (1 - placed.shade) * np.clip(looks @ light, 0, 1)
        if placed.elbow is not None:
            wrist = seen(bones[[self._bones["wrist"]]])[0]
            _arm(image, wrist, placed)
        _paint(image, spots, depth, bright, self._faces, placed.skin)
        return seen(bones)


def _about(pose: NDArray[np.float64], axis: int, degrees: float) -> NDArray[np.float64]:
    """A turn about an axis of a bone through its joint."""
    vector, place = pose[:3, axis], pose[:3, 3]
    turn = cv2.Rodrigues(vector / np.linalg.norm(vector) * math.radians(degrees))[0]
    matrix: NDArray[np.float64] = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, place - turn @ place
    return matrix


def _upright(points: Points) -> Points:
    """From the axes of the file: its z goes right, its y down, its x to the camera."""
    return np.stack([points[:, 2], points[:, 1], -points[:, 0]], axis=1)


def _arm(image: Image, wrist: Points, placed: Placed) -> None:
    assert placed.elbow is not None
    along = np.array(placed.elbow) - wrist
    along /= np.linalg.norm(along) + 1e-9
    across = np.array((-along[1], along[0]))
    wide = 0.17 * placed.length

    def strip(first: Points, last: Points, thin: float, thick: float, color: Any) -> None:
        corners = [first - thin * across, first + thin * across, last + thick * across]
        corners.append(last - thick * across)
        cv2.fillConvexPoly(image, np.round(corners).astype(np.int32), color, cv2.LINE_AA)

    cuff = wrist + 0.25 * placed.length * along
    dark = tuple(0.8 * channel for channel in placed.skin)
    strip(wrist - 0.1 * placed.length * along, cuff, 0.9 * wide, wide, dark)
    strip(cuff, np.array(placed.elbow), 1.3 * wide, 1.9 * wide, placed.sleeve)


def _paint(
    image: Image,
    spots: Points,
    depth: Points,
    bright: Points,
    faces: NDArray[np.int64],
    color: tuple[float, float, float],
) -> None:
    """The far triangles first, finely, then averaged over the picture below."""
    height, width = image.shape[:2]
    left, top = (max(0, int(edge) - 2) for edge in spots.min(axis=0))
    right = min(width, int(spots[:, 0].max()) + 3)
    bottom = min(height, int(spots[:, 1].max()) + 3)
    if right - left < 2 or bottom - top < 2:
        return
    size = ((bottom - top) * FINE, (right - left) * FINE)
    paint, cover = np.zeros((*size, 3), np.uint8), np.zeros(size, np.uint8)
    corners = np.round((spots - (left, top)) * FINE).astype(np.int32)[faces]
    shades = np.clip(bright[faces].mean(axis=1)[:, None] * color, 0, 255)
    for face in np.argsort(-depth[faces].mean(axis=1)):
        cv2.fillConvexPoly(paint, corners[face], shades[face].tolist())
        cv2.fillConvexPoly(cover, corners[face], 255)
    paint = cv2.GaussianBlur(paint, (0, 0), FINE * 0.7)
    small = (right - left, bottom - top)
    share = cv2.resize(cover, small, interpolation=cv2.INTER_AREA)[..., None] / 255.0
    drawn = cv2.resize(paint, small, interpolation=cv2.INTER_AREA)
    below = image[top:bottom, left:right]
    below[:] = np.round(share * drawn + (1 - share) * below).astype(np.uint8)
