"""What the robot sees, drawn over the picture: boxes, ids, landmarks, poses, hands, gestures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

import cv2
import numpy as np

from hri.core.signals import (
    ColorBlob,
    FaceBox,
    FoundObject,
    Hand,
    HeadPose,
    Image,
    Motion,
    People,
    Person,
)

Color = tuple[int, int, int]
Point = tuple[int, int]

CALM, LOOKING, HIDDEN, GESTURE = (90, 160, 255), (80, 220, 120), (150, 150, 150), (255, 210, 60)
"""Red, green, blue of a person's marks: seen, looking at the robot, out of sight, and a gesture."""
HAND: Color = (60, 230, 230)
BONES = np.array([[0, root, root + 1, root + 2, root + 3] for root in range(1, 21, 4)])
"""Of each finger, the points of a hand from the wrist to its tip."""
OBJECT: Color = (230, 120, 240)
AXES: tuple[Color, ...] = ((235, 80, 80), (80, 220, 120), (90, 160, 255))
"""Of the head's own left, down and ahead."""
SMALLEST_FACE = 8.0
"""Pixels; the marks of a smaller face would hide it."""
REACH = 1e6
"""Pixels; points farther out, or NaN, are not drawn."""
BLOB, MOVING = (255, 120, 220), (90, 200, 255)
ARROW = 3.0
"""Times the way between two pictures that an arrow is long."""
FONT = cv2.FONT_HERSHEY_SIMPLEX


class Gesture(Protocol):
    """What someone did, with head, hand or face."""

    @property
    def kind(self) -> str: ...

    @property
    def person(self) -> str: ...


def draw(
    image: Image,
    people: People | None,
    gestures: Sequence[Gesture] = (),
    has_landmarks: bool = True,
) -> Image:
    """A copy of the picture, uint8 [height, width, 3], RGB, with everyone in it marked.

    A box and a line of words a person: id or name, distance, engagement, pose in degrees; three
    axes from the middle of the face (left red, down green, ahead blue); a thick box for the one
    who is attended to, a green one for who looks at the robot, a gray one for who is out of sight.
    Hands have their bones, and below the wrist whose left or right one it is and its shape.
    `gestures` are those of the last moment, written in the box of who made them.
    """
    canvas = np.ascontiguousarray(image).copy()
    if people is None:
        return canvas
    for person in people.persons:
        marks = _Marks(canvas, person)
        if marks.has_place:
            marks.draw_all(
                person.id == people.attended,
                [g.kind for g in gestures if g.person in (person.id, "")],
                has_landmarks,
            )
    return canvas


def draw_objects(image: Image, found: Sequence[FoundObject]) -> Image:
    """A copy of the picture with the outline, name and distance of each object."""
    canvas = np.ascontiguousarray(image).copy()
    size = _letter_size(canvas.shape[0])
    for one in found:
        corners = np.clip(np.rint(one.outline), -REACH, REACH).astype(np.int32)
        cv2.polylines(canvas, [corners], True, OBJECT, 2, cv2.LINE_AA)
        distance = "" if math.isnan(one.distance) else f" {one.distance:.2f} m"
        at = max(0, int(corners[:, 0].min())), max(12, int(corners[:, 1].min()) - 4)
        _write(canvas, one.name + distance, at, size, OBJECT)
    return canvas


def draw_blobs(image: Image, found: Sequence[ColorBlob]) -> Image:
    """A copy of the picture with the outline and name of each blob of a color."""
    canvas = np.ascontiguousarray(image).copy()
    size = _letter_size(canvas.shape[0])
    for one in found:
        corners = np.clip(np.rint(one.outline), -REACH, REACH).astype(np.int32)
        cv2.polylines(canvas, [corners], True, BLOB, 2, cv2.LINE_AA)
        at = max(0, int(corners[:, 0].min())), max(12, int(corners[:, 1].min()) - 4)
        _write(canvas, one.name, at, size, BLOB)
    return canvas


