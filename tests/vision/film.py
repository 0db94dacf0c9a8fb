"""Films of the simulated person for the tests: what a camera with some noise would take."""

from collections.abc import Callable, Iterator

import numpy as np

from hri.core.signals import Frame, HeadGesture, HeadPose, Image
from hri.simulation.head import render_head
from hri.simulation.motion import Angles, idle_angles
from hri.vision.gesture import GestureRecognizer
from hri.vision.tracking import HeadFinder

Motion = Callable[[float], Angles]
"""The angles of the head at a time, on top of its idle sway."""
Place = Callable[[float], tuple[float, float]]
"""The middle of the head in pixels at a time."""

GRAIN = 2.5
"""Standard deviation of the noise, of 255."""


def still(time: float) -> Angles:
    return 0.0, 0.0, 0.0


def in_the_middle(time: float) -> tuple[float, float]:
    return 160.0, 120.0


def film(
    motion: Motion = still,
    duration: float = 3.0,
    rate: float = 15.0,
    height: float = 105.0,
    place: Place = in_the_middle,
    seed: int = 1,
) -> Iterator[Frame]:
    """Frames of 320x240 pixels."""
    sheet = np.random.default_rng(seed).normal(0, GRAIN, (256, 336, 3)).astype(np.float32)
    for index in range(round(duration * rate)):
        time = index / rate
        pitch, yaw, roll = (
            a + b for a, b in zip(motion(time), idle_angles(time, seed), strict=True)
        )
        image = render_head(pitch, yaw, roll, center=place(time), height=height)
        yield Frame(grainy(image, sheet, index), time, index)


def grainy(image: Image, sheet: np.ndarray, index: int) -> Image:
    down, right = index * 7 % 16, index * 5 % 16
    grain = sheet[down : down + image.shape[0], right : right + image.shape[1]]
    return np.clip(image + grain, 0, 255).astype(np.uint8)


def poses(frames: Iterator[Frame]) -> list[HeadPose]:
    finder = HeadFinder()
    return [pose for frame in frames if (pose := finder.see(frame)) is not None]


def gestures(frames: Iterator[Frame], prompted: bool = False) -> list[HeadGesture]:
    recognizer = GestureRecognizer()
    found = (recognizer.update(pose, prompted) for pose in poses(frames))
    return [gesture for gesture in found if gesture is not None]
