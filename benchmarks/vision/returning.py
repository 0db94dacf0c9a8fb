"""Who is who: someone leaves, and the same person or another one comes in a moment later.

The people are heads with shoulders out of the photographs in `../shared/vision/stills`, beside the
project, each moved, tilted, lit and colored differently each time. A photograph does not turn its
head, so this does not prove who is known again from the side.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.progress import progress
from benchmarks.vision.far_faces import GRAYS, HEIGHT, NOISE, WIDTH, Head, heads
from hri.bench.table import Row, at_least, share
from hri.bench.threads import one_thread
from hri.core.signals import FaceBox, Frame, Image
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.face_models import find_face_models
from hri.vision.tracking.people import PeopleTracker
from hri.vision.tracking.still import see_still

SEED = 541_000
PAIRS, QUICK_PAIRS = 60, 8
RIGHT = 0.95
"""Share of the pairs that must be right."""
RATE = 15.0
STAYS, WALKS, AWAY = 2.0, 0.5, (1.0, 4.0)
"""Seconds before the camera, of coming and of going, and out of the picture."""
SMALLEST = 60.0
"""Pixels of a face in a photograph."""
BREADTH = (75.0, 110.0)
"""Pixels of a face as it is shown: 1 to 1.5 m away."""
SHIFT = 64
"""Pixels by which the noise of two pictures may be shifted."""
ROLL, GAIN, TINT, SLOPE = 8.0, 0.25, 0.04, 0.2
"""Degrees to each side; parts of the brightness, of each color, and from one side to the other."""


@dataclass(frozen=True, eq=False)
class Showing:
    """How someone looks this time."""

    picture: Image
    x: float
    y: float

    def on(self, ground: Image, x: float, y: float) -> Image:
        """The picture with the middle of the face there, in pixels."""
        shift = np.array([[1, 0, x - self.x], [0, 1, y - self.y]], np.float32)
        size = WIDTH, HEIGHT
        moved = cv2.warpAffine(self.picture, shift, size)
        covers = cv2.warpAffine(np.full(self.picture.shape[:2], 255, np.uint8), shift, size)
        return np.where(covers[..., None] > 0, moved, ground)


def rows(quick: bool) -> Iterator[Row]:
    """All pairs, on one core; every other one is of two people."""
    find_face_models()
    detectors, count = load_detectors(), QUICK_PAIRS if quick else PAIRS
    with one_thread():
        people = alone(detectors)
        cases = progress(range(count), count, "someone leaves, someone comes")
        right = [is_right(detectors, people, number) for number in cases]
    told = {"the_same": sum(right[::2]), "another": sum(right[1::2])}
    what = "someone leaves, the same or another enters within 1 to 4 s: the right id"
    yield share(what, sum(right), count, at_least(RIGHT)) | told


def alone(detectors: Detectors) -> list[Head]:
    """The heads beside which no other one is: two would leave and come at a time."""
    return [
        head
        for head in heads(detectors)
        if head.breadth >= SMALLEST and len(see_still(detectors, head.picture).persons) == 1
    ]


def is_right(detectors: Detectors, people: Sequence[Head], number: int) -> bool:
    """Whether who enters has the id they should have: that of who left, or a new one."""
    lots = random.Random(SEED + number)
    grain = _grain(SEED + number)
    first, second = lots.sample(people, 2)
    is_same = number % 2 == 0
    tracker, ids = PeopleTracker(detectors), ["", ""]
    story = _story((first, first if is_same else second), lots)
    for index, (visit, picture, x, y) in enumerate(story):
        top, left = lots.randrange(SHIFT), lots.randrange(SHIFT)
        noise = grain[top : top + HEIGHT, left : left + WIDTH]
        frame = Frame(np.clip(picture + noise, 0, 255).astype(np.uint8), index / RATE, index)
        for person in tracker.see(frame).persons:
            # Others may stand beside them in the photograph.
            if person.is_visible and _covers(person.pose.box, x, y):
                ids[visit] = person.id
    return all(ids) and (ids[0] == ids[1]) == is_same


def _covers(box: FaceBox | None, x: float, y: float) -> bool:
    return box is not None and box.x <= x <= box.x + box.width and box.y <= y <= box.y + box.height


def _story(who: Sequence[Head], lots: random.Random) -> Iterator[tuple[int, Image, float, float]]:
    """The pictures, each with the number of its visit and the place of the face in it, pixels."""
    ground = np.full((HEIGHT, WIDTH, 3), lots.choice(GRAYS), np.uint8)
    for visit, head in enumerate(who):
        shown = showing(head, lots)
        x, y = lots.choice((0.3, 0.5, 0.7)) * WIDTH, lots.uniform(150, 220)
        for place in _walk(x, lots.random() < 0.5):
            yield visit, shown.on(ground, place, y), place, y
        for _ in range(round(lots.uniform(*AWAY) * RATE)):
            yield visit, ground, math.nan, math.nan


def _grain(seed: int) -> NDArray[np.int16]:
    """The noise of a camera, larger than a picture: each takes another part."""
    shape = HEIGHT + SHIFT, WIDTH + SHIFT, 3
    return np.rint(np.random.default_rng(seed).normal(0, NOISE, shape)).astype(np.int16)


def showing(head: Head, lots: random.Random) -> Showing:
    """A head in another light, a little nearer or farther, and tilted."""
    scale = lots.uniform(*BREADTH) / head.breadth
    height, width = head.picture.shape[:2]
    turn = cv2.getRotationMatrix2D((head.x, head.y), lots.uniform(-ROLL, ROLL), scale)
    turn = turn + np.array([[0, 0, head.x], [0, 0, head.y]]) * (scale - 1)
    size = round(width * scale), round(height * scale)
    turned = cv2.warpAffine(head.picture, turn, size, borderMode=cv2.BORDER_REPLICATE)
    tint = [lots.gauss(1, TINT) for _ in range(3)]
    slope = 1 + lots.uniform(-SLOPE, SLOPE) * np.linspace(-1, 1, size[0])[None, :, None]
    lit = turned * lots.uniform(1 - GAIN, 1 + GAIN) * tint * slope
    return Showing(np.clip(lit, 0, 255).astype(np.uint8), head.x * scale, head.y * scale)


def _walk(x: float, from_left: bool) -> Iterator[float]:
    """Where the face is in each picture: comes in, stays, trembles a little, and goes out."""
    outside = -0.2 * WIDTH if from_left else 1.2 * WIDTH
    steps, stays = round(WALKS * RATE), round(STAYS * RATE)
    for step in range(steps):
        yield outside + (x - outside) * step / steps
    for step in range(stays):
        yield x + 3 * np.sin(step / 3)
    for step in range(steps):
        yield x + (1.2 * WIDTH - x) * step / steps
