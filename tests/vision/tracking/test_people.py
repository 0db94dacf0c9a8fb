import itertools
import math
import random

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.geometry import Pose3D
from hri.core.signals import FaceBox, Frame, People
from hri.vision.camera_view import CameraView
from hri.vision.tracking.people import MEMORY, PeopleTracker
from tests.vision.stage import SIZE, Part, Player, Spot, Stage, standing

ANNA = {"skin": (200, 150, 130), "hair": (60, 40, 30), "shirt": (40, 60, 160)}
BEN = {"skin": (150, 105, 80), "hair": (20, 18, 16), "shirt": (170, 50, 40)}
PUPILS = 0.69 / 1.6
"""Distance of the pupils on the stage, in heights of the face."""
CARA = {"skin": (230, 190, 170), "hair": (190, 160, 90), "shirt": (60, 140, 70)}


def tracker(stage: Stage, view: CameraView | None = None) -> PeopleTracker:
    return PeopleTracker(stage.detectors(), view)


def whose(stage: Stage, people: People) -> dict[str, int]:
    """Which player each visible id is."""
    owners = {}
    for person in people.persons:
        if person.is_visible and person.pose.box is not None:
            x = person.pose.box.x + person.pose.box.width / 2
            spots = [player.part(stage.time) for player in stage.players]
            away = [abs(spot.x - x) if spot else math.inf for spot in spots]
            if min(away) < 20:  # else it is the place where somebody has just left
                owners[person.id] = away.index(min(away))
    return owners


def until(end: float, part: Part) -> Part:
    return lambda time: part(time) if time < end else None


def away_between(begin: float, end: float, part: Part) -> Part:
    return lambda time: None if begin <= time < end else part(time)


def test_a_person_is_described_from_the_first_picture_on():
    stage = Stage([Player(standing())])
    people = list(stage.watch(tracker(stage), 1.0))
    first = people[0].persons[0]
    assert [(p.id, p.is_visible) for p in people[-1].persons] == [("p1", True)]
    assert people[-1].attended == "p1"
    assert first.pose.time == 0.0
    assert first.pose.box is not None
    assert first.landmarks is not None
    assert first.landmarks.shape == (468, 3)
    assert first.pose.box.height == pytest.approx(50, rel=0.1)


def test_the_picture_is_searched_only_when_somebody_may_be_found():
    stage = Stage([])
    list(stage.watch(tracker(stage), 3.0))
    assert 22 <= stage.searches <= 30, "ten times a second while nobody is there"
    stage = Stage([Player(standing())])
    list(stage.watch(tracker(stage), 3.0))
    assert stage.searches <= 8, "now and then while all are followed"
    assert stage.fits >= 44, "each face in each picture"


@pytest.mark.proves("R06")
def test_a_head_is_followed_while_it_turns_and_looking_starts_and_stops():
    def turning(time: float) -> Spot:
        return Spot(160, 100, 50, 0.0, 0.8 if 1 <= time < 2 else 0.0)

    stage = Stage([Player(turning)])
    seen = [(p.time, p.persons[0]) for p in stage.watch(tracker(stage), 3.0)]
    assert all(person.is_visible for _, person in seen)
    looks = [time for time, person in seen if person.is_looking]
    assert {time for time in looks if 0.3 < time < 1} == {t for t, _ in seen if 0.3 < t < 1}
    assert not [time for time in looks if 1.6 < time < 2.1]
    assert [time for time in looks if time > 2.3]
    turned = next(person for time, person in seen if time > 1.5)
    assert turned.pose.yaw == pytest.approx(0.8, abs=0.05)
    assert turned.looking == 0.0


@pytest.mark.parametrize("yaw", [0.0, 0.5, 0.9])
def test_the_distance_is_that_of_the_eyes_however_the_head_is_turned(yaw):
    stage = Stage([Player(lambda time: Spot(160, 100, 50, 0.0, yaw))])
    view = CameraView(field_of_view=1.0)
    person = list(stage.watch(tracker(stage, view), 0.3))[-1].persons[0]
    focal = 160 / math.tan(0.5)
    assert person.distance == pytest.approx(focal * 0.063 / (PUPILS * 50), rel=0.05)


def test_directions_count_from_the_robot_whatever_way_the_camera_is_turned():
    stage = Stage([Player(standing(x=240, y=60))])
    ahead = list(stage.watch(tracker(stage, CameraView(1.0)), 0.2))[-1].persons[0]
    turned = CameraView(1.0, Pose3D(yaw=0.4, pitch=-0.2))
    other = list(stage.watch(tracker(stage, turned), 0.2))[-1].persons[0]
    assert ahead.bearing < -0.2, "who is at the right of the picture is to the robot's right"
    assert ahead.elevation > 0.1
    assert other.bearing == pytest.approx(ahead.bearing + 0.4, abs=0.1)
    assert other.elevation == pytest.approx(ahead.elevation + 0.2, abs=0.1)


