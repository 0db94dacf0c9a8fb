"""Markers: how many are found, how well their place and turn are known, and how many are false.

Beside ours the detector of OpenCV as it is by default, which gets the same pictures.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np

from benchmarks.progress import progress
from benchmarks.vision.far_faces import EMPTY, noisy, photograph, photographs
from benchmarks.vision.marker_scenes import (
    FOCAL,
    HEIGHT,
    SIDE,
    SIZE,
    WIDTH,
    Condition,
    Shown,
    grounds,
    shown,
)
from hri.bench.figures import summary
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.core.geometry import ROBOT_FROM_CAMERA, Matrix
from hri.core.signals import Image, Marker
from hri.vision.markers.families import DEFAULT, FAMILIES, Family
from hri.vision.markers.marker_pose import square_pose
from hri.vision.markers.marker_reader import MarkerReader

SEED = 730_000
"""Of the figures; nothing was tuned on these pictures."""
FOUND, AWAY, TURNED = 0.95, 0.03, 3.0
"""What the figures must reach: share found, 95th percentile of the error of the distance, median
error of the normal in degrees."""
UPRIGHT = (0.0, 30.0)
CONDITIONS = {
    "34 px, up to 30 degrees": Condition(tilt=UPRIGHT),
    "34 px, 45 degrees (24 px seen)": Condition(tilt=(45, 45)),
    "34 px, 60 degrees (17 px seen)": Condition(tilt=(60, 60)),
    "34 px, up to 30 degrees, blur of 1 px": Condition(tilt=UPRIGHT, blur=1.0),
    "34 px, up to 30 degrees, blur of 1.5 px": Condition(tilt=UPRIGHT, blur=1.5),
    "34 px, up to 30 degrees, half in shadow": Condition(tilt=UPRIGHT, is_shaded=True),
    "34 px, up to 60 degrees, blur, shadow": Condition(tilt=(0, 60), blur=1.0, is_shaded=True),
    "34 px, 60 degrees, blur, shadow": Condition(tilt=(60, 60), blur=1.0, is_shaded=True),
    "facing the camera, 34 px, blur, shadow": Condition(blur=1.0, is_shaded=True),
    "24 px, up to 60 degrees, shadow": Condition(24.0, (0, 60), is_shaded=True),
}
LIMITED = "34 px, up to 60 degrees, blur, shadow"
"""The condition in which all families are measured."""
MARKERS, QUICK = 200, 20
EMPTY_PICTURES, QUICK_EMPTY = 300, 30


@dataclass
class Tally:
    """What came out in one condition."""

    found: int = 0
    wrong: int = 0
    """Markers that are not there."""
    away: list[float] = field(default_factory=list)
    """Errors of the distance, parts of it."""
    turned: list[float] = field(default_factory=list)
    """Errors of the normal, degrees."""
    sure: list[float] = field(default_factory=list)
    """The same, of those whose tilt was said to be sure."""
    spent: list[float] = field(default_factory=list)
    """Milliseconds."""


def rows(quick: bool) -> Iterator[Row]:
    """All of them, on one core."""
    count = QUICK if quick else MARKERS
    with one_thread():
        behind = grounds([photograph(name) for name in EMPTY])
        for name, family in FAMILIES.items():
            for condition in CONDITIONS if name == DEFAULT else [LIMITED]:
                yield from _under(family, condition, behind, count)
        yield _false(QUICK_EMPTY if quick else EMPTY_PICTURES)


def _under(family: Family, name: str, behind: Sequence[Image], count: int) -> Iterator[Row]:
    """Ours and OpenCV's, on the same pictures."""
    reader = MarkerReader([family.name], SIDE)
    plain = cv2.aruco.ArucoDetector(family.dictionary)
    own, other = Tally(), Tally()
    draw = np.random.default_rng([SEED, sum(name.encode()), family.number])
    for number in progress(range(count), count, f"{family.name}, {name}"):
        id = int(draw.integers(family.count))
        scene = shown(family, id, behind[number % len(behind)], CONDITIONS[name], draw)
        _ours(reader, scene, own)
        _peer(plain, scene, other)
    is_judged = "34 px" in name
    what = f"{family.name}, {name}"
    row = share(f"found: {what}", own.found, count, at_least(FOUND) if is_judged else None)
    peer = {"opencv_found": round(other.found / count, 3), "opencv_wrong": other.wrong}
    yield (
        row
        | {"wrong": own.wrong}
        | peer
        | {"cpu_ms": summary(own.spent)}
        | {"opencv_cpu_ms": summary(other.spent)}
    )
    if own.found:
        limits = (at_most(AWAY), at_most(TURNED)) if is_judged else (None, None)
        yield amount(
            f"distance: {what}", float(np.percentile(own.away, 95)), "of it, p95", limits[0],
            median=_part(own.away, 50), opencv_95=_part(other.away, 95),
            opencv_median=_part(other.away, 50),
        )  # fmt: skip
        yield amount(
            f"normal: {what}", float(np.median(own.turned)), "degrees, median", limits[1],
            p95=_part(own.turned, 95), sure=len(own.sure), sure_p95=_part(own.sure, 95),
            opencv_median=_part(other.turned, 50), opencv_95=_part(other.turned, 95),
        )  # fmt: skip


