from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Frame, Gaze, HeadPose, People
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.simulated_devices import SimulatedCamera
from hri.vision.behaviors import Attention, EngagementLevel, PersonTracker, gaze_at
from hri.vision.tracking import people
from tests.vision.stage import Player, Spot, Stage, standing
from tests.vision.tracking.test_people import ANNA, BEN, CARA, away_between, until

TICK = 1 / 15
NEAR = 100.0
"""Pixels of a face that is half a meter away."""


class Projector(Behavior):
    """Shows the pictures of a stage, one a tick."""

    image = Output[Frame]("image", "the frames")
    stage: Stage
    is_on = True
    odd: list[np.ndarray] = []
    """Shown first, in place of what is on the stage."""

    def compute(self, now: float, dt: float) -> None:
        if self.is_on:
            self.stage.time = now
            image = self.odd.pop(0) if self.odd else self.stage.image()
            self.image.send(Frame(image, now, round(now / TICK)))


class Notes(Behavior):
    """Writes down what the others send."""

    people = Input[People]("people", "everybody")
    pose = Input[HeadPose]("headpose", "poses")
    gaze = Input[Gaze]("gaze", "gazes")
    person = Input[str]("string", "who is looked at")
    is_seen = Input[bool]("boolean", "whether somebody is there")
    level = Input[str]("string", "engagement")
    count = Input[float]("double", "how many are engaged")
    is_looked_at = Input[bool]("boolean", "whether anyone looks at the robot")

    def start(self, context: Context) -> None:
        self.rows: list[dict[str, object]] = []

    def compute(self, now: float, dt: float) -> None:
        ports = {name: getattr(self, name).value for name in self.inputs}
        self.rows.append({"now": now, **ports})

    def last(self, name: str) -> object:
        return next((row[name] for row in reversed(self.rows) if row[name] is not None), None)


class Theater:
    """All behaviors that see, before a stage."""

    def __init__(self, stage: Stage, *devices: Description, **parameters: object) -> None:
        self.stage, self.clock = stage, FakeClock()
        bus = EventBus(self.clock)
        self.events: list[Event] = []
        bus.subscribe("*", self.events.append)
        self.projector, self.notes = Projector(), Notes()
        self.projector.stage, self.projector.odd = stage, []
        self.tracker = PersonTracker(**parameters)
        self.attention, self.engagement = Attention(), EngagementLevel()
        self.tracker.image.sources.append(self.projector.image)
        self.attention.people.sources.append(self.tracker.people)
        self.engagement.people.sources.append(self.tracker.people)
        for source in (self.tracker, self.attention, self.engagement):
            for name in source.outputs:
                if name in Notes.inputs:
                    getattr(self.notes, name).sources.append(getattr(source, name))
        context = Context(self.clock, bus, ResourceManager(devices, self.clock))
        self.behaviors = self.projector, self.tracker, self.attention, self.engagement, self.notes
        for behavior in self.behaviors:
            behavior.start(context)

    def show(self, seconds: float) -> "Theater":
        for _ in range(round(seconds / TICK)):
            for behavior in self.behaviors:
                for name in behavior.outputs:
                    getattr(behavior, name).value = None
                behavior.compute(self.clock.now(), TICK)
            self.clock.advance(TICK)
        return self

    def told(self, *names: str) -> list[tuple[str, object]]:
        """Names and persons of events, of these only when some are named."""
        return [
            (event.name, event.properties.get("person"))
            for event in self.events
            if not names or event.name in names
        ]


@pytest.fixture
def theater(monkeypatch: pytest.MonkeyPatch) -> Iterator[object]:
    made: list[Theater] = []

    def build(stage: Stage, *devices: Description, **parameters: object) -> Theater:
        monkeypatch.setattr(people, "load_detectors", lambda setting: stage.detectors())
        made.append(Theater(stage, *devices, **parameters))
        return made[-1]

    yield build
    for built in made:
        for behavior in built.behaviors:
            behavior.stop()


