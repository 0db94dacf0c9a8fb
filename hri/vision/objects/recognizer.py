"""Recognizes the objects of a model set in a picture, several at once.

Lowe (2004), section 7: features that match are votes for a view; a view is there when many of its
features lie in the picture as a plane seen from somewhere would show them (a homography, found by
RANSAC: Fischler and Bolles, 1981).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.signals import FoundObject, Image
from hri.vision.camera_view import CameraView
from hri.vision.objects.descriptor_index import DescriptorIndex
from hri.vision.objects.embedding import Embedding
from hri.vision.objects.likeness import ALIKE, Homography, likeness, projected
from hri.vision.objects.local_features import FeatureExtractor, Features, Points
from hri.vision.objects.object_model import ModelSet, Outline, View
from hri.vision.objects.plain_objects import PlainRecognizer

LEAST_VOTES = 4
"""Matches without which a view is not looked at closer."""
LEAST_FOR_PLANE = 8
"""Matches from which a homography is fitted; fewer give an affine map."""
SURE_INLIERS = 16
"""Features that agree, from which their map is not refined when what is there looks alike."""
MOST_VIEWS = 12
"""Views that are looked at closer in one picture."""
MOST_OBJECTS = 20
"""Objects in one picture."""
CLOSE = 4.0
"""Pixels that a feature may lie beside where the plane would have it."""
NEAR = 12.0
"""Pixels around where a first map has a feature, in which it is looked for again."""
TURNS = 2000
"""Attempts of RANSAC at most."""
SMALLEST = 16.0
"""Pixels; sides of an object's box below it are not believed."""
LARGEST = 6.0
"""Times as wide as the picture; a wider one is not believed."""
SAME = 0.5
"""Part of the smaller outline from which two that overlap are of one thing: what stands out of its
plane, as the parts of a motorcycle do, is seen by another map.
"""


@dataclass(frozen=True, slots=True)
class _Seen:
    """A view, where it is in the picture, and by how many features."""

    entry: int
    """Its number in the recognizer."""
    homography: Homography
    outline: Outline
    inliers: int
    likeness: float
    """To the learned picture, at most 1."""


