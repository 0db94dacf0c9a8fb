"""Recognizes when a facial expression begins and ends, in what the parts of a face do."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from hri.core.signals import Countenance, People, Person
from hri.vision.expressions.expression_patterns import ExpressionPattern

FRONTAL = math.radians(16)
"""Turned away by more, a face is not read: its mesh raises the brows of who looks down."""
GAP = 0.5
"""Seconds without a look at the face after which nothing shows any more."""


@dataclass(frozen=True, slots=True)
class FacialExpression:
    """What the face of someone begins or ends to show: how it looks, not what they feel."""

    kind: str
    """Its row in `config/expressions.toml`, such as "smile"."""
    time: float
    """Seconds, of the picture with which it was clear."""
    person: str = ""
    seconds: float = 0.0
    """Since it began to show."""
    is_over: bool = False
    """Of one that lasts, at its end; a brief one, such as a blink, is over when it is clear."""


class ShownExpression:
    """One expression of one face."""

    def __init__(self, pattern: ExpressionPattern) -> None:
        self._pattern = pattern
        self._began: float | None = None
        self.is_shown = False

    def update(self, time: float, face: Countenance) -> FacialExpression | None:
        """What begins or is over with a look at a time in seconds."""
        row = self._pattern
        if self._began is None:
            self._began = time if row.begins_with(face) else None
        elif row.ends_with(face):
            return self.end(time)
        if self._began is None or self.is_shown or row.is_brief or time - self._began < row.hold:
            return None
        self.is_shown = True
        return FacialExpression(row.name, time, seconds=time - self._began)

    def end(self, time: float, is_seen: bool = True) -> FacialExpression | None:
        """Nothing of it shows any more; without its end in sight a brief one does not count."""
        row, began, was_shown = self._pattern, self._began, self.is_shown
        self._began, self.is_shown = None, False
        if began is None:
            return None
        was_brief = row.is_brief and is_seen and time - began <= row.within
        if not (was_shown or was_brief):
            return None
        return FacialExpression(row.name, time, seconds=time - began, is_over=True)


class FaceExpressions:
    """The expressions of one face."""

    def __init__(self, patterns: Sequence[ExpressionPattern]) -> None:
        self._shown = {pattern.name: ShownExpression(pattern) for pattern in patterns}
        self._looked = -math.inf

    @property
    def shown(self) -> tuple[str, ...]:
        """What shows now, in the order of the patterns."""
        return tuple(name for name, one in self._shown.items() if one.is_shown)

    def update(self, time: float, face: Countenance | None) -> Iterator[FacialExpression]:
        """What begins or is over at a time in seconds; None is a face that is not to be read."""
        if time - self._looked > GAP or time < self._looked:
            yield from self.end(time)
        if face is None:
            return
        self._looked = time
        for one in self._shown.values():
            if (told := one.update(time, face)) is not None:
                yield told

    def end(self, time: float) -> Iterator[FacialExpression]:
        """Nothing shows any more: the face is gone."""
        for one in self._shown.values():
            if (told := one.end(time, is_seen=False)) is not None:
                yield told


class PeopleExpressions:
    """The expressions of everyone who is seen."""

    def __init__(self, patterns: Iterable[ExpressionPattern]) -> None:
        self._patterns = tuple(patterns)
        self._faces: dict[str, FaceExpressions] = {}

    def shown_by(self, person: str) -> tuple[str, ...]:
        """The names of what the face of someone shows now."""
        face = self._faces.get(person)
        return face.shown if face is not None else ()

    def update(self, people: People) -> list[FacialExpression]:
        """What begins or is over with a picture."""
        told = []
        here = {person.id: person for person in people.persons}
        for id in [id for id in self._faces if id not in here]:
            told += _of(id, self._faces.pop(id).end(people.time))
        for id, person in here.items():
            face = self._faces.setdefault(id, FaceExpressions(self._patterns))
            told += _of(id, face.update(people.time, _readable(person)))
        return told


def _of(person: str, told: Iterable[FacialExpression]) -> list[FacialExpression]:
    return [replace(one, person=person) for one in told]


def _readable(person: Person) -> Countenance | None:
    """What the parts of a face do, where it is turned to the camera."""
    is_frontal = math.hypot(person.pose.yaw, person.pose.pitch) <= FRONTAL
    return person.countenance if person.is_visible and is_frontal else None
