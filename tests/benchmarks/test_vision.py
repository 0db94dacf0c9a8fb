"""The bench of seeing: that it counts right. What it counts is measured by `hri bench vision`."""

import itertools

import numpy as np
import pytest

from benchmarks.vision import crossing, nods, recordings, videos
from benchmarks.vision.script import scripts
from hri.bench import vision
from hri.core.errors import HriError
from hri.core.signals import FaceBox, HeadGesture, HeadPose, People, Person
from hri.simulation.people.actors import ACTORS


def test_films_have_all_gestures_one_after_the_other_with_a_distractor_before_each() -> None:
    films = scripts(40)
    gestures = [gesture for film in films for gesture in film.gestures]
    assert len(gestures) == 40
    assert {gesture.kind for gesture in gestures} == {"nod", "shake"}
    for film in films:
        starts = [
            (made.start, other.start)
            for made, other in zip(film.gestures, film.distractions, strict=True)
        ]
        assert all(distraction < gesture for gesture, distraction in starts)
        assert all(one[0] < other[1] for one, other in itertools.pairwise(starts))
        assert film.gestures[-1].end < film.duration


def test_films_are_of_faces_kept_for_tests_and_the_same_each_time() -> None:
    for one, other in zip(scripts(20), scripts(20), strict=True):
        assert one == other
        assert one.film(30.0).lens == other.film(15.0).lens
        assert all(ACTORS[role.actor].is_for_tests for role in one.film(30.0).roles)


def test_films_of_nods_have_twenty_of_them_within_thirty_seconds_after_a_turn() -> None:
    for seed in range(nods.SEEDS):
        made = nods.nods(seed)
        spans = made.spans()
        assert len(spans) == nods.NODS
        assert spans[0][0] > nods.TURN_AT + nods.TURN_S
        assert all(one[0] < other[0] for one, other in itertools.pairwise(spans))
        assert spans[-1][1] <= nods.DURATION + nods.SLACK
        assert made(0.9).yaw == pytest.approx(nods.TURN if made.stays_turned else 0.0, abs=0.18)


def test_a_nod_that_is_told_twice_counts_once() -> None:
    made = nods.nods(0)
    first, second, *_ = made.starts
    found = [told("nod", first + 0.5), told("nod", first + 0.9), told("shake", second + 0.5)]
    assert nods.hits(made, found) == 1
    assert nods.hits(made, [*found, told("nod", second + 0.5)]) == 2


def test_an_unknown_part_is_refused_with_the_nearest() -> None:
    with pytest.raises(HriError, match='no part "nod" - did you mean "nods"'):
        vision.measure(only="nod")


def told(kind: str, time: float) -> HeadGesture:
    return HeadGesture(kind, time)


def test_each_gesture_counts_once_and_all_else_is_a_false_alarm() -> None:
    script = scripts(5)[0]
    first, second, *_ = script.gestures
    right = [told(first.kind, first.start + 0.4), told(second.kind, second.end + 0.3)]
    judgment = videos.score(script, right)
    assert (judgment.hits, judgment.of, judgment.alarms) == (2, 5, [])
    assert judgment.latencies[0] == pytest.approx(0.4)
    twice = videos.score(script, [*right, told(first.kind, first.start + 0.5)])
    assert (twice.hits, len(twice.alarms)) == (2, 1)
    wrong = videos.score(script, [told(second.kind, first.start + 0.4)])
    assert (wrong.hits, wrong.alarms) == (0, [f"{second.kind} for {first.kind}"])
    early = videos.score(script, [told(first.kind, first.start - 0.1)])
    assert early.hits == 0


def people(time: float, *places: tuple[str, float, float]) -> People:
    boxes = ((id, FaceBox(x - 20, y - 20, 40, 40)) for id, x, y in places)
    return People(time, tuple(Person(id, HeadPose(time, 0, 0, box=box)) for id, box in boxes))


def test_ids_are_told_by_the_face_they_are_at_unless_faces_are_close() -> None:
    roles = crossing.crossing_roles(0)
    start = [
        crossing.OPTICS.show(role.actor, held, role.right, role.distance).center
        for role in roles
        if (held := role.posture(0.0))
    ]
    seen = people(0.0, ("p1", *start[0]), ("p2", *start[1]))
    assert crossing.ids_at(seen, roles) == ["p1", "p2"]
    swapped = people(0.0, ("p2", *start[0]), ("p1", *start[1]))
    assert crossing.ids_at(swapped, roles) == ["p2", "p1"]
    times = np.arange(0, crossing.SECONDS, 0.05)
    assert any(crossing.ids_at(people(time), roles) is None for time in times)


def test_recordings_are_resampled_and_given_the_noise_of_a_camera() -> None:
    times = np.arange(0, 4, 1 / 75)
    angles = np.zeros((len(times), 3))
    recording = recordings.Recording("other_00", "other", times, angles)
    poses = list(recording.poses(30.0, 1.0, seed=1))
    assert len(poses) == pytest.approx(120, abs=1)
    assert np.degrees(np.std([pose.pitch for pose in poses])) == pytest.approx(0.6, rel=0.2)
    assert np.degrees(np.std([pose.yaw for pose in poses])) == pytest.approx(0.3, rel=0.2)
    assert poses == list(recording.poses(30.0, 1.0, seed=1))