def draw_motion(image: Image, motion: Motion) -> Image:
    """A copy of the picture with an arrow for each cell that moves, and a box for each region."""
    canvas = np.ascontiguousarray(image).copy()
    rows, columns = motion.cells.shape[:2]
    across, down = canvas.shape[1] / max(1, columns), canvas.shape[0] / max(1, rows)
    steps = motion.cells * motion.elapsed
    moves = np.hypot(steps[..., 0], steps[..., 1]) >= 1
    if motion.confidence.size:
        moves &= motion.confidence > 0
    for row, column in np.argwhere(moves):
        start = np.array([(column + 0.5) * across, (row + 0.5) * down])
        ends = [
            np.clip(np.rint(end), -REACH, REACH).astype(int)
            for end in (start, start + steps[row, column] * ARROW)
        ]
        cv2.arrowedLine(canvas, ends[0], ends[1], MOVING, 1, cv2.LINE_AA)
    for one in motion.regions:
        corner = round(one.x - one.width / 2), round(one.y - one.height / 2)
        cv2.rectangle(canvas, (*corner, round(one.width), round(one.height)), MOVING, 2)
    return canvas


def draw_words(image: Image, words: str) -> Image:
    """A copy of the picture with a line of words at its lower left corner."""
    canvas = np.ascontiguousarray(image).copy()
    height = canvas.shape[0]
    _write(canvas, words, (6, height - 8), _letter_size(height), (255, 255, 255))
    return canvas


class _Marks:
    """The marks of one person."""

    def __init__(self, canvas: Image, person: Person) -> None:
        self._canvas, self._person = canvas, person
        self._size = _letter_size(canvas.shape[0])
        self._color = LOOKING if person.is_looking else CALM
        if not person.is_visible:
            self._color = HIDDEN

    @property
    def has_place(self) -> bool:
        """Whether there is a box that can be drawn."""
        box = self._box
        if box is None:
            return False
        edges = (box.x, box.y, box.width, box.height)
        return all(abs(edge) < REACH for edge in edges) and box.width >= SMALLEST_FACE

    def draw_all(self, is_attended: bool, gestures: Sequence[str], has_landmarks: bool) -> None:
        if has_landmarks and self._person.is_visible:
            self._draw_landmarks()
            for hand in self._person.hands:
                self._draw_hand(hand)
        self._draw_box(3 if is_attended else 1)
        if self._person.is_visible:
            self._draw_pose(self._person.pose)
        box = self._box
        assert box is not None
        line = round(32 * self._size)
        for row, kind in enumerate(gestures):
            at = (round(box.x), round(box.y + box.height + 20 * self._size) + (row + 1) * line)
            _write(self._canvas, kind, at, 1.4 * self._size, GESTURE)

    @property
    def _box(self) -> FaceBox | None:
        """Of the face, or of the body where only that is seen."""
        return self._person.pose.box or self._person.body

    def _draw_box(self, thickness: int) -> None:
        box = self._box
        assert box is not None
        corner = round(box.x), round(box.y)
        other = round(box.x + box.width), round(box.y + box.height)
        cv2.rectangle(self._canvas, corner, other, self._color, thickness, cv2.LINE_AA)
        at = corner[0], corner[1] - 6
        _write(self._canvas, words_of(self._person), at, self._size, self._color)
        if self._person.is_visible and self._person.has_face:
            at = corner[0], other[1] + round(16 * self._size)
            _write(self._canvas, pose_words(self._person.pose), at, 0.8 * self._size, self._color)

    def _draw_landmarks(self) -> None:
        points = self._person.landmarks
        if points is None:
            return
        height, width = self._canvas.shape[:2]
        flat = np.asarray(points, np.float64)[:, :2]
        inside = np.isfinite(flat).all(axis=1)
        inside &= (flat >= 0).all(axis=1) & (flat[:, 0] < width) & (flat[:, 1] < height)
        at = flat[inside].astype(int)
        self._canvas[at[:, 1], at[:, 0]] = self._color

    def _draw_hand(self, hand: Hand) -> None:
        flat = np.asarray(hand.landmarks, np.float64)[:, :2]
        if not np.isfinite(flat).all():
            return
        points = np.clip(np.rint(flat), -REACH, REACH).astype(np.int32)
        cv2.polylines(self._canvas, list(points[BONES]), False, HAND, 1, cv2.LINE_AA)
        for x, y in points.tolist():
            cv2.circle(self._canvas, (x, y), 2, HAND, -1, cv2.LINE_AA)
        x, y = points[0].tolist()
        words = f"{hand.side} {hand.shape}".strip()
        _write(self._canvas, words, (x, y + round(24 * self._size)), 0.8 * self._size, HAND)

    def _draw_pose(self, pose: HeadPose) -> None:
        """The head's own axes, as seen from the front and far away."""
        box = pose.box
        angles = (pose.pitch, pose.yaw, pose.roll)
        if box is None or not all(map(math.isfinite, angles)):
            return
        middle = box.x + box.width / 2, box.y + box.height / 2
        for axis, color in zip(head_axes(*angles), AXES, strict=True):
            tip = (
                round(middle[0] + axis[0] * box.width / 2),
                round(middle[1] + axis[1] * box.width / 2),
            )
            start = (round(middle[0]), round(middle[1]))
            cv2.arrowedLine(self._canvas, start, tip, color, 2, cv2.LINE_AA, tipLength=0.2)


