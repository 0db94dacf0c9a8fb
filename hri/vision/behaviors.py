"""Seeing people in a network: who is there, whom to look at, who takes part."""

from __future__ import annotations

import math
from dataclasses import replace

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Frame, Gaze, Hand, HeadPose, People, Person
from hri.hal.camera import Camera
from hri.vision.camera_view import CameraView
from hri.vision.engagement import DISENGAGING, ENGAGED, UNENGAGED, Zones
from hri.vision.tracking.people import MEMORY, Seeing
from hri.vision.tracking.presence import Presence

FRESH = 1.0
"""Seconds for which someone counts as seen after they were seen last."""
GLANCE = 0.8
"""Seconds for which a newcomer is looked at."""
USUAL_DISTANCE = 1.5
"""Meters, of someone whose distance is unknown."""
ZONES = Zones()


class PersonTracker(Behavior):
    """Tracks everyone the camera sees, and raises events when people come, go and look. Vision runs
    in a separate process. When that fails, `vision.failed` gives the `reason`, all people count as
    gone, and it restarts by itself.
    """

    category = "vision"

    camera_id = Param("camera", "id of the camera that takes the pictures; its pose is used")
    detector = Param(
        "auto", "what finds faces: auto, haar, or the path of a file with the network YuNet"
    )
    inner_zone = Param(ZONES.inner, "meters; who is nearer and looks is engaged", minimum=0.1)
    outer_zone = Param(ZONES.outer, "meters; nobody farther away is engaged", minimum=0.1)
    hands = Param(False, "true: hands are looked at too, which takes half as much time again")
    latency = Param(0.05, "seconds that seeing takes on a fake clock", minimum=0, maximum=1)

    image = Input[Frame]("image", "pictures; the newest is seen when there is no time for all")
    people = Output[People]("people", "everyone, once for each picture that was seen")
    pose = Output[HeadPose]("headpose", "the head of the one attended to, when it was seen again")
    is_seen = Output[bool]("boolean", "true while a face is there, or was a second ago")

    def start(self, context: Context) -> None:
        self._events = context.events
        self._resources = context.resources
        self._camera = camera_of(context, self.camera_id)
        try:
            view = CameraView.of(self._camera) if self._camera else CameraView()
            zones = Zones(inner=self.inner_zone, outer=max(self.inner_zone, self.outer_zone))
            self._seeing = Seeing(self.detector, view, zones, hands=self.hands)
            self._service = context.clock.service(self._seeing, self.latency)
        except HriError:
            self._give_back()  # who cannot start is not stopped either
            raise
        self._presence = Presence()
        self._frame: Frame | None = None
        self._pan = 0.0
        self._told = self._seen = self._pictured = -math.inf
        self._posed = "", -math.inf
        self.last = People(-math.inf)
        """Everyone, as they were seen last."""

    def compute(self, now: float, dt: float) -> None:
        """Collect results, raise events, and hand over the newest picture."""
        try:
            for people in self._service.poll():
                self._take(people, now)
        except NotAvailable as error:
            self._events.raise_event("vision.failed", reason=str(error))
            self._tell(People(now), now)
        if self.last.persons and now - self._told >= MEMORY:
            # No picture has come for so long that everyone counts as gone.
            self._tell(People(now), now)
        self.is_seen.send(now - self._seen <= FRESH)
        self._frame = self.image.value or self._frame
        if self._frame is not None and not self._service.is_busy:
            self._pan = self._camera.pan(self._frame.time) if self._camera else 0.0
            self._service.ask(self._frame)
            self._frame = None

    def stop(self) -> None:
        self._service.close()
        self._give_back()

    def _give_back(self) -> None:
        if self._camera is not None:
            self._resources.release(self._camera)
            self._camera = None

    def _take(self, people: People, now: float) -> None:
        """Report the people of a new picture."""
        if people.time == self._pictured:
            return
        self._pictured = people.time
        self._seeing.note(people)
        self._tell(panned(people, self._pan), now)

    def _tell(self, people: People, now: float) -> None:
        self.last, self._told = people, now
        if any(person.is_visible for person in people.persons):
            self._seen = now
        for happening in self._presence.update(people):
            told = {"person": happening.person, **happening.properties}
            self._events.raise_event(happening.name, **told)
        self.people.send(people)
        person = people.person(people.attended)
        if person is not None and (person.id, person.pose.time) != self._posed:
            self._posed = person.id, person.pose.time
            self.pose.send(person.pose)


