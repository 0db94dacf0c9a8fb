"""People from behind, in drawn films with the real networks, and with whatever input."""

import math
import random
import subprocess
import sys
from collections.abc import Iterator, Sequence

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import FaceBox, Frame, People
from hri.simulation.people.actors import Optics, render_people
from hri.simulation.people.appearance import Outfit
from hri.simulation.people.body_motion import Posture, eased, steps
from hri.simulation.people.lens import Lens
from hri.vision.camera_view import CameraView
from hri.vision.detectors.body import find_body_at
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.tracking.body_track import BodyTrack, Surroundings
from hri.vision.tracking.clothes import Clothes, Colors
from hri.vision.tracking.people import PeopleTracker
from hri.vision.tracking.place import Place
from tests.vision.stage import SIZE, Stage

OPTICS = Optics(640, 480, 1.05)
RATE = 15.0
BLUE, RED = Outfit((44, 84, 160)), Outfit((176, 48, 44), (150, 132, 104))
TURNS = 1.5
"""Seconds, when the one who walks away turns around."""


class Walker:
    """Faces the camera, turns around, and walks away; or comes by."""

    def __init__(self, actor: str, outfit: Outfit) -> None:
        self.actor, self.outfit = actor, outfit

    def at(self, time: float) -> tuple[float, float, float] | None:
        """Meters to the right and ahead, and how far they are turned; None when not there."""
        part = eased((time - TURNS) / 0.7)
        return 0.1, 1.3 + 0.5 * max(0.0, time - TURNS - 0.4), math.pi * part


class Passing(Walker):
    """Comes by at a distance, from the right to the left, at some time."""

    def __init__(self, actor: str, outfit: Outfit, begins: float, ahead: float) -> None:
        super().__init__(actor, outfit)
        self._begins, self._ahead = begins, ahead

    def at(self, time: float) -> tuple[float, float, float] | None:
        right = 1.5 - 1.2 * (time - self._begins)
        return (right, self._ahead, -math.pi / 2) if -1.5 < right < 1.5 else None


def frames(walkers: Sequence[Walker], seconds: float) -> Iterator[Frame]:
    lens = Lens(3.0)
    for index in range(round(seconds * RATE)):
        time = index / RATE
        shown = []
        for walker in walkers:
            if (there := walker.at(time)) is not None:
                right, ahead, turn = there
                held = steps(time) if time > TURNS else Posture()
                look = OPTICS.show(walker.actor, held, right, ahead, 1.0, turn, walker.outfit)
                shown.append(look)
        yield Frame(lens.take(render_people(shown, OPTICS.size), index), time, index)


def seen(detectors: Detectors, walkers: Sequence[Walker], seconds: float) -> list[People]:
    tracker = PeopleTracker(detectors, CameraView(OPTICS.field_of_view))
    return [tracker.see(frame) for frame in frames(walkers, seconds)]


def test_who_turns_around_and_walks_away_stays_the_same_person(detectors: Detectors) -> None:
    guide = Walker("ada", BLUE)
    people = seen(detectors, [guide], 5.0)
    assert {person.id for each in people for person in each.persons} == {"p1"}
    for each in people[round(2.6 * RATE) :]:
        (person,) = each.persons
        assert person.is_visible
        assert not person.has_face
        assert person.since == 0.0
        assert person.pose.box is None
        assert person.landmarks is None
        assert person.body is not None
        right, ahead, _ = guide.at(each.time)
        assert person.distance == pytest.approx(ahead, rel=0.25)
        assert person.bearing == pytest.approx(-math.atan2(right, ahead), abs=0.05)
        assert not person.is_looking


@pytest.mark.parametrize("clothes", [RED, Outfit(BLUE.shirt, RED.trousers)])
def test_who_passes_between_is_not_taken_for_them(detectors: Detectors, clothes: Outfit) -> None:
    guide = Walker("ada", BLUE)
    people = seen(detectors, [guide, Passing("kofi", clothes, 3.0, 0.9)], 6.5)
    for each in people[round(2.6 * RATE) :]:
        person = each.person("p1")
        assert person is not None
        if person.is_visible:
            right, ahead, _ = guide.at(each.time)
            assert person.bearing == pytest.approx(-math.atan2(right, ahead), abs=0.1)
    last = people[-1].person("p1")
    assert last is not None
    assert last.is_visible


