"""Pictures in which labels stand."""

import math

import cv2
import numpy as np

from hri.vision.camera_view import CameraView
from hri.vision.objects.cutout import whole
from hri.vision.objects.learning import view_of
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.printed_label import SIZE, WIDTH, printed_label

VIEW = CameraView(1.05)


def learned(*names, method=SIFT) -> ModelSet:
    """A set of labels, each from one view."""
    labels = [(name, printed_label(name)) for name in names]
    return ModelSet(
        method,
        tuple(
            ObjectModel(name, (view_of(label, whole(label), method, WIDTH / SIZE, "a test"),))
            for name, label in labels
        ),
    )


def room(seed=0, size=(640, 480)):
    """Walls and furniture, of soft shapes."""
    dice = np.random.default_rng(seed)
    picture = np.full((size[1], size[0], 3), dice.integers(90, 200, 3), np.uint8)
    for _ in range(25):
        corners = dice.integers(-50, 700, (4, 2))
        color = [int(part) for part in dice.integers(40, 220, 3)]
        cv2.fillPoly(picture, [cv2.convexHull(corners.astype(np.int32))], color, cv2.LINE_AA)
    return cv2.GaussianBlur(picture, (0, 0), 1.0)


def standing(name, distance, x=0.0, y=0.0, tilt=0.0, roll=0.0, image=None):
    """A label at a place, meters to the right and below of the axis, in a picture of `VIEW`."""
    image = room() if image is None else image
    size = image.shape[1], image.shape[0]
    focal = VIEW.focal_length(size)
    turn = cv2.Rodrigues(np.array([0.0, tilt, 0.0]))[0] @ cv2.Rodrigues(np.array([0, 0, roll]))[0]
    scale = WIDTH / SIZE
    flat = np.array([[scale, 0, -WIDTH / 2], [0, scale, -WIDTH / 2], [0, 0, 1]])
    camera = np.array([[focal, 0, size[0] / 2], [0, focal, size[1] / 2], [0, 0, 1]])
    place = camera @ np.c_[turn[:, 0], turn[:, 1], (x, y, distance)] @ flat
    return cv2.warpPerspective(
        printed_label(name), place, size, image.copy(), cv2.INTER_AREA, cv2.BORDER_TRANSPARENT
    )


def noisy(image, seed=0, deviation=6.0):
    noise = np.random.default_rng(seed).normal(0, deviation, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8)


def away(distance, x=0.0, y=0.0) -> float:
    return math.hypot(distance, x, y)
