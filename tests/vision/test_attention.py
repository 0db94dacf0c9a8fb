"""Looking, taking part, being attended to: what is told of one person over time."""

import itertools
import math
from dataclasses import replace

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import HeadPose, People, Person
from hri.vision.attention import Attending
from hri.vision.engagement import DISENGAGING, ENGAGED, ENGAGING, UNENGAGED, Engagement, Zones
from hri.vision.eye_contact import EyeContact, looking_score
from hri.vision.tracking.presence import Presence

ANN = Person("p1", HeadPose(0.0, 0.0, 0.0), distance=1.2, looking=1.0, is_looking=True)
BOB = replace(ANN, id="p2")


@given(st.floats(allow_nan=True), st.floats(allow_nan=True))
def test_the_score_falls_with_the_angle_and_stays_within_its_range(pitch, yaw):
    score = looking_score(pitch, yaw)
    assert 0 <= score <= 1
    if math.isfinite(pitch) and math.isfinite(yaw):
        assert looking_score(pitch * 1.1, yaw) <= score
        assert looking_score(pitch, -yaw) == score


def test_who_faces_the_camera_looks_and_who_shows_the_cheek_does_not():
    assert looking_score(0.1, 0.05) == 1.0
    assert 0 < looking_score(0.0, math.radians(20)) < 1
    assert looking_score(0.0, math.radians(35)) == 0.0


def test_looking_begins_and_ends_after_a_moment_and_does_not_flutter():
    looking = EyeContact()
    told = [looking.update(i / 10, score) for i, score in enumerate([1.0] * 5)]
    assert told == [False, False, True, True, True]
    told = [looking.update(0.5 + i / 10, 0.45) for i in range(20)]
    assert all(told), "between the two scores nothing changes"
    assert looking.update(2.5, 0.0), "one wrong pose is not a look away"
    assert looking.update(2.6, 1.0)
    told = [looking.update(2.7 + i / 10, 0.0) for i in range(8)]
    assert told == [True] * 5 + [False] * 3


def levels(*steps: tuple[float, float, bool]) -> list[str]:
    """Levels after each step of (seconds, meters, looking), asked ten times a second."""
    engagement, now, told = Engagement(), 0.0, []
    for seconds, distance, looks in steps:
        for _ in range(round(seconds * 10)):
            level = engagement.update(now, distance, looks)
            now += 0.1
        told.append(level)
    return told


def test_who_comes_near_and_looks_is_engaged_until_they_leave():
    assert levels((1, 3.0, True), (1, 1.4, True), (1, 0.9, True), (1, 1.4, True)) == [
        UNENGAGED,
        ENGAGING,
        ENGAGED,
        ENGAGED,
    ]
    assert levels((1, 0.9, True), (1, 2.0, True), (3, 2.0, True))[1:] == [DISENGAGING, UNENGAGED]


def test_who_passes_by_without_a_look_is_never_engaged():
    assert levels((2, 1.4, False), (2, 0.7, False), (2, 2.0, False)) == [UNENGAGED] * 3


def test_who_looks_away_for_long_disengages_and_comes_back_by_looking():
    told = levels((1, 0.9, True), (2, 0.9, False), (2, 0.9, False), (1, 0.9, True))
    assert told == [ENGAGED, ENGAGED, DISENGAGING, ENGAGED]
    assert levels((1, 0.9, True), (9, 0.9, False)) == [ENGAGED, UNENGAGED]


def test_at_the_edge_of_the_zone_nothing_flutters():
    engagement = Engagement()
    told = [engagement.update(i / 10, 1.5 + (0.1 if i % 2 else -0.05), True) for i in range(100)]
    assert sum(a != b for a, b in itertools.pairwise(told)) <= 1


def test_an_unknown_distance_is_far_away():
    assert levels((2, math.nan, True)) == [UNENGAGED]


