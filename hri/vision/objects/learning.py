"""Learning an object by looking at it: view after view, each only when it shows something new."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.vision.objects.local_features import FeatureExtractor, Features, resized
from hri.vision.objects.object_model import ModelSet, ObjectModel, Outline, View
from hri.vision.objects.plain_objects import is_colorful
from hri.vision.objects.recognizer import ObjectRecognizer

SIZE = 400
"""Pixels, longer side of a learned view at most."""
KEPT = 200
"""Pixels, longer side of the picture that is kept of it."""
SCALES = (0.7, 0.4, 0.28, 0.2)
"""A view is looked at from afar: small and blurred it has other features."""
BLUR = 1.0
"""Pixels, of the view from afar."""
KNOWN = 0.8
"""Confidence with which a view that shows nothing new is recognized."""
KNOWN_PLAIN = 0.45
"""The same of a plain view."""
MOST_VIEWS = 12
"""Of an object."""


def view_of(
    image: Image, outline: Outline, method: str, scale: float = 0.0, source: str = ""
) -> View:
    """An object within an outline, as a view that can be recognized.

    `image` is uint8, [height, width, 3], RGB; `scale` is meters to a pixel of it, 0 when unknown.
    """
    height, width = image.shape[:2]
    low = np.clip(np.floor(outline.min(axis=0)), 0, (width - 1, height - 1)).astype(int)
    high = np.clip(np.ceil(outline.max(axis=0)), low + 1, (width, height)).astype(int)
    cut = image[low[1] : high[1], low[0] : high[0]]
    shrunk = min(1.0, SIZE / max(cut.shape[:2]))
    picture = resized(cut, shrunk)
    corners = np.asarray((outline - low) * shrunk, np.float32)
    features = _features(picture, corners, FeatureExtractor(method, is_for_view=True))
    kept = min(1.0, KEPT / max(picture.shape[:2]))
    return View(
        resized(picture, kept),
        np.asarray(corners * kept, np.float32),
        replace(features, points=np.asarray(features.points * kept, np.float32)),
        scale / (shrunk * kept),
        source,
    )


def _features(picture: Image, outline: Outline, extractor: FeatureExtractor) -> Features:
    """Those of the object from near and from afar, in pixels of the picture."""
    mask = np.zeros(picture.shape[:2], np.uint8)
    cv2.fillPoly(mask, [np.rint(outline).astype(np.int32)], 255)
    parts = []
    for scale in SCALES:
        seen = np.asarray(cv2.GaussianBlur(resized(picture, scale), (0, 0), BLUR), np.uint8)
        size = seen.shape[1], seen.shape[0]
        where = np.asarray(cv2.resize(mask, size, interpolation=cv2.INTER_NEAREST), np.uint8)
        found = extractor.extract(seen, where)
        parts.append(replace(found, points=(found.points + 0.5) / np.float32(scale) - 0.5))
    return Features(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.descriptors for part in parts]),
    )


@dataclass(frozen=True, slots=True)
class Shown:
    """What a picture that was shown is good for."""

    view: View
    is_new: bool
    """Whether it was added."""
    reason: str
    """Why, in a few words."""
    mistaken: str = ""
    """The other object of the set that it was taken for; empty when for none."""


class ObjectLearner:
    """Collects the views of one object."""

    def __init__(self, name: str, others: ModelSet) -> None:
        """`others` are the objects that it must be distinguished from; one of the same
        name does not count.
        """
        self._name, self._method = name, others.method
        self._others = ObjectRecognizer(others.without(name))
        self._views: list[View] = []
        self._known: ObjectRecognizer | None = None
        self._has_moved = False
        """Whether the views are of a thing that is known by its motion."""
        self._refused: list[str] = []
        """Why pictures were not looked at closer."""

    def refuse(self, reason: str) -> None:
        """Take note of a picture that shows no object."""
        self._refused.append(reason)

    def show(
        self,
        image: Image,
        outline: Outline,
        scale: float = 0.0,
        source: str = "",
        *,
        has_moved: bool = False,
    ) -> Shown:
        """Look at one more picture; its view is kept when it shows something new.

        A thing that was seen to move is surely cut out of the room: from the first such picture on
        only they count, and views that were kept before are dropped.
        """
        view = view_of(image, outline, self._method, scale, source)
        others = self._others.recognize(view.picture)
        mistaken = others[0].name if others else ""
        if view.is_plain and not is_colorful(view):
            return Shown(view, False, f"too plain: {len(view.features)} features", mistaken)
        if self._has_moved and not has_moved:
            return Shown(view, False, "stands still", mistaken)
        if has_moved and not self._has_moved:
            self._views, self._known, self._has_moved = [], None, True
        if len(self._views) >= MOST_VIEWS:
            return Shown(view, False, f"{MOST_VIEWS} views are enough", mistaken)
        if self._known is not None:
            found = self._known.recognize(view.picture)
            if found and found[0].confidence >= (KNOWN_PLAIN if view.is_plain else KNOWN):
                return Shown(view, False, "looks like a view before", mistaken)
        self._views.append(view)
        self._known = ObjectRecognizer(ModelSet(self._method, (self._model(""),)))
        reason = "plain, known by color and shape" if view.is_plain else ""
        return Shown(view, True, reason or f"{len(view.features)} features", mistaken)

    @property
    def count(self) -> int:
        """How many views there are."""
        return len(self._views)

    @property
    def was_refused(self) -> bool:
        """Whether pictures that show no object are why there is no view."""
        return bool(self._refused) and not self._views

    def model(self, day: str) -> ObjectModel:
        """The object. Raises HriError when no picture was good enough."""
        if not self._views:
            what, remedy = "no picture shows enough of it", "show it nearer and in more light"
            if self.was_refused:
                what = f"{what}: {max(self._refused, key=self._refused.count)}"
                remedy = "hold it before the camera, so that it hides your face"
            raise HriError(f"{self._name}: {what} - {remedy}")
        return self._model(day)

    def _model(self, day: str) -> ObjectModel:
        return ObjectModel(self._name, tuple(self._views), day)


def scale_from_width(outline: Outline, width: float) -> float:
    """Meters to a pixel of an object whose outline is this many meters wide."""
    return width / max(1.0, float(np.ptp(outline[:, 0])))


def scale_from_distance(distance: float, focal_length: float) -> float:
    """Meters to a pixel of an object that is so far away; the focal length is in pixels."""
    return distance / focal_length if math.isfinite(distance) else 0.0