class ObjectRecognizer:
    """Looks for the objects of a set, picture by picture; the same picture gives the same."""

    def __init__(
        self,
        models: ModelSet,
        view: CameraView | None = None,
        embedding: Embedding | None = None,
    ) -> None:
        """`view` gives the distance and bearing; without one that of a usual webcam.

        Objects without texture are found by color and shape, or by shape and `embedding`.
        """
        self._view = view or CameraView()
        self._attributes = {model.name: model.attributes for model in models.objects}
        self._plain = PlainRecognizer(
            [model for model in models.objects if all(one.is_plain for one in model.views)],
            self._view,
            embedding,
        )
        self._extractor = FeatureExtractor(models.method)
        owned = [
            (number, model.name, view)
            for number, model in enumerate(models.objects)
            for view in model.views
            if len(view.features)
        ]
        self._owners = [number for number, _, _ in owned]
        self._names = [name for _, name, _ in owned]
        self._views = [view for _, _, view in owned]
        self._index: DescriptorIndex | None = None
        if owned:
            described = [view.features.descriptors for view in self._views]
            self._index = DescriptorIndex(models.method, described, self._owners)
            lengths = [len(part) for part in described]
            self._starts = np.concatenate(([0], np.cumsum(lengths)[:-1]))
            self._entry_of = np.repeat(np.arange(len(owned)), lengths)

    def recognize(self, image: Image) -> tuple[FoundObject, ...]:
        """The objects in a picture (uint8, [height, width, 3], RGB), the surest first."""
        size = image.shape[1], image.shape[0]
        found = _distinct(self._described(seen, size) for seen in self._seen(image))
        found += [one for one in self._plain.recognize(image) if not _is_covered(one, found)]
        found = [replace(one, attributes=self._attributes[one.name]) for one in found]
        return tuple(sorted(found, key=lambda one: -one.confidence))

    def _seen(self, image: Image) -> Iterator[_Seen]:
        """Object after object: what belongs to one is not evidence for another."""
        if self._index is None:
            return
        features = self._extractor.extract_shrunk(image)
        matches = self._index.match(features.descriptors)
        queries, entries = matches.queries, matches.entries
        tried: set[int] = set()
        for _ in range(MOST_OBJECTS + MOST_VIEWS):
            votes = np.bincount(self._entry_of[entries], minlength=len(self._views))
            votes[list(tried)] = 0
            entry = int(votes.argmax())
            if votes[entry] < LEAST_VOTES:
                return
            chosen = self._entry_of[entries] == entry
            seen = self._fitted(entry, features, queries[chosen], entries[chosen], image)
            if seen is None:
                tried.add(entry)
                if len(tried) >= MOST_VIEWS:
                    return
                continue
            yield seen
            rest = ~_inside(features.points[queries], seen.outline)
            queries, entries = queries[rest], entries[rest]

    def _fitted(
        self,
        entry: int,
        features: Features,
        queries: NDArray[np.intp],
        entries: NDArray[np.intp],
        image: Image,
    ) -> _Seen | None:
        """Where the view is, if its features lie as a plane would have them and it looks alike."""
        view, size = self._views[entry], (image.shape[1], image.shape[0])
        known = view.features.points[entries - self._starts[entry]]
        homography, agreeing = _mapped(known, features.points[queries])
        if homography is None or not _is_plausible(homography, view, size):
            return None
        alike = likeness(view, homography, image, agreeing)
        if len(agreeing) < SURE_INLIERS or alike < ALIKE:
            refined, more = _mapped(*self._guided(view, homography, features))
            if refined is not None and _is_plausible(refined, view, size):
                better = likeness(view, refined, image, more)
                if better > alike:
                    homography, agreeing, alike = refined, more, better
        if alike <= 0:
            return None
        outline = projected(homography, view.outline)
        return _Seen(entry, homography, outline, len(agreeing), alike)

    def _guided(
        self, view: View, homography: Homography, features: Features
    ) -> tuple[Points, Points]:
        """Matches near where a first map has them: here no other object has to be ruled out."""
        expected = projected(homography, view.features.points)
        low, high = expected.min(axis=0) - NEAR, expected.max(axis=0) + NEAR
        near = np.flatnonzero(((features.points >= low) & (features.points <= high)).all(axis=1))
        away = np.maximum(*np.abs(features.points[near].T[:, :, None] - expected.T[:, None]))
        likeness = self._extractor.likeness(features.descriptors[near], view.features.descriptors)
        likeness[away > NEAR] = -1.0
        if not likeness.size:
            return expected[:0], expected[:0]
        best = likeness.argmax(axis=1)
        good = likeness[np.arange(len(near)), best] >= self._extractor.least_likeness
        return view.features.points[best[good]], features.points[near[good]]

    def _described(self, seen: _Seen, size: tuple[int, int]) -> FoundObject:
        view = self._views[seen.entry]
        x, y = map(float, projected(seen.homography, _center(view.outline)[None])[0])
        bearing, elevation = self._view.toward(x, y, size)
        return FoundObject(
            name=self._names[seen.entry],
            x=x,
            y=y,
            outline=tuple((float(a), float(b)) for a, b in seen.outline),
            confidence=seen.likeness * (1 - 2.0 ** (-seen.inliers / LEAST_VOTES)),
            distance=self._distance(view, seen.homography, size),
            bearing=bearing,
            elevation=elevation,
        )

    def _distance(self, view: View, homography: Homography, size: tuple[int, int]) -> float:
        """Meters to the center of the object; NaN when its size is unknown."""
        if view.scale <= 0:
            return math.nan
        focal = self._view.focal_length(size)
        camera = np.array([[focal, 0, size[0] / 2], [0, focal, size[1] / 2], [0, 0, 1]])
        corners = _box_corners(view.outline)
        plane = np.zeros((4, 3), np.float32)
        plane[:, :2] = (corners - _center(view.outline)) * view.scale
        there = projected(homography, corners)
        is_solved, _, moved = cv2.solvePnP(plane, there, camera, None, flags=cv2.SOLVEPNP_IPPE)
        return float(np.linalg.norm(moved)) if is_solved else math.nan


