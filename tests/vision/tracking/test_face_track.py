"""The whole chain on films: with networks where they are fetched, with what is in OpenCV else."""

import itertools
import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest

from hri.core.signals import Frame, HeadGesture, People, Person
from hri.simulation.people.actors import Appearance, render_people
from hri.simulation.people.body_motion import Angles, nod_angles, shake_angles
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.gestures.gesture_fusion import GestureFusion
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer
from hri.vision.tracking.people import PeopleTracker
from tests.vision.film import Motion, film
from tests.vision.stage import Spot
from tests.vision.tracking.test_people import crossing


@pytest.fixture(params=["haar", "networks"])
def chain(request: pytest.FixtureRequest) -> Detectors:
    if request.param == "haar":
        return load_detectors("haar")
    found: Detectors = request.getfixturevalue("detectors")
    return found


def seen(frames: Iterable[Frame], chain: Detectors) -> list[Person]:
    """The first person of each picture in which they are in sight."""
    tracker = PeopleTracker(chain)
    firsts = [next(iter(tracker.see(frame).persons), None) for frame in frames]
    return [person for person in firsts if person is not None and person.is_visible]


def gestures(persons: list[Person]) -> list[HeadGesture]:
    recognizer = GestureRecognizer(answer_patterns())
    found = (recognizer.update(person.pose, True) for person in persons)
    return [gesture for gesture in found if gesture is not None]


def nod(time: float) -> Angles:
    return nod_angles(time - 0.8)


def shake(time: float) -> Angles:
    return shake_angles(time - 0.8)


@pytest.mark.parametrize(("motion", "axis"), [(nod, 0), (shake, 1)])
def test_the_angles_follow_those_of_the_head(motion: Motion, axis: int, chain: Detectors) -> None:
    persons = seen(film(motion, duration=2.1, rate=20), chain)
    for poses in ([p.pose for p in persons], [p.motion for p in persons if p.motion]):
        if not poses:
            assert chain.mesh is None
            continue
        angles = np.array([(pose.pitch, pose.yaw)[axis] for pose in poses])
        truth = np.array([motion(pose.time)[axis] for pose in poses])
        assert np.corrcoef(angles, truth)[0, 1] > 0.96
        angles, truth = angles - np.median(angles), truth - np.median(truth)
        assert truth @ angles / (truth @ truth) == pytest.approx(1.0, abs=0.2)


def swinging(angles: Callable[..., Angles], degrees: float, hertz: float) -> Motion:
    return lambda time: angles(time - 0.7, amplitude=math.radians(degrees), frequency=hertz)


GESTURES = [
    (kind, degrees, hertz, height, swinging(angles, degrees, hertz))
    for (kind, angles, degrees), (hertz, height) in itertools.product(
        [("nod", nod_angles, 8), ("shake", shake_angles, 12)], [(1.2, 105), (2.2, 140)]
    )
]


def test_nods_and_shakes_are_recognized_in_the_pictures(chain: Detectors) -> None:
    missed = []
    for seed, (kind, degrees, hertz, height, motion) in enumerate(GESTURES):
        frames = film(motion, 0.7 + 2 / hertz + 0.2, 15, height, seed=seed)
        if [gesture.kind for gesture in gestures(seen(frames, chain))] != [kind]:
            missed.append((kind, degrees, hertz, height))
    assert missed == []


def walk(time: float) -> tuple[float, float]:
    return -80 + 160 * time, 120 + 4 * math.sin(2 * math.pi * 1.8 * time)


def test_walking_through_the_picture_makes_no_gesture(chain: Detectors) -> None:
    persons = seen(film(duration=2.5, rate=12, place=walk), chain)
    assert len(persons) > 10
    assert len({person.id for person in persons}) == 1
    recognizer = GestureFusion(answer_patterns())
    assert [recognizer.update(person, False) for person in persons] == [None] * len(persons)


