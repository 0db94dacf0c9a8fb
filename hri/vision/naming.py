"""Names the people in sight, in networks whose owner wants that."""

from __future__ import annotations

import importlib
import logging
from collections import deque
from dataclasses import replace
from functools import partial
from pathlib import Path

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.clock import Worker
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Frame, Image, Landmarks, People, Person
from hri.core.writing import Mark, mark_of
from hri.vision.tracking.face_recognition import Acquaintances, FaceEmbedder, FaceRecognizer

log = logging.getLogger("hri.vision")

KEPT_FRAMES = 15
"""Pictures that are kept until it is known who is in them."""
LOOK_EVERY = 1.0
"""Seconds between two looks at who someone is; one look may err, so names may change."""


class FaceNames(Behavior):
    """Names the people it has been introduced to; learns nobody by itself.

    `remember` takes the face of a person for a name, `forget` erases one, `forget_all` everything.
    When someone else changes the file, as `hri forget` does, that counts within a second. Raises
    `person.named` (person: the id, name) when a face is recognized.
    """

    category = "vision"

    model = Param("", "class of a face-embedding model, as module:Class; without, nobody is named")
    file = Param("", "file in which names and faces are kept; without, they are gone at the end")
    latency = Param(0.05, "seconds that a look takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "the pictures in which the people were seen")
    people = Input[People]("people", "everyone who is seen")
    named = Output[People]("people", "the same people with their names")

    def start(self, context: Context) -> None:
        self._frames: deque[Frame] = deque(maxlen=KEPT_FRAMES)
        self._names: dict[str, str] = {}
        self._looked: dict[str, float] = {}
        self._seen: dict[str, tuple[Image, Landmarks]] = {}
        self._told = ""
        """The last reported error of a failing model."""
        self._recognizer: FaceRecognizer | None = None
        self._events = context.events
        self._checked = context.clock.now()
        self._mark: Mark | None = None
        """Of the file as it was read or written last; None when there was none."""
        if self.model:
            self._recognizer = FaceRecognizer(embedder(self.model), Acquaintances())
            self._reread()
        self._worker: Worker[tuple[str, str]] = context.clock.worker(self.latency)

    def compute(self, now: float, dt: float) -> None:
        """Pass people on with the names that are known, and look at one who is due."""
        self._take_names()
        if now - self._checked >= LOOK_EVERY:
            self._checked = now
            self._look_at_file()
        if (frame := self.image.value) is not None and self._recognizer is not None:
            self._frames.append(frame)
        if (people := self.people.value) is None:
            return
        here = {person.id for person in people.persons}
        self._names = {id: name for id, name in self._names.items() if id in here}
        self._keep(people)
        self._look(now)
        named = [replace(p, name=self._names.get(p.id, p.name)) for p in people.persons]
        self.named.send(replace(people, persons=tuple(named)))

    def stop(self) -> None:
        self._worker.close()

    def remember(self, person: str, name: str) -> None:
        """Take the face of a person, as it was seen last, for one of that name.

        Raises HriError when no model is set, the person is not visible, or the face is unusable.
        """
        recognizer = self._ready()
        if person not in self._seen:
            raise HriError(f'no face of "{person}" is seen - wait until they look at the robot')
        self._reread()
        recognizer.learn(name, *self._seen[person])
        self._name(person, name)
        self._save()

    def forget(self, name: str) -> bool:
        """Erase a name and its faces; whether it was known. Raises HriError without a model."""
        self._reread()
        was_known = self._ready().known.forget(name)
        self._names = {id: other for id, other in self._names.items() if other != name}
        self._save()
        return was_known

    def forget_all(self) -> None:
        """Erase everyone. Raises HriError without a model."""
        self._ready().known.forget_all()
        self._names.clear()
        self._save()

    def _ready(self) -> FaceRecognizer:
        if self._recognizer is None:
            raise HriError(f"{self.id} knows no faces - set its parameter model")
        return self._recognizer

    def _save(self) -> None:
        if self.file:
            path = paths.expanded(self.file)
            self._ready().known.save(path)
            self._mark = _mark_of(path)

    def _look_at_file(self) -> None:
        try:
            self._reread()
        except HriError as error:
            log.warning("%s: %s", self.id, error)

    def _reread(self) -> None:
        """Read the file again if someone else has changed it. Raises HriError."""
        path = paths.expanded(self.file)
        if self._recognizer is None or not self.file or (mark := _mark_of(path)) == self._mark:
            return
        self._mark = mark
        self._recognizer.known = Acquaintances.load(path)
        known = self._recognizer.known.names
        self._names = {id: name for id, name in self._names.items() if name in known}

    def _name(self, person: str, name: str) -> None:
        """Name a person in sight; an empty name means unknown."""
        if name and self._names.get(person) != name:
            self._events.raise_event("person.named", person=person, name=name)
        self._names[person] = name

    def _take_names(self) -> None:
        try:
            for id, name in self._worker.poll():
                self._name(id, name)
        except HriError as error:
            if str(error) != self._told:
                log.warning("%s: %s", self.id, error)
            self._told = str(error)

    def _keep(self, people: People) -> None:
        """The faces of those who are seen, each with the picture in which it was."""
        self._seen = {}
        for person in people.persons:
            frame = self._frame_of(person)
            if frame is not None and person.landmarks is not None:
                self._seen[person.id] = frame.image, person.landmarks

    def _frame_of(self, person: Person) -> Frame | None:
        if not person.is_visible:
            return None
        return next((f for f in self._frames if f.time == person.pose.time), None)

    def _look(self, now: float) -> None:
        """Look at who has waited longest."""
        due = [id for id in self._seen if now - self._looked.get(id, -LOOK_EVERY) >= LOOK_EVERY]
        if self._recognizer is None or self._worker.is_busy or not due:
            return
        id = min(due, key=lambda id: (self._looked.get(id, -LOOK_EVERY), id))
        self._looked = {other: at for other, at in self._looked.items() if other in self._seen}
        self._looked[id] = now
        self._worker.submit(partial(_named, self._recognizer, id, *self._seen[id]))


def _mark_of(path: Path) -> Mark | None:
    """The mark of a file; None when there is none."""
    try:
        return mark_of(path.stat())
    except OSError:
        return None


def _named(
    recognizer: FaceRecognizer, id: str, image: Image, landmarks: Landmarks
) -> tuple[str, str]:
    return id, recognizer.name(image, landmarks)


def embedder(name: str) -> FaceEmbedder:
    """The model of a class, "module:Class". Raises HriError when there is no such class."""
    module, _, cls = name.partition(":")
    try:
        made: FaceEmbedder = getattr(importlib.import_module(module), cls)()
    except ImportError as error:
        raise NotAvailable(f'the model "{name}": {error} - install its package') from error
    except (AttributeError, ValueError) as error:
        raise HriError(
            f'no model "{name}" - write module:Class of one that embeds faces'
        ) from error
    return made
