"""What motion and colors cost in a picture, on one core."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator

import cv2
import numpy as np

from hri.bench.figures import summary
from hri.bench.table import Row, amount, at_most
from hri.bench.threads import one_thread
from hri.core.signals import Image
from hri.vision.camera_view import CameraView
from hri.vision.color.color_mixture import ratio_table
from hri.vision.color.color_model import learn_color
from hri.vision.color.segmentation import ColorSegmenter
from hri.vision.motion.block_flow import BlockFlowFinder
from hri.vision.motion.motion_finder import CameraMove, MotionFinder

PICTURES, QUICK_PICTURES = 300, 60
COLORS = {"red": (200, 40, 36), "green": (40, 150, 60), "blue": (36, 84, 190)}
FLOW_MS, MOTION_MS, COLOR_MS = 5.0, 10.0, 2.0
SEED = 9
LIGHTS, WARMTH = 60, 0.12
"""Pictures of one turn of the light, and the part by which it becomes warmer and colder."""


def rows(quick: bool) -> Iterator[Row]:
    """Flow at 320x240, and three colors at 640x480 in a light that changes."""
    count = QUICK_PICTURES if quick else PICTURES
    with one_thread():
        yield _flow(count)
        yield _motion(count)
        yield _colors(count)


def _flow(count: int) -> Row:
    scene = _room(np.random.default_rng(SEED), (360, 280))
    gray = np.asarray(cv2.cvtColor(scene, cv2.COLOR_RGB2GRAY), np.uint8)
    views = [
        np.ascontiguousarray(gray[n % 7 : n % 7 + 240, 2 * n % 31 :][:, :320]) for n in range(8)
    ]
    finder = BlockFlowFinder()
    return _cost(
        "block flow at 320x240",
        lambda n: finder.between(views[n % 8], views[(n + 1) % 8]),
        count,
        FLOW_MS,
    )


def _motion(count: int) -> Row:
    scene = _room(np.random.default_rng(SEED), (700, 540))
    views = [np.ascontiguousarray(scene[:480, 5 * n : 5 * n + 640]) for n in range(8)]
    finder = MotionFinder(CameraView())

    def look(n: int) -> object:
        return finder.look(views[n % 8], n / 15, CameraMove(0.005 * n, 0.01 * n), 0.0)

    what = "what moves at 640x480, as seen by a robot that turns and drives"
    return _cost(what, look, count, MOTION_MS)


def _colors(count: int) -> Row:
    dice = np.random.default_rng(SEED)
    image = _room(dice, (640, 480))
    tables = {}
    for number, (name, color) in enumerate(COLORS.items()):
        center = 120 + 200 * number, 140 + 100 * number
        cv2.circle(image, center, 60, color, -1)
        box = center[0] - 30, center[1] - 30, 60, 60
        model = learn_color(name, [(image, [box])])
        tables[name] = ratio_table(model.color, model.background)
    views = [_lit(image, step / LIGHTS, dice) for step in range(LIGHTS)]
    segmenter = ColorSegmenter(tables)
    what = "three colors at 640x480"
    return _cost(what, lambda n: segmenter.segment(views[n % LIGHTS]), count, COLOR_MS)


def _lit(image: Image, turn: float, dice: np.random.Generator) -> Image:
    """The picture in another light, with the noise of a camera."""
    light = 1 + WARMTH * math.sin(math.tau * turn) * np.array([1, 0, -1])
    return np.clip(image * light + dice.normal(0, 5, image.shape), 0, 255).astype(np.uint8)


def _cost(what: str, job: Callable[[int], object], count: int, limit: float) -> Row:
    job(0)
    times = []
    for number in range(1, count + 1):
        begun = time.thread_time()
        job(number)
        times.append((time.thread_time() - begun) * 1e3)
    figures = summary(times, 2)
    return amount(what, figures["median"], "ms", at_most(limit), p95=figures["p95"])


def _room(dice: np.random.Generator, size: tuple[int, int]) -> Image:
    image = np.full((size[1], size[0], 3), (150, 145, 135), np.uint8)
    for _ in range(60):
        corners = dice.integers(-20, max(size) + 20, (4, 2)).astype(np.int32)
        gray = int(dice.integers(60, 220))
        cv2.fillPoly(image, [corners], (gray, gray, gray - 20), cv2.LINE_AA)
    return np.asarray(cv2.GaussianBlur(image, (0, 0), 1.0), np.uint8)