def head_axes(pitch: float, yaw: float, roll: float) -> tuple[tuple[float, float], ...]:
    """The head's left, down and ahead in a picture of it, x right and y down, each at most 1 long.

    Angles in radians, as in `HeadPose`: first the roll, then pitch, then yaw about the upright.
    The person's left is at the right of the picture.
    """
    sin_p, cos_p = math.sin(pitch), math.cos(pitch)
    sin_y, cos_y = math.sin(yaw), math.cos(yaw)
    sin_r, cos_r = math.sin(roll), math.cos(roll)
    left = (cos_r * cos_y - sin_r * sin_p * sin_y, sin_r * cos_p)
    down = (-sin_r * cos_y - cos_r * sin_p * sin_y, cos_r * cos_p)
    ahead = (cos_p * sin_y, sin_p)
    return left, down, ahead


def words_of(person: Person) -> str:
    """The text above a person: "p1 1.2 m engaged"."""
    words = [person.name or person.id]
    if math.isfinite(person.distance):
        words.append(f"{person.distance:.1f} m")
    if not person.is_visible:
        return "  ".join([*words, "out of sight"])
    if not person.has_face:
        words.append("from behind")
    if person.engagement != "unengaged":
        words.append(person.engagement)
    return "  ".join(words)


def pose_words(pose: HeadPose) -> str:
    """The text below a person, in degrees: "pitch -3 yaw 12 roll 0"."""
    angles = {"pitch": pose.pitch, "yaw": pose.yaw, "roll": pose.roll}
    if not all(map(math.isfinite, angles.values())):
        return ""
    return " ".join(f"{name} {math.degrees(angle):.0f}" for name, angle in angles.items())


def _letter_size(height: int) -> float:
    return min(2.0, max(0.4, height / 900))


def _write(canvas: Image, words: str, at: Point, size: float, color: Color) -> None:
    """Letters with a dark rim, readable on anything, moved to where they are inside the picture.

    What the font lacks is written as `?`.
    """
    plain = words.encode("ascii", "replace").decode("ascii")
    (width, height), below = cv2.getTextSize(plain, FONT, size, 1)
    x = max(0, min(at[0], canvas.shape[1] - width))
    y = max(height, min(at[1], canvas.shape[0] - below))
    for shade, width in (((20, 20, 20), 3), (color, 1)):
        cv2.putText(canvas, plain, (x, y), FONT, size, shade, width, cv2.LINE_AA)