def test_who_comes_and_goes_is_told_with_their_id(theater):
    stage = Stage(
        [
            Player(away_between(0.0, 0.5, until(5.0, standing(90))), **ANNA),
            Player(away_between(0.0, 1.5, until(3.0, standing(220))), **BEN),
        ]
    )
    comes = ("person.seen", "person.entered", "person.left", "person.lost")
    shown = theater(stage).show(9.0)
    assert shown.told(*comes) == [
        ("person.seen", "p1"),
        ("person.entered", "p1"),
        ("person.entered", "p2"),
        ("person.left", "p2"),
        ("person.left", "p1"),
        ("person.lost", "p1"),
    ]
    assert shown.told("person.looked") == [("person.looked", "p1"), ("person.looked", "p2")]


def test_looking_away_and_back_is_told(theater):
    def turning(time: float) -> Spot:
        return Spot(160, 100, 50, 0.0, 0.9 if 1.5 <= time < 3 else 0.0)

    shown = theater(Stage([Player(turning)])).show(4.5)
    assert shown.told("person.looked", "person.looked_away") == [
        ("person.looked", "p1"),
        ("person.looked_away", "p1"),
        ("person.looked", "p1"),
    ]
    looks = [row["now"] for row in shown.notes.rows if row["is_looked_at"]]
    away = max(later - now for now, later in pairwise(looks))
    assert away == pytest.approx(1.5, abs=0.3)


def test_coming_nearer_and_going_away_is_told_with_the_distance(theater):
    def walking(time: float) -> Spot:
        near = min(1.0, max(0.0, time - 1.5)) - min(1.0, max(0.0, time - 4.0))
        return Spot(160, 110, 30 + 30 * near)

    shown = theater(Stage([Player(walking)])).show(6.0)
    moves = [e for e in shown.events if e.name in ("person.approached", "person.moved_away")]
    names = [event.name for event in moves]
    assert names == sorted(names)
    assert set(names) == {"person.approached", "person.moved_away"}
    distances = [event.properties["distance"] for event in moves]
    assert min(distances) < 0.8 < 1.2 < max(distances)


def test_when_the_pictures_end_whoever_was_there_is_gone_after_three_seconds(theater):
    shown = theater(Stage([Player(standing())])).show(1.0)
    shown.projector.is_on = False
    shown.show(5.0)
    lost = next(event for event in shown.events if event.name == "person.lost")
    assert lost.time == pytest.approx(4.0, abs=0.2)
    seen = [row["now"] for row in shown.notes.rows if row["is_seen"]]
    assert seen[-1] == pytest.approx(2.0, abs=0.2), "and counts as seen for a second"
    assert shown.notes.last("people").persons == ()


def test_pictures_in_which_nothing_can_be_seen_keep_nobody_here(theater):
    shown = theater(Stage([Player(standing())])).show(1.0)
    shown.projector.odd = [np.zeros((1, 1, 3), np.uint8)] * round(5 / TICK)
    shown.show(4.5)
    assert shown.told("person.left", "person.lost") == [
        ("person.left", "p1"),
        ("person.lost", "p1"),
    ]
    assert shown.show(2.0).told("person.entered") == [
        ("person.entered", "p1"),
        ("person.entered", "p2"),
    ]


def test_the_eyes_meet_those_of_the_one_who_is_attended_to(theater):
    shown = theater(Stage([Player(standing(x=240, y=60))])).show(1.0)
    gaze = shown.notes.last("gaze")
    person = shown.notes.last("people").persons[0]
    ahead, left, up = gaze.point
    assert ahead > 0 > left, "to the robot's right, where the person is"
    assert up > 0
    assert np.linalg.norm(gaze.point) == pytest.approx(person.distance, rel=0.1)
    assert gaze == gaze_at(person)


