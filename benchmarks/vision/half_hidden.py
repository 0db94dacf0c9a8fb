"""Things that are half hidden, or seen badly in all ways at once, and others that look alike."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from benchmarks.progress import progress
from benchmarks.vision.covers import ISSUES, cover
from benchmarks.vision.object_scenes import VIEW, Conditions, Scene, by_distance
from benchmarks.vision.plain_matching import PlainMatching
from benchmarks.vision.stamps import Stamp, read_stamps
from hri.bench.table import Row, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.core.signals import FoundObject
from hri.vision.objects.learning import view_of
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.recognizer import ObjectRecognizer

SEED = 570_000
WIDTH, METERS = 0.2, 0.6
"""The longer side of a thing, and how far away the half-hidden ones are, meters."""
STAMPS, MAGAZINES = 30, 20
"""In the set of which things are hidden; of other sets the same parts."""
HIDDEN = {0.3: 0.75, 0.4: 0.75, 0.5: 0.6}
"""Parts that are hidden, and how often the thing is found then."""
SCENES, QUICK_SCENES = 100, 15
STRANGERS, QUICK_STRANGERS = 300, 45
SETS = (20, 100)
MIXED_FOUND = {20: 0.75, 100: 0.65}
MOST_NAMED = {20: 0.0, 100: 0.01}
"""By the size of the set."""
FAR = 0.3, 1.5
"""Meters, where things are seen in all ways."""
MIXED = Conditions(
    roll=math.pi,
    tilt=math.radians(45),
    light=(0.3, 1.5),
    blur=1.2,
    noise=8.0,
    smear=6,
    hidden=(0.0, 0.35),
    glares=0.3,
)


def rows(quick: bool) -> Iterator[Row]:
    """All of them, on one core."""
    scenes = QUICK_SCENES if quick else SCENES
    strangers = QUICK_STRANGERS if quick else STRANGERS
    with one_thread():
        stamps, others = read_stamps()
        yield from _hidden(_things(stamps, STAMPS + MAGAZINES), scenes)
        for count in SETS:
            things = _things(stamps, count)
            recognizer = ObjectRecognizer(_learned(things), VIEW)
            yield _mixed(recognizer, things, scenes)
            unknown = [*stamps[-count:], *others]
            yield _strangers(recognizer, things, stamps, unknown, strangers)


def _things(stamps: Sequence[Stamp], count: int) -> list[Stamp]:
    """Stamps, and the first issues of magazines."""
    magazines = count * MAGAZINES // (STAMPS + MAGAZINES)
    return [*stamps[: count - magazines], *(cover(n, 0, stamps) for n in range(magazines))]


def _learned(things: Sequence[Stamp]) -> ModelSet:
    views = (
        view_of(one.picture, one.outline, SIFT, WIDTH / max(one.picture.shape[:2]))
        for one in progress(things, len(things), "learning")
    )
    models = zip(things, views, strict=True)
    return ModelSet(SIFT, tuple(ObjectModel(thing.name, (view,)) for thing, view in models))


def _is_right(scene: Scene, found: Sequence[FoundObject]) -> bool:
    return any(one.name == scene.stamp.name and scene.shows(one.x, one.y) for one in found)


def _hidden(things: Sequence[Stamp], count: int) -> Iterator[Row]:
    recognizer, matching = ObjectRecognizer(_learned(things), VIEW), PlainMatching(things)
    for part, least in HIDDEN.items():
        dice = np.random.default_rng((SEED, round(100 * part)))
        right = wrong = plain = plain_wrong = 0
        for _ in progress(range(count), count, f"{part:.0%} hidden"):
            thing = things[int(dice.integers(len(things)))]
            scene = by_distance(thing, METERS, WIDTH, dice, Conditions(hidden=(part, part)))
            found = recognizer.recognize(scene.image)
            right += _is_right(scene, found)
            wrong += any(one.name != thing.name for one in found)
            name = matching.recognize(scene.image)
            plain, plain_wrong = plain + (name == thing.name), plain_wrong + bool(name)
        what = f"{len(things)} in the set, {part:.0%} hidden: found"
        peer = {"opencv_found": plain, "opencv_wrong_names": plain_wrong - plain}
        yield share(what, right, count, at_least(least)) | {"wrong_names": wrong} | peer


def _mixed(recognizer: ObjectRecognizer, things: Sequence[Stamp], count: int) -> Row:
    dice, right, wrong = np.random.default_rng((SEED, len(things))), 0, 0
    for _ in progress(range(count), count, "all at once"):
        thing = things[int(dice.integers(len(things)))]
        scene = by_distance(thing, float(dice.uniform(*FAR)), WIDTH, dice, MIXED)
        found = recognizer.recognize(scene.image)
        right += _is_right(scene, found)
        wrong += any(one.name != thing.name for one in found)
    what = f"{len(things)} in the set, turned, tilted, dark, blurred, hidden, far at once: found"
    return share(what, right, count, at_least(MIXED_FOUND[len(things)])) | {"wrong_names": wrong}


def _strangers(
    recognizer: ObjectRecognizer,
    things: Sequence[Stamp],
    pictures: Sequence[Stamp],
    unknown: Sequence[Stamp],
    count: int,
) -> Row:
    """A third of them are other issues of magazines that are in the set."""
    magazines = sum(thing.name.startswith("magazine") for thing in things)
    dice, names = np.random.default_rng((SEED, 1, len(things))), {"alike": 0, "other": 0}
    for number in progress(range(count), count, "strangers"):
        kind = "other" if number % 3 else "alike"
        if kind == "alike":
            series, issue = int(dice.integers(magazines)), int(dice.integers(1, ISSUES))
            stranger = cover(series, issue, pictures)
        else:
            stranger = unknown[int(dice.integers(len(unknown)))]
        scene = by_distance(stranger, METERS, WIDTH, dice)
        names[kind] += bool(recognizer.recognize(scene.image))
    what = f"{len(things)} in the set, unknown things, a third other issues of magazines: named"
    limit = at_most(MOST_NAMED[len(things)])
    return share(what, sum(names.values()), count, limit) | {"of_magazines": names["alike"]}
