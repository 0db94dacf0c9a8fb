"""Time to contact: drives toward photographs on a wall, at three speeds.

They are those in `../shared/vision/stills`, beside the project. The truth is the way that is left,
divided by the speed. A wall has no depth, and the camera does not shake: this does not prove how it
goes in a room.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import cv2
import numpy as np

from hri.bench.table import Row, amount, at_most, skipped
from hri.core import paths
from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still
from hri.vision.camera_view import CameraView
from hri.vision.motion.motion_finder import CameraMove, MotionFinder

STILLS = paths.house().parent / "shared" / "vision" / "stills"
PHOTOGRAPHS = ("coffee.png", "rocket.jpg", "2008_002470.jpg")
SPEEDS = (0.3, 0.6, 1.0)
"""Meters a second."""
START, END = 3.0, 1.0
"""Meters to the wall."""
RATE = 15.0
SIZE = (320, 240)
NOISE = 3.0
"""Standard deviation, of 255."""
LATE = 0.03


def rows(quick: bool) -> Iterator[Row]:
    """A row for each drive: how much later than the truth it says, in the median."""
    if not STILLS.is_dir():
        yield skipped("time to contact", "the photographs are not here")
        return
    for name in PHOTOGRAPHS[:1] if quick else PHOTOGRAPHS:
        picture = read_still(STILLS / name).image
        for speed in SPEEDS:
            late, unknown = _drive(picture, speed)
            yield (
                amount(
                    f"time to contact, {speed:g} m/s toward {name}: late by",
                    float(np.median(late)),
                    "share",
                    at_most(LATE),
                )
                | {"p90": round(float(np.quantile(late, 0.9)), 3), "unknown": unknown}
            )


def _drive(picture: Image, speed: float) -> tuple[list[float], int]:
    """Of each picture by how much it is late, as a share of the truth; and of how many nothing."""
    finder, noise = MotionFinder(CameraView()), np.random.default_rng(1)
    late, unknown = [], 0
    for index in range(math.ceil((START - END) / speed * RATE)):
        time = index / RATE
        away = START - speed * time
        grains = noise.normal(0, NOISE, (SIZE[1], SIZE[0], 3))
        image = np.clip(_seen(picture, away) + grains, 0, 255).astype(np.uint8)
        found = finder.look(image, time, CameraMove(x=speed * time), 0.0)
        if found is None:
            continue
        if math.isinf(found.time_to_contact):
            unknown += 1
        else:
            late.append(found.time_to_contact / (away / speed) - 1)
    return late, unknown


def _seen(picture: Image, away: float) -> Image:
    """The photograph from that many meters; at START it is a little wider than the picture."""
    height, width = picture.shape[:2]
    scale = 2 * START / away * SIZE[0] / width * 1.15
    place = np.array(
        [[scale, 0, SIZE[0] - scale * width / 2], [0, scale, SIZE[1] - scale * height / 2]]
    )
    large = cv2.warpAffine(picture, place, (2 * SIZE[0], 2 * SIZE[1]), flags=cv2.INTER_LINEAR)
    return np.asarray(cv2.resize(large, SIZE, interpolation=cv2.INTER_AREA), np.uint8)