def test_who_comes_where_someone_went_away_is_someone_else(detectors: Detectors) -> None:
    class Leaving(Walker):
        def at(self, time: float) -> tuple[float, float, float] | None:
            return super().at(time) if time < 3.0 else None

    people = seen(detectors, [Leaving("ada", BLUE), Passing("kofi", RED, 3.2, 2.0)], 5.5)
    for each in people[round(3.1 * RATE) :]:
        first = each.person("p1")
        assert first is None or not first.is_visible


def test_who_looks_down_stays_in_sight(detectors: Detectors) -> None:
    lens, tracker = Lens(3.0), PeopleTracker(detectors, CameraView(OPTICS.field_of_view))
    for index in range(45):
        time = index / RATE
        pitch = 1.2 * eased((time - 1.2) / 0.5)
        shown = OPTICS.show("bruno", Posture(pitch=pitch), 0.0, 1.3, outfit=RED)
        image = lens.take(render_people([shown], OPTICS.size), index)
        people = tracker.see(Frame(image, time, index))
        assert [person.id for person in people.persons if person.is_visible] == ["p1"]


TOLD = """
from tests.vision.tracking.test_body_track import told
print(told())
"""


def told() -> str:
    """All that is said of the people of a film."""
    people = seen(load_detectors(), [Walker("mei", RED), Passing("bruno", BLUE, 2.0, 0.9)], 3.5)
    return repr(
        [
            [(p.id, p.is_visible, p.has_face, p.distance, p.bearing, p.body) for p in each.persons]
            for each in people
        ]
    )


def test_one_film_gives_the_same_people_twice_and_in_another_process(face_models: object) -> None:
    first = told()
    assert told() == first
    other = subprocess.run(
        [sys.executable, "-c", TOLD], capture_output=True, text=True, check=True, timeout=300
    )
    assert other.stdout.strip() == first


def test_clothes_are_like_themselves_and_unlike_others() -> None:
    where = Place(320.0, 240.0, 554 * 0.178 / 2)
    clothes = Clothes()
    pictures = [
        Colors.of(
            render_people([OPTICS.show("ada", Posture(), 0.0, 2.0, outfit=outfit)], OPTICS.size)
        )
        for outfit in (BLUE, RED, Outfit(BLUE.shirt, BLUE.trousers, 0.5))
    ]
    assert clothes.likeness(pictures[0], where) is None
    clothes.learn(pictures[0], where)
    same, other, striped = (clothes.likeness(picture, where) for picture in pictures)
    assert same is not None
    assert other is not None
    assert striped is not None
    assert same.mean > 0.95
    assert other.mean < 0.4
    assert striped.mean < 0.8


@pytest.mark.parametrize("actor", ["ada", "kofi", "mei"])
def test_the_outline_of_a_back_is_found_where_it_is_expected(actor: str) -> None:
    shown = OPTICS.show(actor, Posture(stride=0.5), 0.2, 5.0, turn=math.pi)
    image = Lens(2.0).take(render_people([shown], OPTICS.size, 3), 0)
    where = Place(*shown.center, 0.178 * shown.height / 0.24)
    found = find_body_at(image, Place(where.x + 6, where.y, 1.1 * where.breadth).body)
    assert found is not None
    assert Place.on_body(found).away(where) < 0.4
    assert Place.on_body(found).breadth == pytest.approx(where.breadth, rel=0.3)
    assert find_body_at(render_people([], OPTICS.size, 3), where.body) is None


def test_an_outline_counts_only_in_their_clothes_and_near_where_they_were() -> None:
    where, around = Place(320.0, 240.0, 20.0), Surroundings(0.1, 240.0)
    blue, red = (
        Colors.of(render_people([OPTICS.show("ada", Posture(), 0.0, 4.93, outfit=o)], OPTICS.size))
        for o in (BLUE, RED)
    )
    clothes, body = Clothes(), BodyTrack()
    clothes.learn(blue, where)
    body.rest_on(where, Surroundings(0.0, 240.0))
    assert body.take(red, clothes, where, around) is None
    assert body.take(blue, clothes, Place(420.0, 240.0, 20.0), around) is None
    assert body.take(blue, clothes, Place(320.0, 240.0, 40.0), around) is None
    assert body.take(blue, clothes, Place(322.0, 241.0, 21.0), around) is not None


