"""Learned objects: how many are found, how many mistaken, how far away, and at what cost."""

from __future__ import annotations

import resource
import tempfile
import time
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np

from benchmarks.progress import progress
from benchmarks.vision.object_scenes import (
    MOVING,
    SIZE,
    SMEAR,
    USUAL,
    VIEW,
    Conditions,
    Scene,
    by_distance,
    by_height,
    film,
)
from benchmarks.vision.plain_matching import PlainMatching
from benchmarks.vision.stamps import Stamp, generated, is_solid, read_stamps
from hri.bench.figures import summary
from hri.bench.table import Limit, Row, amount, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.core.signals import FoundObject
from hri.vision.objects.learning import scale_from_width, view_of
from hri.vision.objects.local_features import ORB, SIFT
from hri.vision.objects.model_file import load_models, save_models
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.object_presence import ObjectPresence
from hri.vision.objects.plain_objects import is_colorful
from hri.vision.objects.recognizer import ObjectRecognizer

SEED = 230_000
SCENES, QUICK_SCENES = 300, 40
HEIGHT = 0.3
"""Of the picture, the longer side of a thing."""
WIDTH = 0.3
"""Meters, the longer side of a thing."""
RECALL = {1: 0.99, 100: 0.95, 250: 0.92}
"""By the number of objects in the set."""
SETS_OF_ONE = 20
RECALL_OF_1000, WRONG = 0.85, 0.005
ORB_OBJECTS, TIMED = 10, 100
PLAIN_OBJECTS, NOT_MISTAKEN, MISTAKEN = 10, 0.8, 0.03
MS = {SIFT: 120.0, ORB: 40.0}
LEARNING_S = 1.0
FILM_S, QUICK_FILM_S, RATE = 600.0, 60.0, 5.0
"""Seconds of film, and pictures of it a second, as many as are looked at."""
DISTANCES, DISTANCE_ERROR = (0.3, 0.5, 1.0, 1.5, 2.0), 0.05