def _ours(reader: MarkerReader, scene: Shown, tally: Tally) -> None:
    begun = time.thread_time()
    markers = reader.find(scene.picture)
    tally.spent.append((time.thread_time() - begun) * 1e3)
    right = [one for one in markers if _is_it(one, scene)]
    tally.wrong += len(markers) - len(right)
    if right:
        tally.found += 1
        normal = ROBOT_FROM_CAMERA.T @ right[0].facing
        _note(tally, scene, right[0].distance, normal)
        if right[0].is_sure:
            tally.sure.append(tally.turned[-1])


def _peer(detector: cv2.aruco.ArucoDetector, scene: Shown, tally: Tally) -> None:
    begun = time.thread_time()
    gray = cv2.cvtColor(scene.picture, cv2.COLOR_RGB2GRAY)
    outlines, ids, _ = detector.detectMarkers(gray)
    tally.spent.append((time.thread_time() - begun) * 1e3)
    is_found = False
    for outline, id in zip(outlines, np.ravel([] if ids is None else ids), strict=True):
        corners = np.asarray(outline, np.float64).reshape(4, 2) + 0.5
        if id != scene.id or np.abs(corners.mean(axis=0) - _middle(scene)).max() > 5:
            tally.wrong += 1
        elif not is_found and (pose := square_pose(corners, FOCAL, SIZE)) is not None:
            is_found = True
            tally.found += 1
            away = float(np.linalg.norm(pose.place)) * SIDE
            _note(tally, scene, away, pose.rotation[:, 2])


def _note(tally: Tally, scene: Shown, away: float, normal: Matrix) -> None:
    tally.away.append(abs(away / float(np.linalg.norm(scene.place)) - 1))
    cosine = float(normal @ scene.rotation[:, 2])
    tally.turned.append(math.degrees(math.acos(min(1.0, max(-1.0, cosine)))))


def _is_it(one: Marker, scene: Shown) -> bool:
    return one.id == scene.id and math.dist((one.x, one.y), _middle(scene)) < 5


def _middle(scene: Shown) -> tuple[float, float]:
    x, y, away = scene.place.tolist()
    return FOCAL * x / away + WIDTH / 2, FOCAL * y / away + HEIGHT / 2


def _false(count: int) -> Row:
    """Markers that are seen in parts of photographs without any, of all families."""
    draw = np.random.default_rng(SEED)
    readers = MarkerReader(list(FAMILIES))
    plain = [cv2.aruco.ArucoDetector(family.dictionary) for family in FAMILIES.values()]
    pictures = [photograph(name) for name in photographs()]
    seen = other = 0
    for number in progress(range(count), count, "pictures without markers"):
        whole = pictures[number % len(pictures)]
        height, width = whole.shape[:2]
        tall = int(min(height, 0.75 * width) * draw.uniform(0.3, 1.0))
        wide = int(tall / 0.75)
        top, left = (int(draw.integers(0, rest + 1)) for rest in (height - tall, width - wide))
        part = cv2.resize(whole[top : top + tall, left : left + wide], SIZE)
        picture = noisy(np.asarray(part, np.uint8), draw)
        seen += len(readers.find(picture))
        gray = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY)
        other += sum(len(detector.detectMarkers(gray)[0]) for detector in plain)
    what = "markers in pictures without any, of all families"
    return amount(what, seen, "markers", at_most(0), pictures=count, opencv=other)


def _part(values: Sequence[float], percent: float) -> float | None:
    return round(float(np.percentile(values, percent)), 5) if values else None