def test_who_stands_behind_someone_else_is_not_seen_in_their_clothes() -> None:
    shown = OPTICS.show("ada", Posture(), 0.0, 2.0, turn=math.pi, outfit=BLUE)
    where = Place(*shown.center, 0.178 * shown.height / 0.24)
    colors = Colors.of(render_people([shown], OPTICS.size))
    nearer = Place(where.x, where.y, 1.8 * where.breadth)

    def found(*others: Place) -> Place | None:
        clothes, body = Clothes(), BodyTrack()
        clothes.learn(colors, where)
        clothes.look_around(colors, where)
        body.rest_on(where, Surroundings(0.0, 240.0))
        assert not body.is_behind(where)
        assert body.is_behind(nearer)
        return body.follow(colors, clothes, Surroundings(0.1, 240.0, others))

    assert found() is not None
    assert found(nearer) is None
    assert found(Place(where.x + 4 * where.breadth, where.y, where.breadth)) is not None


def test_nobody_comes_near_in_a_jerk() -> None:
    body = BodyTrack()
    body.rest_on(Place(320.0, 240.0, 40.0), Surroundings(0.0, 240.0))
    body.place, body.seen = Place(320.0, 240.0, 40.0), 1.0
    assert not body.contradicts(1.6, Place(400.0, 240.0, 44.0)), "they may have walked aside"
    assert body.contradicts(1.6, Place(320.0, 240.0, 90.0))
    assert not body.contradicts(2.5, Place(320.0, 240.0, 90.0))


numbers = st.floats(allow_nan=True, allow_infinity=True)


@settings(max_examples=60, deadline=None)
@given(
    st.integers(1, 90),
    st.integers(1, 90),
    st.integers(0, 2**32 - 1),
    st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=6),
)
def test_whatever_comes_a_body_is_somewhere_or_nowhere(
    width: int, height: int, seed: int, places: list[tuple[float, float, float]]
) -> None:
    dice = np.random.default_rng(seed)
    image = dice.integers(0, 256, (height, width, 3), np.uint8)
    colors, clothes, body = Colors.of(image), Clothes(), BodyTrack()
    home = Place(width / 2, height / 4, max(1.0, height / 12))
    for number, values in enumerate(places):
        place, time = Place(*values), number / 15
        around = Surroundings(time, height / 2, [Place(*values)])
        for each in (place, home):
            clothes.learn(colors, each)
            clothes.look_around(colors, each)
            body.rest_on(each, around)
            clothes.likeness(colors, each, is_behind=True)
        found = body.follow(colors, clothes, Surroundings(time + 0.05 + number, height / 2))
        assert found is None or found.is_somewhere


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 200), st.integers(1, 200), numbers, numbers, numbers, numbers)
def test_whatever_box_is_expected_an_outline_is_found_or_not(
    width: int, height: int, x: float, y: float, wide: float, high: float
) -> None:
    image = np.random.default_rng(width).integers(0, 256, (height, width, 3), np.uint8)
    find_body_at(image, FaceBox(x, y, wide, high))
    find_body_at(image, FaceBox(0.0, 0.0, width, height))


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_whatever_the_pictures_ids_are_kept_and_few_are_remembered(seed: int) -> None:
    lots, dice = random.Random(seed), np.random.default_rng(seed)
    stage = Stage([])
    stage.players = []
    tracker = PeopleTracker(stage.detectors())
    time = 0.0
    for index in range(40):
        time += lots.choice((0.03, 0.07, 0.3, 1.0, -0.5))
        image = stage.image()
        if lots.random() < 0.5:
            image = dice.integers(0, 256, (SIZE[1], SIZE[0], 3), np.uint8)
        people = tracker.see(Frame(image, time, index))
        assert people.persons == ()
