"""Nods, shakes and other gestures of everyone who is seen, and in a network."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.signals import HeadGesture, HeadPose, People, Person, Pose2D
from hri.vision.gestures.gesture_file import chosen
from hri.vision.gestures.gesture_fusion import GestureFusion
from hri.vision.gestures.gesture_patterns import ANSWERS, FILE, Pattern, load_patterns
from hri.vision.tracking.egomotion import Egomotion, Steadied

MOST = 16
"""Gestures that wait to be sent."""


class PeopleGestures:
    """Recognizes the gestures of each person by themselves."""

    def __init__(self, patterns: Iterable[Pattern], own: Egomotion | None = None) -> None:
        """`own` gives the pose of the camera."""
        self._patterns, self._own = tuple(patterns), own or Egomotion()
        self._watched: dict[str, tuple[Steadied, GestureFusion]] = {}

    def update(self, people: People, prompted: bool = False) -> list[HeadGesture]:
        """The gestures that are complete now. `prompted`: an answer is expected.

        It is expected of the one attended to; of everyone when that is nobody.
        """
        here = {person.id for person in people.persons}
        self._watched = {id: pair for id, pair in self._watched.items() if id in here}
        found = (
            self._gesture(person, prompted and people.attended in ("", person.id))
            for person in people.persons
            if person.is_visible
        )
        return [gesture for gesture in found if gesture is not None]

    def _gesture(self, person: Person, prompted: bool) -> HeadGesture | None:
        if person.id not in self._watched:
            pair = Steadied(self._own), GestureFusion(self._patterns)
            self._watched[person.id] = pair
        steadied, recognizer = self._watched[person.id]
        steady = steadied.update(person)
        return None if steady is None else recognizer.update(steady, prompted)


class HeadGestures(Behavior):
    """Recognizes nods and shakes of people, or in the poses of one head, and reports them.

    The events are those of the file of patterns, `head.nodded` and `head.shaken` for these two,
    with `person`, `confidence` 0 to 1, and `latency`, the seconds since the movement began.
    """

    category = "vision"

    gestures = Param(" ".join(ANSWERS), "which ones, with spaces between; all of the file for all")
    patterns = Param(FILE, "the file that says what counts as which gesture")

    people = Input[People]("people", "everyone who is seen", is_optional=True)
    pose = Input[HeadPose]("headpose", "the poses of one head, without people", is_optional=True)
    prompted = Input[bool](
        "boolean", "true while an answer is expected: a single nod will do", is_optional=True
    )
    odometry = Input[Pose2D](
        "pose", "where the robot is; its own turning is taken out", is_optional=True
    )
    gesture = Output[HeadGesture]("gesture", "the nod or shake, while it is made; one a tick")

    def start(self, context: Context) -> None:
        self._events = context.events
        known = load_patterns(paths.find("config", self.patterns))
        names = known if self.gestures.strip() == "all" else self.gestures.split()
        self._patterns: Sequence[Pattern] = chosen(known, names)
        self._told = {pattern.gesture: pattern.event for pattern in self._patterns}
        self._own = Egomotion()
        self._recognizer = PeopleGestures(self._patterns, self._own)
        self._unsent: deque[HeadGesture] = deque(maxlen=MOST)

    def compute(self, now: float, dt: float) -> None:
        if (odometry := self.odometry.value) is not None:
            self._own.add(now, odometry.heading)
        people = self.people.value
        if people is None and (pose := self.pose.value) is not None:
            people = People(pose.time, (Person("", pose),))
        if people is not None:
            self._tell(self._recognizer.update(people, any(self.prompted.values)))
        if self._unsent:
            self.gesture.send(self._unsent.popleft())

    def _tell(self, gestures: Sequence[HeadGesture]) -> None:
        self._unsent.extend(gestures)
        for gesture in gestures:
            self._events.raise_event(
                self._told[gesture.kind],
                person=gesture.person,
                confidence=round(gesture.confidence, 2),
                latency=round(gesture.latency, 3),
            )