def test_who_comes_back_within_five_seconds_is_the_same_and_later_is_new():
    for gone, expected in ((2.5, ["p1"]), (4.5, ["p1"]), (5.5, ["p2"])):
        stage = Stage([Player(away_between(1.0, 1.0 + gone, standing()))])
        seen = list(stage.watch(tracker(stage), 7.5))
        assert [p.id for p in seen[-1].persons] == expected
        missing = [p for p in seen if p.persons and not p.persons[0].is_visible]
        assert missing, "who is out of sight is still here"
        assert max(p.time for p in missing) < 1.0 + MEMORY + 0.1


@pytest.mark.parametrize("back", [1.4, 2.0, 4.5])
def test_somebody_else_who_comes_in_their_place_is_somebody_else(back):
    stage = Stage(
        [
            Player(until(1.0, standing()), **ANNA),
            Player(away_between(0.0, back, standing()), **BEN),
        ]
    )
    seen = list(stage.watch(tracker(stage), back + 1.0))
    assert [p.id for p in seen[-1].persons if p.is_visible] == ["p2"]


def test_those_who_left_come_back_as_themselves_in_the_order_of_their_ids():
    stage = Stage(
        [
            Player(away_between(1.0, 5.0, standing(90)), **ANNA),
            Player(standing(220), **BEN),
        ]
    )
    seen = list(stage.watch(tracker(stage), 6.0))
    assert [p.id for p in seen[round(4.5 * 15)].persons] == ["p2"]
    assert [p.id for p in seen[-1].persons] == ["p1", "p2"]


def test_ids_do_not_shift_when_another_leaves():
    stage = Stage(
        [
            Player(until(1.0, standing(x=60)), **ANNA),
            Player(standing(x=160), **BEN),
            Player(standing(x=260), **CARA),
        ]
    )
    before: dict[str, int] = {}
    for people in stage.watch(tracker(stage), 5.0):
        now = whose(stage, people)
        before |= {id: now[id] for id in now if id not in before}
        assert all(before[id] == owner for id, owner in now.items())
    assert len(before) == 3
    assert [person.id for person in people.persons] == sorted(id for id in before if before[id])


CROSSINGS = ("cross", "turn back", "behind", "leave")


def crossing(kind: str, seed: int) -> tuple[list[Player], float]:
    """Two people who come in each other's way, and how long that takes."""
    dice = random.Random(seed)
    sizes = [size := dice.uniform(35, 60), size * dice.uniform(0.6, 0.92)]
    dice.shuffle(sizes)
    pace, heights = dice.uniform(60, 170), [100 + dice.uniform(-7, 7) for _ in range(2)]
    meeting = 0.8 + 120 / pace

    def across(time: float, side: int) -> Spot:
        way = min(240.0, pace * max(0.0, time - 0.8))
        return Spot(40 + way if side == 0 else 280 - way, heights[side], sizes[side])

    def turning(time: float, side: int) -> Spot:
        late = time - meeting - 0.1
        return across(time if late < 0 else max(0.8, meeting + 0.1 - late), side)

    def leaving(time: float) -> Spot | None:
        if time < 1.0 + gone:
            x = 225 + pace * max(0.0, time - 1.0)
        else:
            x = max(210.0, 320 - pace * (time - 1.0 - gone))
        return Spot(x, heights[1], sizes[1]) if x < SIZE[0] else None

    gone = dice.uniform(1.5, 2.5)
    parts: dict[str, tuple[Part, Part]] = {
        "cross": (lambda t: across(t, 0), lambda t: across(t, 1)),
        "turn back": (lambda t: turning(t, 0), lambda t: turning(t, 1)),
        "behind": (lambda t: across(t, 0), lambda t: Spot(160, heights[1], sizes[1])),
        "leave": (lambda t: Spot(110, heights[0], sizes[0]), leaving),
    }
    looks = dice.sample([ANNA, BEN, CARA], 2)
    duration = 1.8 + 240 / pace if kind != "leave" else 2.5 + gone
    return [Player(p, **look) for p, look in zip(parts[kind], looks, strict=True)], duration


@pytest.mark.proves("R06")
@pytest.mark.parametrize("kind", CROSSINGS)
def test_two_who_come_in_each_others_way_keep_their_ids(kind):
    for seed in range(3):
        players, duration = crossing(kind, seed)
        stage = Stage(players)
        seen = [(p.time, whose(stage, p)) for p in stage.watch(tracker(stage), duration)]
        first = next(owners for time, owners in seen if time >= 0.6)
        assert len(first) == 2
        assert seen[-1][1] == first, (kind, seed)


def test_a_face_is_never_two_people():
    players, duration = crossing("cross", 3)
    stage = Stage(players)
    for people in stage.watch(tracker(stage), duration):
        boxes = [p.pose.box for p in people.persons if p.is_visible and p.pose.box]
        for one, other in itertools.combinations(boxes, 2):
            assert math.hypot(one.x - other.x, one.y - other.y) > 5


def test_what_the_mesh_does_not_take_for_a_face_is_nobody():
    stage = Stage([Player(standing())], phantoms=[FaceBox(20, 20, 40, 40)])
    seen = list(stage.watch(tracker(stage), 2.0))
    assert [p.id for p in seen[-1].persons] == ["p1"]