def test_a_newcomer_draws_a_glance_and_then_the_eyes_return(theater):
    stage = Stage(
        [
            Player(standing(90, size=NEAR), **ANNA),
            Player(away_between(0.0, 2.0, standing(250, size=40)), **BEN),
        ]
    )
    shown = theater(stage).show(5.0)
    looked_at = [row["person"] for row in shown.notes.rows if row["person"]]
    changes = [looked_at[0]] + [b for a, b in pairwise(looked_at) if a != b]
    assert changes == ["p1", "p2", "p1"]
    assert 0.5 < looked_at.count("p2") * TICK < 1.2


def test_the_eyes_stay_on_whom_they_are_told_to_look_at(theater):
    stage = Stage([Player(standing(90, size=NEAR), **ANNA), Player(standing(250, size=40), **BEN)])
    shown = theater(stage).show(2.0)
    assert shown.notes.last("person") == "p1"
    shown.attention.look_at("p2")
    assert shown.show(0.5).notes.last("person") == "p2"
    shown.attention.look_at("")
    assert shown.show(0.5).notes.last("person") == "p1"


def test_engagement_is_told_when_it_begins_and_ends(theater):
    def visiting(time: float) -> Spot:
        return Spot(160, 110, NEAR if 1.5 <= time < 4.0 else 22)

    shown = theater(Stage([Player(visiting)])).show(9.0)
    assert shown.told("person.engaged", "person.disengaged") == [
        ("person.engaged", "p1"),
        ("person.disengaged", "p1"),
    ]
    levels = [row["level"] for row in shown.notes.rows]
    changes = [levels[0]] + [b for a, b in pairwise(levels) if a != b]
    assert changes == ["unengaged", "engaging", "engaged", "disengaging", "unengaged"]
    assert max(row["count"] for row in shown.notes.rows) == 1.0


def test_broken_pictures_cost_nothing_but_themselves(theater):
    shown = theater(Stage([Player(standing())]))
    shown.projector.odd = [np.zeros(shape, np.uint8) for shape in ((1, 1, 3), (5,), (9, 9))]
    assert shown.show(1.0).told("person.seen") == [("person.seen", "p1")]


def test_a_failure_is_told_and_it_goes_on(theater):
    stage = Stage([Player(standing())])
    shown = theater(stage).show(1.0)
    fit = stage.fit

    def fail(image, region):
        stage.fit = fit
        raise ValueError("no memory left")

    stage.fit = fail
    shown.show(1.0)
    failed = [event for event in shown.events if event.name == "vision.failed"]
    assert [event.properties["reason"] for event in failed] == ["ValueError: no memory left"]
    assert shown.told("person.left") == [("person.left", "p1")]
    assert [person.id for person in shown.notes.last("people").persons] == ["p2"]


def test_directions_are_those_of_the_configured_camera_and_of_its_neck(theater, monkeypatch):
    place = {"x": "10", "yaw": "0.2", "field_of_view": "0.8"}
    devices = (
        Description("world", "Hri.SimulatedWorld"),
        Description("camera", "Hri.SimulatedCamera", place, bus="world"),
    )
    monkeypatch.setattr(SimulatedCamera, "pan", lambda self, now: 0.3 if now > 1 else 0.0)
    shown = theater(Stage([Player(standing(160))]), *devices)
    bearing = shown.show(0.9).notes.last("people").persons[0].bearing
    assert bearing == pytest.approx(0.2, abs=0.02)
    bearing = shown.show(1.0).notes.last("people").persons[0].bearing
    assert bearing == pytest.approx(0.5, abs=0.02)


def test_two_showings_are_alike(theater):
    def told() -> list[str]:
        stage = Stage([Player(standing(90), **ANNA), Player(standing(200, size=60), **CARA)])
        shown = theater(stage).show(2.0)
        return [repr(shown.notes.rows), repr(shown.events)]

    assert told() == told()