def jump(time: float) -> tuple[float, float]:
    away = 1.0 < time % 2 < 1.5
    return (900.0, 120.0) if away else (120.0 + 30 * (time // 2 % 3), 120.0)


def test_a_face_that_goes_and_comes_back_elsewhere_is_the_same_person(chain: Detectors) -> None:
    frames = film(duration=4, rate=12, place=jump)
    persons = seen(frames, chain)
    assert 20 < len(persons) < len(frames) * 0.95
    assert {person.id for person in persons} == {"p1"}
    assert gestures(persons) == []


def test_the_box_and_the_distance_are_in_pixels_of_the_frame(chain: Detectors) -> None:
    frames = film(duration=1)
    large = [Frame(f.image.repeat(2, 0).repeat(2, 1), f.time, f.sequence) for f in frames]
    small, person = seen(frames, chain)[-1], seen(large, chain)[-1]
    box = person.pose.box
    assert box is not None
    assert small.pose.box is not None
    assert box.x + box.width / 2 == pytest.approx(320, abs=16)
    assert box.width == pytest.approx(2 * small.pose.box.width, rel=0.1)
    # The head is 0.24 m high, and 105 of 240 pixels.
    expected = 160 / math.tan(1.05 / 2) * 0.24 / 105
    assert small.distance == pytest.approx(expected, rel=0.2)
    assert person.distance == pytest.approx(small.distance, rel=0.1)


def owners(people: People, spots: list[Spot | None]) -> dict[str, int]:
    """Whose face each id has: the number of the nearest spot."""
    nearest = {}
    for person in people.persons:
        if person.is_visible and (box := person.pose.box):
            middle = box.x + box.width / 2
            away = [abs(spot.x - middle) if spot else math.inf for spot in spots]
            nearest[person.id] = away.index(min(away))
    return nearest


def test_two_drawn_people_in_each_others_way_keep_their_ids(detectors: Detectors) -> None:
    players, duration = crossing("cross", 8)
    tracker, told = PeopleTracker(detectors), []
    for index in range(round(duration * 12)):
        spots = [player.part(index / 12) for player in players]
        shown = [
            Appearance(name, center=(spot.x, spot.y), height=2.2 * spot.size)
            for name, spot in zip(("bruno", "mei"), spots, strict=True)
            if spot is not None
        ]
        image = render_people(shown, (320, 240))
        people = tracker.see(Frame(image, index / 12, index))
        told.append(owners(people, spots))
    assert len(told[8]) == 2
    assert told[-1] == told[8]


def test_smile_brows_and_blink_are_told(detectors: Detectors) -> None:
    calm = Appearance("ada", center=(160.0, 130.0), height=170.0)
    at_rest = render_people([calm], (320, 240))

    def told(**look: float) -> tuple[float, float, float]:
        tracker, last = PeopleTracker(detectors), None
        moved = render_people([replace(calm, **look)], (320, 240))
        for index, image in enumerate([at_rest] * 9 + [moved] * 2):
            last = tracker.see(Frame(image, index / 8, index)).persons[0].countenance
        assert last is not None
        return last.smile, last.brows, last.blink

    assert told() == pytest.approx((0.0, 0.0, 0.0), abs=0.15)
    assert told(smile=1.0)[0] > 0.5
    assert told(mouth=0.8)[0] < 0.3, "who talks does not smile"
    assert told(brows=1.0)[1] > 0.5
    assert told(brows=-1.0)[1] < -0.15
    assert told(lids=0.0)[2] > 0.5


def test_a_film_gives_the_same_people_whatever_the_detectors_saw_before(
    detectors: Detectors,
) -> None:
    far = film(duration=1.0, height=40.0, place=lambda time: (250.0, 60.0))

    def told() -> list[str]:
        tracker = PeopleTracker(detectors)
        return [repr(tracker.see(frame)) for frame in far]

    first = told()
    assert "p1" in first[-1]
    for _ in range(3):
        PeopleTracker(detectors).see(far[0])
        assert told() == first