@pytest.mark.parametrize(
    ("x", "y", "size", "count"),
    [(155, 185, 32, 1), (155, 200, 70, 2), (270, 185, 32, 2), (160, 20, 32, 2)],
)
def test_a_small_face_on_somebodys_neck_is_nobody(x, y, size, count):
    stage = Stage([Player(standing(y=100, size=100)), Player(standing(x, y, size))])
    stage.on_view = lambda: [(p, p.part(stage.time)) for p in stage.players]
    seen = list(stage.watch(tracker(stage), 2.0))
    assert len(seen[-1].persons) == count


def test_without_a_mesh_a_face_counts_when_it_was_found_twice():
    stage = Stage([Player(standing())], has_mesh=False)
    seen = list(stage.watch(tracker(stage), 2.0))
    assert seen[0].persons == ()
    person = seen[-1].persons[0]
    assert (person.id, person.landmarks, person.countenance) == ("p1", None, None)
    assert person.motion is None, "the pose is that of the motion already"
    assert person.pose.time == seen[-1].time
    assert person.distance == pytest.approx(277 * 0.178 / 50, rel=0.1)


def test_only_so_many_meshes_are_fitted_in_a_picture_and_each_face_has_its_turn():
    places = [(x, y) for y in (50, 150) for x in (40, 120, 200, 280)][:6]
    stage = Stage([Player(standing(x, y, 36)) for x, y in places])
    watching = tracker(stage)
    for _ in stage.watch(watching, 1.0):
        pass
    stage.fits = stage.searches = 0
    people = list(stage.watch(watching, 0.3, start=1.0))
    assert len(people[-1].persons) == 6
    assert stage.fits <= 4 * len(people) + 6 * stage.searches
    attended = people[-1].person(people[-1].attended)
    assert attended is not None
    assert attended.pose.time == people[-1].time
    assert all(people[-1].time - person.pose.time < 0.2 for person in people[-1].persons)


def test_a_crowd_is_bounded():
    stage = Stage([Player(standing(20 + 31 * i, 100, 24)) for i in range(10)])
    people = list(stage.watch(tracker(stage), 1.5))
    assert len(people[-1].persons) == 8


BROKEN = [
    np.zeros((1, 1, 3), np.uint8),
    np.zeros((240, 320), np.uint8),
    np.zeros((240, 320, 3), np.uint16),
    np.zeros((0, 320, 3), np.uint8),
]


@pytest.mark.parametrize("image", BROKEN)
def test_frames_that_are_no_pictures_change_nothing(image):
    stage = Stage([Player(standing())])
    watching = tracker(stage)
    before = list(stage.watch(watching, 0.5))[-1]
    assert watching.see(Frame(image, 0.52, 0)) == before
    assert watching.see(Frame(stage.image(), math.nan, 0)) == before


def test_when_time_goes_back_or_the_size_changes_everybody_is_new():
    stage = Stage([Player(standing())])
    watching = tracker(stage)
    list(stage.watch(watching, 0.5, start=10.0))
    assert [p.id for p in list(stage.watch(watching, 0.5))[-1].persons] == ["p2"]
    stage.time = 0.6
    large = stage.image().repeat(2, axis=0).repeat(2, axis=1)
    assert [p.id for p in watching.see(Frame(large, 0.6, 0)).persons] == ["p3"]


def test_a_stall_of_the_camera_costs_no_id():
    stage = Stage([Player(standing())])
    watching = tracker(stage)
    list(stage.watch(watching, 0.5))
    assert [p.id for p in list(stage.watch(watching, 0.5, start=2.0))[-1].persons] == ["p1"]


def test_who_sits_down_there_during_a_stall_is_somebody_else():
    stage = Stage(
        [
            Player(until(1.0, standing()), **ANNA),
            Player(away_between(0.0, 1.0, standing()), **BEN),
        ]
    )
    watching = tracker(stage)
    list(stage.watch(watching, 0.5))
    last = list(stage.watch(watching, 0.5, start=2.5))[-1]
    assert [p.id for p in last.persons if p.is_visible] == ["p2"]


def test_two_runs_are_alike():
    def run() -> list[str]:
        players, duration = crossing("turn back", 5)
        stage = Stage(players)
        return [repr(people) for people in stage.watch(tracker(stage), duration)]

    assert run() == run()


@settings(max_examples=12, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-0.1, 4.0), st.sampled_from([0, 1, 2, 3])), min_size=1, max_size=25
    )
)
def test_whatever_comes_ids_are_unique_and_in_order(steps):
    stage = Stage([Player(standing(90), **ANNA), Player(standing(220), **BEN)])
    everybody, watching, time = stage.players, tracker(stage), 0.0
    for step, here in steps:
        time += step
        stage.players = [player for i, player in enumerate(everybody) if here & (1 << i)]
        people = watching.see(Frame(stage.image(), time, 0))
        numbers = [int(person.id[1:]) for person in people.persons]
        assert numbers == sorted(set(numbers))
        assert people.attended in ("", *(person.id for person in people.persons))
        assert all(0 <= person.looking <= 1 for person in people.persons)
        assert sum(person.is_visible for person in people.persons) <= 2