class Attention(Behavior):
    """Points the eyes at the attended person, and for a moment at a newcomer."""

    category = "vision"

    people = Input[People]("people", "everyone who is seen")
    gaze = Output[Gaze]("gaze", "where the robot's eyes must look to meet those of the person")
    person = Output[str]("string", "id of who is looked at")

    def start(self, context: Context) -> None:
        self._asked = ""
        self._known: set[str] = set()
        self._newcomer, self._glance_ends = "", -math.inf
        self._target: Person | None = None
        self._seen = -math.inf

    def look_at(self, person: str) -> None:
        """Look at this person as long as they are there; an empty id lets it choose."""
        self._asked = person

    def compute(self, now: float, dt: float) -> None:
        if (people := self.people.value) is not None:
            self._choose(people, now)
        if self._target is None or now - self._seen > FRESH:
            return
        self.gaze.send(gaze_at(self._target))
        self.person.send(self._target.id)

    def _choose(self, people: People, now: float) -> None:
        self._glance(people, now)
        for id in (self._asked, self._newcomer, people.attended):
            person = people.person(id)
            if person is not None and person.is_visible:
                self._target, self._seen = person, now
                return

    def _glance(self, people: People, now: float) -> None:
        """Note a newcomer to glance at, if someone was there before."""
        here = {person.id for person in people.persons}
        new = [person.id for person in people.persons if person.id not in self._known]
        if new and self._known & here:
            self._newcomer, self._glance_ends = new[-1], now + GLANCE
        if now >= self._glance_ends:
            self._newcomer = ""
        self._known = here


class EngagementLevel(Behavior):
    """Estimates engagement; raises `person.engaged` and `person.disengaged`."""

    category = "vision"

    people = Input[People]("people", "everyone who is seen")
    level = Output[str](
        "string", "of who is attended to: unengaged, engaging, engaged, disengaging"
    )
    is_engaged = Output[bool]("boolean", "true while anyone is engaged")
    count = Output[float]("double", "how many are engaged")
    is_looked_at = Output[bool]("boolean", "true while anyone in sight looks at the robot")

    def start(self, context: Context) -> None:
        self._events = context.events
        self._engaged: set[str] = set()
        self._level = UNENGAGED
        self._is_looked_at = False

    def compute(self, now: float, dt: float) -> None:
        if (people := self.people.value) is not None:
            self._take(people)
        self.level.send(self._level)
        self.is_engaged.send(bool(self._engaged))
        self.count.send(float(len(self._engaged)))
        self.is_looked_at.send(self._is_looked_at)

    def _take(self, people: People) -> None:
        attended = people.person(people.attended)
        self._level = attended.engagement if attended else UNENGAGED
        self._is_looked_at = any(one.is_visible and one.is_looking for one in people.persons)
        levels = {person.id: person.engagement for person in people.persons}
        # Who is on the way out comes back without having been away.
        now = {id for id, level in levels.items() if level == ENGAGED}
        now |= {id for id in self._engaged if levels.get(id) == DISENGAGING}
        before, self._engaged = self._engaged, now
        for id in sorted(now - before):
            self._events.raise_event("person.engaged", person=id)
        for id in sorted(before - now):
            self._events.raise_event("person.disengaged", person=id)


def gaze_at(person: Person) -> Gaze:
    """Where a face beside the camera must look to meet the eyes of a person."""
    distance = person.distance if math.isfinite(person.distance) else USUAL_DISTANCE
    level = distance * math.cos(person.elevation)
    point = (
        level * math.cos(person.bearing),
        level * math.sin(person.bearing),
        distance * math.sin(person.elevation),
    )
    return Gaze(point=point)


def camera_of(context: Context, id: str) -> Camera | None:
    """A camera of the configuration, to be released; None for pictures that come from no camera."""
    if id not in context.resources.descriptions:
        return None
    try:
        return context.resources.obtain(id, Camera)
    except HriError:
        return None  # who takes the pictures will say what is wrong with it


def panned(people: People, pan: float) -> People:
    """The same people, seen by a camera turned to the left by an angle, radians."""
    if not pan:
        return people
    turned = (
        replace(
            person,
            bearing=math.remainder(person.bearing + pan, math.tau),
            hands=tuple(_panned_hand(hand, pan) for hand in person.hands),
        )
        for person in people.persons
    )
    return replace(people, persons=tuple(turned))


def _panned_hand(hand: Hand, pan: float) -> Hand:
    bearings = (hand.bearing + pan, hand.pointing_bearing + pan)
    bearing, pointing = (math.remainder(angle, math.tau) for angle in bearings)
    return replace(hand, bearing=bearing, pointing_bearing=pointing)
