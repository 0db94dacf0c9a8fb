import itertools
import math

import numpy as np
import pytest

from hri.core.signals import Frame
from hri.simulation.motion import Angles, nod_angles, shake_angles
from hri.vision.tracking import HeadFinder
from tests.vision.film import Motion, film, gestures, poses


def nod(time: float) -> Angles:
    return nod_angles(time - 1.0)


def shake(time: float) -> Angles:
    return shake_angles(time - 1.0)


@pytest.mark.parametrize(("motion", "axis"), [(nod, 0), (shake, 1)])
def test_the_angles_follow_those_of_the_head(motion: Motion, axis: int) -> None:
    seen = poses(film(motion, rate=30))
    angles = np.array([(pose.pitch, pose.yaw)[axis] for pose in seen])
    truth = np.array([motion(pose.time)[axis] for pose in seen])
    assert np.corrcoef(angles, truth)[0, 1] > 0.97
    assert truth @ angles / (truth @ truth) == pytest.approx(1.0, abs=0.15)
    assert np.abs([(pose.yaw, pose.pitch)[axis] for pose in seen]).max() < math.radians(4)


GESTURES = [
    (kind, small + (wide - small) * part, hertz, height, rate)
    for (kind, small, wide), (part, hertz, height), rate in itertools.product(
        [("nod", 6, 10), ("shake", 10, 18)],
        [(0.0, 1.2, 105), (0.0, 2.5, 80), (1.0, 1.2, 160), (1.0, 2.5, 105), (0.5, 1.8, 70)],
        [15, 30],
    )
]


def test_nods_and_shakes_are_recognized_in_the_pictures() -> None:
    missed = []
    for seed, (kind, degrees, hertz, height, rate) in enumerate(GESTURES):
        angles = nod_angles if kind == "nod" else shake_angles
        frames = film(
            lambda t, angles=angles, degrees=degrees, hertz=hertz: angles(
                t - 0.7, amplitude=math.radians(degrees), frequency=hertz
            ),
            duration=0.7 + 2 / hertz + 0.2,
            rate=rate,
            height=height,
            seed=seed,
        )
        if [gesture.kind for gesture in gestures(frames, prompted=True)] != [kind]:
            missed.append((kind, degrees, hertz, height, rate))
    assert len(missed) <= len(GESTURES) // 20, missed


def test_a_head_at_rest_and_one_that_looks_around_make_no_gesture() -> None:
    def look_around(time: float) -> Angles:
        phase = time % 4
        part = min(1.0, max(0.0, min(phase - 1, 3 - phase) / 0.45))
        down = time > 8
        return math.radians(18) * part * down, math.radians(25) * part * (not down), 0.0

    assert gestures(film(look_around, duration=16), prompted=True) == []


def test_walking_through_the_picture_makes_no_gesture() -> None:
    def walk(time: float) -> tuple[float, float]:
        return -80 + 160 * time, 120 + 4 * math.sin(2 * math.pi * 1.8 * time)

    seen = list(film(duration=3, place=walk))
    assert len(poses(iter(seen))) > 10
    assert gestures(iter(seen), prompted=True) == []


def test_losing_and_finding_a_face_makes_no_gesture() -> None:
    def jump(time: float) -> tuple[float, float]:
        away = 1.0 < time % 2 < 1.5
        return (900.0, 120.0) if away else (120.0 + 30 * (time // 2 % 3), 120.0)

    seen = list(film(duration=9, place=jump))
    found = poses(iter(seen))
    assert 40 < len(found) < len(seen) * 0.75
    assert gestures(iter(seen), prompted=True) == []


def test_the_box_is_in_pixels_of_the_frame() -> None:
    finder, pose = HeadFinder(), None
    for frame in film(duration=1):
        large = frame.image.repeat(2, axis=0).repeat(2, axis=1)
        pose = finder.see(Frame(large, frame.time, frame.sequence)) or pose
    assert pose is not None
    assert pose.box is not None
    assert pose.box.x + pose.box.width / 2 == pytest.approx(320, abs=12)
    assert pose.box.width == pytest.approx(2 * 0.74 * 105, rel=0.15)


def test_frames_that_are_no_pictures_are_passed_over() -> None:
    good = list(film(nod, duration=2))
    broken = [
        odd
        for frame in good
        for odd in (
            frame,
            Frame(np.zeros((1, 1, 3), np.uint8), frame.time + 0.01, 0),
            Frame(frame.image[..., 0], frame.time + 0.01, 0),
            Frame(frame.image.astype(np.uint16), frame.time + 0.01, 0),
            Frame(frame.image, math.nan, 0),
        )
    ]
    assert poses(iter(broken)) == poses(iter(good))


def test_other_sizes_and_times_that_jump_only_cost_the_face() -> None:
    frames = list(film(duration=1))
    odd = [
        Frame(np.zeros((2160, 3840, 3), np.uint8), 2.0, 0),
        Frame(np.zeros((32, 400, 3), np.uint8), 2.1, 0),
        *(Frame(f.image, f.time - 50, f.sequence) for f in frames),
    ]
    seen = poses(iter([*frames, *odd]))
    assert seen[-1].time == frames[-1].time - 50
    assert gestures(iter([*frames, *odd]), prompted=True) == []