@given(
    st.lists(st.tuples(st.floats(0, 4), st.floats(0, 5) | st.just(math.nan), st.booleans())),
    st.floats(0.2, 1.5),
)
def test_levels_only_change_to_neighbors(steps, inner):
    engagement, now = Engagement(Zones(inner=inner)), 0.0
    before = engagement.level
    allowed = {
        (UNENGAGED, ENGAGING),
        (ENGAGING, ENGAGED),
        (ENGAGING, UNENGAGED),
        (ENGAGED, DISENGAGING),
        (DISENGAGING, ENGAGED),
        (DISENGAGING, UNENGAGED),
    }
    for seconds, distance, looks in steps:
        now += seconds
        level = engagement.update(now, distance, looks)
        assert level == before or (before, level) in allowed
        before = level


def test_the_first_is_attended_to_and_stays_so_though_another_is_as_near():
    attending = Attending()
    assert attending.choose(0.0, [ANN]) == "p1"
    nearer = replace(BOB, distance=1.1)
    assert {attending.choose(i / 10, [ANN, nearer]) for i in range(60)} == {"p1"}


def test_attention_goes_to_who_clearly_asks_for_it_after_a_moment():
    attending = Attending()
    distracted = replace(ANN, looking=0.0, is_looking=False)
    talking = replace(BOB, distance=0.8, engagement=ENGAGED)
    attending.choose(0.0, [ANN])
    told = [attending.choose(i / 10, [distracted, talking]) for i in range(30)]
    assert told[5] == "p1"
    assert told[-1] == "p2"
    assert sum(a != b for a, b in itertools.pairwise(told)) == 1


def test_who_is_covered_for_a_moment_keeps_the_attention_and_who_is_gone_does_not():
    attending = Attending()
    attending.choose(0.0, [ANN, BOB])
    hidden = replace(ANN, is_visible=False)
    assert attending.choose(0.5, [hidden, BOB]) == "p1"
    assert attending.choose(1.5, [hidden, BOB]) == "p2"
    assert attending.choose(9.0, []) == ""


def test_time_that_goes_back_does_not_hold_the_attention():
    attending = Attending()
    attending.choose(1000.0, [ANN])
    attending.choose(0.0, [BOB])
    assert attending.choose(2.0, [BOB]) == "p2"


def happenings(*shown: People) -> list[tuple[str, str]]:
    presence = Presence()
    return [(h.name, h.person) for people in shown for h in presence.update(people)]


def test_the_first_who_comes_is_seen_and_the_last_who_goes_is_lost():
    told = happenings(
        People(0.0, (replace(ANN, is_looking=False),)),
        People(0.1, (replace(ANN, is_looking=False), replace(BOB, is_looking=False))),
        People(0.2, (replace(BOB, is_looking=False),)),
        People(0.3),
    )
    assert told == [
        ("person.seen", "p1"),
        ("person.entered", "p1"),
        ("person.entered", "p2"),
        ("person.left", "p1"),
        ("person.left", "p2"),
        ("person.lost", "p2"),
    ]


def test_who_leaves_looks_away_first():
    told = happenings(People(0.0, (ANN,)), People(9.0))
    assert told[2:] == [
        ("person.looked", "p1"),
        ("person.looked_away", "p1"),
        ("person.left", "p1"),
        ("person.lost", "p1"),
    ]


def test_a_step_nearer_is_told_and_a_sway_is_not():
    def at(time: float, distance: float) -> People:
        return People(time, (replace(ANN, distance=distance),))

    sway = [at(i / 10, 1.2 + 0.1 * (-1) ** i) for i in range(30)]
    told = happenings(*sway, at(3.0, 0.75), at(3.1, 1.2), at(3.2, math.nan))
    names = [name for name, _ in told if name in ("person.approached", "person.moved_away")]
    assert names == ["person.approached", "person.moved_away"]


@pytest.mark.parametrize("distance", [math.nan, math.inf])
def test_a_distance_that_is_unknown_is_no_move(distance):
    steps = [People(i / 10, (replace(ANN, distance=distance),)) for i in range(20)]
    assert not [name for name, _ in happenings(*steps) if "approached" in name or "moved" in name]
