"""The people in a still picture: it has no past, so all of it is searched at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from hri.core.signals import Frame, Image, Person
from hri.vision.camera_view import CameraView
from hri.vision.detectors.detector_choice import Detectors
from hri.vision.detectors.face import FoundFace, is_same
from hri.vision.detectors.search_squares import Square, whole
from hri.vision.tracking.people import PeopleTracker

LOOKS, EVERY = 2, 0.1
"""How often the tracker is shown a picture, and seconds between: without a mesh it believes in a
face only when it sees it again."""


@dataclass(frozen=True, slots=True)
class SeenStill:
    """Who is in a still picture."""

    persons: tuple[Person, ...]
    found: tuple[FoundFace, ...]
    """What the finder took for faces, whether a mesh fits or not."""

    def confidence(self, person: Person) -> float:
        """How sure the finder was of their face, 0 to 1."""
        box = person.pose.box
        return max(
            (face.score for face in self.found if box and is_same(face.box, box)), default=0.0
        )


def see_still(detectors: Detectors, image: Image, view: CameraView | None = None) -> SeenStill:
    """Everyone whose face is seen in a picture; nobody in what is not an 8-bit RGB picture."""
    found = detectors.finder.find(image)
    tracker = PeopleTracker(replace(detectors, finder=_Found(found)), view)
    for number in range(LOOKS):
        people = tracker.see(Frame(image, EVERY * number, number))
    persons = tuple(person for person in people.persons if person.is_visible)
    return SeenStill(persons, tuple(found))


@dataclass(frozen=True, slots=True)
class _Found:
    """A finder that has searched the whole picture already."""

    faces: list[FoundFace]

    def squares(self, width: int, height: int) -> list[Square]:
        return [whole(width, height)]

    def find(self, image: Image, squares: Sequence[Square] | None = None) -> list[FoundFace]:
        return self.faces
