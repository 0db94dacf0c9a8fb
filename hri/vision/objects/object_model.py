"""What is known of an object: the views of it that were shown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.vision.objects.local_features import Features

LEAST_FEATURES = 40
"""With fewer a view is too plain to be known again by its texture."""

Outline = NDArray[np.float32]
"""A polygon, shape [corners, 2]: x and y in pixels."""


@dataclass(frozen=True, slots=True)
class View:
    """An object as it looks from one side."""

    picture: Image
    """Uint8, [height, width, 3], RGB: cut out around the object."""
    outline: Outline
    """Where in the picture the object is."""
    features: Features
    """Only those of the object."""
    scale: float = 0.0
    """Meters of the object to a pixel of the picture; 0 when unknown."""
    source: str = ""
    """The file or the camera that it is from."""

    @property
    def is_plain(self) -> bool:
        """Whether it must be known by its color and shape."""
        return len(self.features) < LEAST_FEATURES


@dataclass(frozen=True, slots=True)
class ObjectModel:
    """An object and all of its views."""

    name: str
    views: tuple[View, ...]
    learned: str = ""
    """The day on which it was learned, such as "2026-11-23"."""
    attributes: Mapping[str, float | str] = field(default_factory=dict, hash=False)
    """Whatever a program wants to know of it; see `object_attributes`."""


@dataclass(frozen=True, slots=True)
class ModelSet:
    """Objects that are told apart; all of their features are of one method."""

    method: str
    """A key of `local_features.METHODS`."""
    objects: tuple[ObjectModel, ...] = field(default=())

    def find(self, name: str) -> ObjectModel | None:
        """The object of this name."""
        return next((model for model in self.objects if model.name == name), None)

    def with_object(self, model: ObjectModel) -> ModelSet:
        """This set with an object more; one of the same name is replaced where it stands.

        It hands on its attributes to one that has none.
        """
        former = self.find(model.name)
        if former is None:
            return ModelSet(self.method, (*self.objects, model))
        model = replace(model, attributes=model.attributes or former.attributes)
        others = (model if one.name == model.name else one for one in self.objects)
        return ModelSet(self.method, tuple(others))

    def without(self, name: str) -> ModelSet:
        """This set without an object."""
        return ModelSet(self.method, tuple(one for one in self.objects if one.name != name))