def _box_corners(outline: Outline) -> Outline:
    """The four corners of the box around an outline, clockwise from the upper left."""
    (left, top), (right, bottom) = outline.min(axis=0), outline.max(axis=0)
    return np.array([(left, top), (right, top), (right, bottom), (left, bottom)], np.float32)


def _center(outline: Outline) -> NDArray[np.float32]:
    return np.asarray(_box_corners(outline).mean(axis=0), np.float32)


def _inside(places: Points, outline: Outline) -> NDArray[np.bool_]:
    """Which points lie within an outline."""
    polygon = outline.reshape(-1, 1, 2)
    tests = [cv2.pointPolygonTest(polygon, (float(x), float(y)), False) >= 0 for x, y in places]
    return np.array(tests, bool)


def _distinct(found: Iterable[FoundObject]) -> list[FoundObject]:
    """Of findings of one name that overlap, the surest."""
    chosen: list[FoundObject] = []
    for one in sorted(found, key=lambda one: -one.confidence):
        if not any(one.name == other.name and _overlap(one, other) > SAME for other in chosen):
            chosen.append(one)
    return chosen


def _overlap(one: FoundObject, other: FoundObject) -> float:
    """The part of the smaller of two outlines, taken as convex, that they share."""
    first, second = (cv2.convexHull(np.array(each.outline, np.float32)) for each in (one, other))
    shared, _ = cv2.intersectConvexConvex(first, second)
    return shared / max(1e-6, min(cv2.contourArea(first), cv2.contourArea(second)))


def _is_covered(one: FoundObject, others: Sequence[FoundObject]) -> bool:
    """Whether the middle of an object lies within another."""
    place = np.array([[one.x, one.y]], np.float32)
    return any(_inside(place, np.array(other.outline, np.float32))[0] for other in others)


def _mapped(known: Points, places: Points) -> tuple[Homography | None, Points]:
    """The map from a view to the picture that most matches agree on, and where in the view those
    are.
    """
    if len(known) < LEAST_VOTES:
        return None, known[:0]
    if len(known) >= LEAST_FOR_PLANE:
        found, agreeing = cv2.findHomography(known, places, cv2.RANSAC, CLOSE, maxIters=TURNS)
        if found is not None and agreeing.sum() >= LEAST_FOR_PLANE:
            return np.asarray(found, np.float64), known[agreeing.ravel() > 0]
    affine, agreeing = cv2.estimateAffine2D(
        known, places, method=cv2.RANSAC, ransacReprojThreshold=1.5 * CLOSE, maxIters=TURNS
    )
    if affine is None or agreeing.sum() < LEAST_VOTES:
        return None, known[:0]
    return np.vstack((affine, (0.0, 0.0, 1.0))), known[agreeing.ravel() > 0]


def _is_plausible(homography: Homography, view: View, size: tuple[int, int]) -> bool:
    """Whether a camera could see a flat thing like this: not mirrored, folded, tiny or vast."""
    corners = _box_corners(view.outline)
    depths = np.c_[corners, np.ones(4)] @ homography[2]
    if (depths > 0).any() != (depths > 0).all():
        return False
    box = projected(homography, corners)
    if not np.isfinite(box).all() or np.ptp(box, axis=0).max() > LARGEST * max(size):
        return False
    edges = np.roll(box, -1, axis=0) - box
    turns = edges[:, 0] * np.roll(edges[:, 1], -1) - edges[:, 1] * np.roll(edges[:, 0], -1)
    return bool((turns > 0).all() and np.hypot(*edges.T).min() >= SMALLEST)
