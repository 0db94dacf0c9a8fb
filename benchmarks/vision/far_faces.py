"""Faces across a room: how many are found at which distance, in one still picture each.

The heads are those of the photographs in `../shared/vision/stills`, beside the project, as far as a
face there is at least 45 pixels high; each is made as small as it would be in a common webcam's
picture, and put somewhere before a plain ground or a photograph without people, with the noise of a
camera. That does not prove anything about light, blur and motion in a real room.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from benchmarks.progress import progress
from hri.bench.figures import summary
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still
from hri.vision.camera_view import CameraView
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.detectors.mesh import MARGIN, region_of_landmarks
from hri.vision.face_models import find_face_models
from hri.vision.tracking.still import SeenStill, see_still

SEED = 540_000
FOUND = {2: 0.98, 3: 0.95, 4: 0.90, 5: 0.60}
"""Share of the faces, by meters."""
SIZE = WIDTH, HEIGHT = 640, 480
SMALLEST = 45.0
"""Pixels of a face in a photograph; none is made larger."""
SEEN_SIDE = 800
"""Pixels of the longer side of a photograph in which heads are looked for."""
FACE_HEIGHT = 0.178
"""Meters from chin to hairline, of an adult."""
AROUND = (1.3, 1.0, 2.2)
"""Sizes of the face that belong to a head with its shoulders: to each side, above and below its
middle."""
NOISE = 3.0
GRAYS = ((150, 150, 145), (90, 100, 110), (200, 190, 180))
EMPTY = ("brick.png", "chelsea.png", "coffee.png", "coins.png", "rocket.jpg")
"""Photographs without people."""
EMPTY_PICTURES, QUICK_PICTURES = 100, 10


@dataclass(frozen=True, eq=False)
class Head:
    """A head and shoulders, cut out of a photograph."""

    picture: Image
    x: float
    """Of the middle of its face, pixels."""
    y: float
    breadth: float
    """From chin to hairline, pixels."""

    def before(self, ground: Image, meters: float, draw: np.random.Generator) -> Placed:
        """Somewhere in a picture, at a distance."""
        focal = WIDTH / 2 / math.tan(CameraView().field_of_view / 2)
        scale = FACE_HEIGHT * focal / meters / self.breadth
        height, width = self.picture.shape[:2]
        size = min(WIDTH, max(2, round(width * scale))), min(HEIGHT, max(2, round(height * scale)))
        small = cv2.resize(self.picture, size, interpolation=cv2.INTER_AREA)
        left = int(draw.integers(0, WIDTH - size[0] + 1))
        top = int(draw.integers(0, HEIGHT - size[1] + 1))
        picture = ground.copy()
        picture[top : top + size[1], left : left + size[0]] = small
        place = left + self.x * scale, top + self.y * scale
        return Placed(noisy(picture, draw), place, self.breadth * scale)


@dataclass(frozen=True, eq=False)
class Placed:
    """A picture with one face, and where that is."""

    picture: Image
    place: tuple[float, float]
    breadth: float

    def distances(self, seen: SeenStill) -> list[float]:
        """The distances, in meters, of those who are seen there."""
        return [
            person.distance
            for person in seen.persons
            if (box := person.pose.box) is not None
            and math.dist((box.x + box.width / 2, box.y + box.height / 2), self.place)
            < 0.5 * self.breadth
        ]


def rows(quick: bool) -> Iterator[Row]:
    """All of them, on one core."""
    find_face_models()
    detectors = load_detectors()
    with one_thread():
        found = list(heads(detectors))
        plain = [np.full((HEIGHT, WIDTH, 3), gray, np.uint8) for gray in GRAYS]
        for name, grounds in (("plain", plain), ("busy", [_read(file) for file in EMPTY])):
            for meters, least in FOUND.items():
                yield _at(detectors, found, name, grounds, meters, least)
        yield _false(detectors, QUICK_PICTURES if quick else EMPTY_PICTURES)


def heads(detectors: Detectors) -> Iterator[Head]:
    """Those of the photographs whose faces are large enough."""
    assert detectors.mesh is not None
    for path in sorted(_folder().glob("*.jpg")):
        image = photograph(path.name)
        shrink = min(1.0, SEEN_SIDE / max(image.shape[:2]))
        size = round(image.shape[1] * shrink), round(image.shape[0] * shrink)
        image = np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)
        for person in see_still(detectors, image).persons:
            if person.landmarks is None:
                continue
            region = region_of_landmarks(person.landmarks)
            breadth = region.side / MARGIN
            if breadth >= SMALLEST:
                yield _cut(image, region.x, region.y, breadth)


def noisy(picture: Image, draw: np.random.Generator) -> Image:
    """With the noise of a camera."""
    return np.clip(picture + draw.normal(0, NOISE, picture.shape), 0, 255).astype(np.uint8)


def _at(
    detectors: Detectors,
    found: Sequence[Head],
    name: str,
    grounds: Sequence[Image],
    meters: float,
    least: float,
) -> Row:
    """How many heads are seen before some grounds, and how far away."""
    draw = np.random.default_rng(SEED + int(10 * meters))
    hits, errors, spent = 0, [], []
    for number, head in enumerate(progress(found, len(found), f"{name}, {meters:g} m")):
        placed = head.before(grounds[number % len(grounds)], meters, draw)
        begun = time.thread_time()
        distances = placed.distances(see_still(detectors, placed.picture))
        spent.append((time.thread_time() - begun) * 1e3)
        hits += bool(distances)
        errors += [abs(distance / meters - 1) for distance in distances if math.isfinite(distance)]
    told = {"distance_error_median": round(float(np.median(errors or [math.nan])), 3)}
    row = share(f"a face at {meters:g} m, {name} ground", hits, len(found), at_least(least))
    return row | told | {"cpu_ms": summary(spent)}


def _false(detectors: Detectors, count: int) -> Row:
    """People who are seen in parts of pictures without any."""
    draw = np.random.default_rng(SEED)
    pictures = [photograph(name) for name in EMPTY]
    seen = 0
    for number in progress(range(count), count, "empty pictures"):
        whole = pictures[number % len(pictures)]
        height, width = whole.shape[:2]
        tall = int(min(height, 0.75 * width) * draw.uniform(0.4, 1.0))
        wide = int(tall / 0.75)
        top, left = (int(draw.integers(0, rest + 1)) for rest in (height - tall, width - wide))
        part = cv2.resize(whole[top : top + tall, left : left + wide], SIZE)
        seen += len(see_still(detectors, noisy(np.asarray(part, np.uint8), draw)).persons)
    return amount("seen in pictures without people", seen, "people", at_most(0), pictures=count)


def _cut(image: Image, x: float, y: float, breadth: float) -> Head:
    aside, above, below = (part * breadth for part in AROUND)
    left, top = max(0, round(x - aside)), max(0, round(y - above))
    part = image[top : round(y + below), left : round(x + aside)]
    return Head(part, x - left, y - top, breadth)


def _read(name: str) -> Image:
    return np.asarray(cv2.resize(photograph(name), SIZE, interpolation=cv2.INTER_AREA), np.uint8)


def photograph(name: str) -> Image:
    """Raises NotAvailable where there are no photographs."""
    return read_still(_folder() / name).image


def photographs() -> list[str]:
    """Names of all; none shows a marker."""
    return sorted(path.name for path in _folder().iterdir() if path.suffix in (".jpg", ".png"))


def _folder() -> Path:
    folder = paths.house().parent / "shared" / "vision" / "stills"
    if not folder.is_dir():
        raise NotAvailable(f"{folder}: no such folder - it has the photographs")
    return folder