def rows(quick: bool) -> Iterator[Row]:
    """All of them, on one core, seen from a camera that is 1.05 rad wide."""
    scenes = QUICK_SCENES if quick else SCENES
    with one_thread():
        yield from _recall(scenes)
        yield from _recall_of_1000(scenes)
        yield from _without_texture(SETS_OF_ONE if quick else scenes // PLAIN_OBJECTS)
        yield from _unknown(QUICK_FILM_S if quick else FILM_S)
        yield from _cost(min(scenes, 100))
        yield from _distance(scenes // 5)


@lru_cache(maxsize=1)
def _textured_and_others() -> tuple[list[Stamp], list[Stamp]]:
    return read_stamps()


def _stamps() -> list[Stamp]:
    return _textured_and_others()[0]


def _learned(stamps: Sequence[Stamp], method: str = SIFT) -> ModelSet:
    models = [
        ObjectModel(stamp.name, (view_of(stamp.picture, stamp.outline, method, _scale(stamp)),))
        for stamp in progress(stamps, len(stamps), "learning")
    ]
    return ModelSet(method, tuple(models))


def _scale(stamp: Stamp) -> float:
    return WIDTH / int(max(stamp.picture.shape[:2]))


def _scenes(
    stamps: Sequence[Stamp], count: int, seed: int, conditions: Conditions = USUAL
) -> Iterator[Scene]:
    dice = np.random.default_rng(SEED + seed)
    for _ in range(count):
        yield by_height(stamps[int(dice.integers(len(stamps)))], HEIGHT, dice, conditions)


def _is_right(scene: Scene, found: Sequence[FoundObject]) -> bool:
    return any(one.name == scene.stamp.name and scene.shows(one.x, one.y) for one in found)


def _is_wrong(scene: Scene, found: Sequence[FoundObject]) -> bool:
    return any(one.name != scene.stamp.name for one in found)


def _recall(count: int) -> Iterator[Row]:
    """By the number of objects in the set, with the wrong names; and by plain matching."""
    wrong = 0
    for objects, limit in RECALL.items():
        right = mistaken = 0
        sets = SETS_OF_ONE if objects == 1 else 1
        for number in range(sets):
            stamps = _stamps()[number : number + objects]
            recognizer = ObjectRecognizer(_learned(stamps), VIEW)
            scenes = list(_scenes(stamps, count // sets, 1000 * number + objects))
            for scene in progress(scenes, len(scenes), f"{objects} objects"):
                found = recognizer.recognize(scene.image)
                right += _is_right(scene, found)
                mistaken += _is_wrong(scene, found)
        wrong += mistaken
        total = sets * (count // sets)
        yield _share(f"{objects} in the set: recall", right, total, at_least(limit), mistaken)
        if objects == TIMED:
            yield _plain(stamps, scenes)
            yield _moving(recognizer, stamps, count)
    yield share("wrong names, all of these", wrong, count * len(RECALL), at_most(WRONG))


def _moving(recognizer: ObjectRecognizer, stamps: Sequence[Stamp], count: int) -> Row:
    right = wrong = 0
    for scene in _scenes(stamps, count, 3, MOVING):
        found = recognizer.recognize(scene.image)
        right, wrong = right + _is_right(scene, found), wrong + _is_wrong(scene, found)
    what = f"{len(stamps)} in the set, moving by up to {SMEAR - 1} pixels a picture: recall"
    return _share(what, right, count, None, wrong)


def _share(what: str, right: int, count: int, limit: Limit | None, wrong: int) -> Row:
    return share(what, right, count, limit) | {"wrong_names": wrong}


def _plain(stamps: Sequence[Stamp], scenes: Sequence[Scene]) -> Row:
    matching, right, wrong, took = PlainMatching(stamps), 0, 0, []
    for scene in scenes:
        begun = time.thread_time()
        name = matching.recognize(scene.image)
        took.append((time.thread_time() - begun) * 1e3)
        right, wrong = (
            right + (name == scene.stamp.name),
            wrong + (name not in ("", scene.stamp.name)),
        )
    row = _share(
        f"{len(stamps)} in the set, OpenCV as its tutorial has it", right, len(scenes), None, wrong
    )
    return row | {"ms": summary(took, 1)}


def _recall_of_1000(count: int) -> Iterator[Row]:
    """A full set: the pictures there are, and generated ones."""
    real = _stamps()[:250]
    dice = np.random.default_rng(SEED)
    stamps = [*real, *(generated(number, dice) for number in range(1000 - len(real)))]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "thousand.mdl"
        save_models(path, _learned(stamps))
        size = path.stat().st_size / 1e6
        before, begun = _memory(), time.process_time()
        recognizer = ObjectRecognizer(load_models(path), VIEW)
        started, memory = time.process_time() - begun, _memory() - before
    right = wrong = 0
    for scene in progress(_scenes(stamps, count, 1000), count, "1,000 objects"):
        found = recognizer.recognize(scene.image)
        right, wrong = right + _is_right(scene, found), wrong + _is_wrong(scene, found)
    what = "1,000 in the set, 750 of them generated: recall"
    yield _share(what, right, count, at_least(RECALL_OF_1000), wrong)
    yield amount("the same: file", size, "MB", None)
    yield amount("the same: memory", memory, "MB", None)
    yield amount("the same: loading", started, "s", None)


def _without_texture(sets: int) -> Iterator[Row]:
    """Colorful things with hardly any features, ten in a set."""
    plain = [
        stamp
        for stamp in _textured_and_others()[1]
        if is_solid(stamp) and is_colorful(view_of(stamp.picture, stamp.outline, SIFT))
    ]
    right = wrong = count = 0
    dice = np.random.default_rng(SEED + 4)
    for _ in progress(range(sets), sets, "plain objects"):
        chosen = [plain[index] for index in dice.choice(len(plain), PLAIN_OBJECTS, replace=False)]
        recognizer = ObjectRecognizer(_learned(chosen), VIEW)
        for stamp in chosen:
            scene = by_height(stamp, HEIGHT, dice)
            found = recognizer.recognize(scene.image)
            right, wrong = right + _is_right(scene, found), wrong + _is_wrong(scene, found)
            count += 1
    what = f"{PLAIN_OBJECTS} plain objects in the set, of {len(plain)}: "
    named = {"right_name": round(right / count, 3)}
    limit = at_least(NOT_MISTAKEN)
    yield share(what + "right name or none", count - wrong, count, limit) | named
    yield share(what + "wrong name", wrong, count, at_most(MISTAKEN))


def _memory() -> float:
    """The most that this process has taken, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def _unknown(seconds: float) -> Iterator[Row]:
    """A film of rooms and of things that are in no set: nothing may be called by a name."""
    recognizer = ObjectRecognizer(_learned(_stamps()[:TIMED]), VIEW)
    presence = ObjectPresence[FoundObject]()
    events = pictures = 0
    count, dice = round(seconds * RATE), np.random.default_rng(SEED + 1)
    strangers = [*_stamps()[TIMED:], *_textured_and_others()[1]]
    dice.shuffle(strangers)
    frames = film(strangers, seconds, RATE, dice)
    for frame in progress(frames, count, "unknown objects"):
        objects = recognizer.recognize(frame.image)
        pictures += bool(objects)
        events += len(presence.update(frame.time, objects)[0])
    what = f"unknown objects and empty rooms, {seconds / 60:g} min of film: objects seen"
    yield amount(what, events, "events", at_most(0), pictures_with_a_name=pictures, of=count)


def _cost(count: int) -> Iterator[Row]:
    for method, objects in ((SIFT, TIMED), (ORB, ORB_OBJECTS)):
        stamps = _stamps()[:objects]
        recognizer, took, right = ObjectRecognizer(_learned(stamps, method), VIEW), [], 0
        for scene in _scenes(stamps, count, 2):
            begun = time.process_time()
            found = recognizer.recognize(scene.image)
            took.append((time.process_time() - begun) * 1e3)
            right += _is_right(scene, found)
        what = f"a picture of {SIZE[0]}x{SIZE[1]}, {objects} objects, {method}"
        figures = summary(took, 1)
        more = {"p95": figures["p95"], "recall": round(right / count, 3)}
        yield amount(what, figures["median"], "ms", at_most(MS[method]), **more)
    yield amount("learning a view", _learning_s(), "s", at_most(LEARNING_S))


def _learning_s() -> float:
    took = []
    for stamp in _stamps()[:20]:
        begun = time.process_time()
        view_of(stamp.picture, stamp.outline, SIFT, scale_from_width(stamp.outline, WIDTH))
        took.append(time.process_time() - begun)
    return float(np.median(took))


def _distance(count: int) -> Iterator[Row]:
    stamps = _stamps()[:ORB_OBJECTS]
    recognizer, dice = ObjectRecognizer(_learned(stamps), VIEW), np.random.default_rng(SEED + 3)
    errors, seen = [], {}
    for meters in DISTANCES:
        scenes = [by_distance(stamps[n % len(stamps)], meters, WIDTH, dice) for n in range(count)]
        found = [
            abs(one.distance / scene.distance - 1)
            for scene in scenes
            for one in recognizer.recognize(scene.image)
            if one.name == scene.stamp.name
        ]
        errors += found
        seen[f"{meters:g} m"] = round(len(found) / count, 2)
    what = f"distance to things of {WIDTH:g} m, {DISTANCES[0]:g} to {DISTANCES[-1]:g} m: error, p95"
    yield amount(
        what,
        float(np.percentile(errors, 95)),
        "of the distance",
        at_most(DISTANCE_ERROR),
        median=round(float(np.median(errors)), 4),
        recall_at=seen,
    )
