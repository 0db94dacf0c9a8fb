"""Things that are learned from films in which they are turned, then found in other rooms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import cv2
import numpy as np

from benchmarks.progress import progress
from benchmarks.vision.covers import cover
from benchmarks.vision.object_scenes import VIEW, Scene, by_distance, empty_room, turned_before_room
from benchmarks.vision.stamps import Stamp, read_stamps
from hri.bench.table import Row, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.core.errors import HriError
from hri.core.signals import Image
from hri.vision.objects.held_up import HeldUpFinder
from hri.vision.objects.learning import ObjectLearner, scale_from_distance
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.recognizer import ObjectRecognizer

SEED = 580_000
THINGS, QUICK_THINGS = 40, 6
WIDTH, METERS = 0.2, 0.5
"""Of a thing, and how far away it is shown."""
SECONDS, EVERY = 8.0, 0.4
"""Of a film, and between its pictures."""
LOOKS = (0.5, 0.75, 1.0)
"""Meters, where it is looked for."""
ROOMS = 3
"""Empty ones that are looked at with each thing."""
TEXTURED = 90
"""Features of SIFT that a stamp has at two fifths of its size: fewer is hardly a print."""
FOUND = 0.75


def rows(quick: bool) -> Iterator[Row]:
    """All of them, on one core."""
    with one_thread():
        stamps = [stamp for stamp in read_stamps()[0] if _is_textured(stamp)]
        yield from _films(stamps, QUICK_THINGS if quick else THINGS)


def _is_textured(stamp: Stamp) -> bool:
    small = cv2.resize(stamp.picture, None, fx=0.4, fy=0.4, interpolation=cv2.INTER_AREA)
    return len(cv2.SIFT.create().detect(small, None)) >= TEXTURED


def _films(stamps: Sequence[Stamp], count: int) -> Iterator[Row]:
    """Every other thing is a magazine."""
    dice = np.random.default_rng(SEED)
    learned = found = elsewhere = named = nothing = 0
    for number in progress(range(count), count, "films"):
        thing = stamps[number] if number % 2 else cover(number, 0, stamps)
        model = _learned(turned_before_room(thing, METERS, WIDTH, SECONDS, EVERY, dice))
        nothing += _learned(empty_room(SECONDS, EVERY, dice)) is not None
        if model is None:
            continue
        learned += 1
        recognizer = ObjectRecognizer(ModelSet(SIFT, (model,)), VIEW)
        for meters in LOOKS:
            scene = by_distance(thing, meters, WIDTH, dice)
            right, wrong = _judged(recognizer, scene)
            found, elsewhere = found + right, elsewhere + wrong
        rooms = (next(empty_room(1.0, 1.0, dice)) for _ in range(ROOMS))
        named += sum(bool(recognizer.recognize(room)) for room in rooms)
    what = "things turned before a busy room: "
    tries = count * len(LOOKS)
    more = {"learned": learned, "of_things": count, "in_a_wrong_place": elsewhere}
    yield share(what + "found in other rooms", found, tries, at_least(FOUND)) | more
    yield share(what + "named in rooms without", named, learned * ROOMS, at_most(0.0))
    # Some of the photographs show a thing in the middle, such as a cup.
    yield share("rooms where nothing is held up: learned", nothing, count, at_most(0.0))


def _learned(film: Iterator[Image]) -> ObjectModel | None:
    finder, learner = HeldUpFinder(), ObjectLearner("thing", ModelSet(SIFT))
    for image in film:
        held_up = finder.find(image)
        if held_up.outline is not None:
            height, width = image.shape[:2]
            scale = scale_from_distance(METERS, VIEW.focal_length((width, height)))
            learner.show(image, held_up.outline, scale, has_moved=held_up.has_moved)
    try:
        return learner.model("")
    except HriError:
        return None


def _judged(recognizer: ObjectRecognizer, scene: Scene) -> tuple[bool, bool]:
    """Whether it is found in its place, and whether elsewhere."""
    places = [scene.shows(one.x, one.y) for one in recognizer.recognize(scene.image)]
    return any(places), not all(places)
