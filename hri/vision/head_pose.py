"""How a head is turned: the rotation that leads from an average face to the points of its mesh.

The rotation is the least-squares one of Kabsch, "A solution for the best rotation to relate two
sets of vectors" (1976), without regard to place and size. It uses points of skull, nose and
cheekbones, which speech and smiles hardly move, and is half as noisy as a line from chin to
forehead.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Landmarks

Points = NDArray[np.float64]

MIDDLE = {
    10: (-0.572, 0.226),
    151: (-0.402, 0.245),
    9: (-0.226, 0.251),
    8: (-0.133, 0.230),
    168: (-0.051, 0.224),
    6: (0.039, 0.265),
    197: (0.123, 0.313),
    195: (0.199, 0.366),
    5: (0.282, 0.422),
    4: (0.382, 0.441),
    1: (0.453, 0.414),
    2: (0.497, 0.236),
    94: (0.494, 0.288),
}
"""Points between the halves of the face: y down and z toward the camera, in distances of the outer
corners of the eyes. Here and below as the network fits them to a face that looks at the camera (the
photograph "astronaut" of NASA, in four sizes, the halves averaged)."""
SIDES = {
    (33, 263): (-0.500, -0.015, -0.018),
    (133, 362): (-0.191, 0.013, 0.040),
    (127, 356): (-0.751, 0.018, -0.538),
    (234, 454): (-0.738, 0.167, -0.600),
    (93, 323): (-0.724, 0.320, -0.619),
    (116, 345): (-0.682, 0.149, -0.165),
    (117, 346): (-0.569, 0.142, -0.033),
    (50, 280): (-0.551, 0.297, 0.021),
    (123, 352): (-0.687, 0.277, -0.159),
    (98, 327): (-0.207, 0.439, 0.155),
    (54, 284): (-0.651, -0.381, -0.130),
    (103, 332): (-0.549, -0.477, 0.010),
    (67, 297): (-0.387, -0.539, 0.136),
    (109, 338): (-0.211, -0.567, 0.208),
    (193, 417): (-0.085, -0.039, 0.178),
    (122, 351): (-0.062, 0.056, 0.238),
    (162, 389): (-0.744, -0.138, -0.416),
    (21, 251): (-0.712, -0.263, -0.268),
}
"""Points of the person's right half, and their mirrored ones of the left: x to the right of the
picture, y, z."""
PITCH_GAIN = 0.93
"""Share of a nod that the rotation shows, on average: 0.92 of that of a photograph on a turned
surface, 0.82 to 1.06 of those of drawn heads."""


def _average_face() -> tuple[list[int], Points]:
    """The numbers of the points, and where they are in the average face, around its middle."""
    rows = {number: (0.0, y, z) for number, (y, z) in MIDDLE.items()}
    for (right, left), (x, y, z) in SIDES.items():
        rows[right], rows[left] = (x, y, z), (-x, y, z)
    places = np.array(list(rows.values()))
    return list(rows), places - places.mean(axis=0)


NUMBERS, FACE = _average_face()


def head_pose(landmarks: Landmarks) -> tuple[float, float, float]:
    """Pitch (down), yaw (to the person's left) and roll (to their left shoulder), radians.

    About 0 for a face that looks at the camera: some degrees are a matter of each one's face. All
    NaN when a landmark is not finite.
    """
    points = landmarks[NUMBERS].astype(np.float64) * (1, 1, -1)
    if not np.isfinite(points).all():
        return math.nan, math.nan, math.nan
    left, _, right = np.linalg.svd((points - points.mean(axis=0)).T @ FACE)
    upright = np.diag((1.0, 1.0, np.sign(np.linalg.det(left @ right))))
    rotation = left @ upright @ right
    pitch = math.atan2(-rotation[2, 1], rotation[2, 2])
    yaw = math.asin(min(1.0, max(-1.0, -rotation[2, 0])))
    return pitch / PITCH_GAIN, yaw, math.atan2(rotation[1, 0], rotation[0, 0])
