"""Gestures of several people, by two signals, from a robot that turns; and in a network."""

import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.vision import nods as bench
from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Output
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event, HeadGesture, HeadPose, People, Person, Pose2D
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.body_motion import nod_angles, shake_angles
from hri.vision.camera_view import FACE_SIZE
from hri.vision.gestures.gesture_behaviors import HeadGestures, PeopleGestures
from hri.vision.gestures.gesture_fusion import GestureFusion
from hri.vision.gestures.gesture_patterns import Pattern, answer_patterns, load_patterns
from hri.vision.gestures.optical_flow_swing import FADE, RADIUS
from hri.vision.tracking.egomotion import Egomotion, Steadied

RATE = 30
PATTERNS = answer_patterns()
Angles = Callable[[float], tuple[float, float, float]]


def still(time: float) -> tuple[float, float, float]:
    return 0.0, 0.0, 0.0


def nod(time: float) -> tuple[float, float, float]:
    return nod_angles(time - 1)


def shake(time: float) -> tuple[float, float, float]:
    return shake_angles(time - 1)


def single(time: float) -> tuple[float, float, float]:
    return nod_angles(time - 1, cycles=0.7)


def person(
    time: float, pose: Angles = still, motion: Angles | None = still, id: str = "p1"
) -> Person:
    told = None if motion is None else HeadPose(time, *motion(time))
    return Person(id, HeadPose(time, *pose(time)), told, distance=1.0)


def watched(
    pose: Angles,
    motion: Angles | None,
    prompted: bool = False,
    patterns: Iterable[Pattern] = PATTERNS,
) -> list[HeadGesture]:
    recognizer = GestureFusion(patterns)
    times = [number / RATE for number in range(4 * RATE)]
    found = [recognizer.update(person(time, pose, motion), prompted) for time in times]
    return [gesture for gesture in found if gesture is not None]


def test_what_both_signals_call_a_nod_is_one() -> None:
    (gesture,) = watched(nod, nod)
    assert (gesture.kind, gesture.person) == ("nod", "p1")
    assert gesture.time - gesture.latency == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("prompted", [False, True])
def test_what_only_one_signal_tells_is_no_gesture(prompted: bool) -> None:
    assert watched(nod, still, prompted) == []
    assert watched(still, nod, prompted) == []
    assert watched(nod, shake, prompted) == []
    assert watched(nod, lambda time: nod(time - 2), prompted) == []


def test_signals_may_tell_a_little_apart() -> None:
    assert [gesture.kind for gesture in watched(nod, lambda time: nod(time - 0.2))] == ["nod"]


def test_the_motion_needs_one_swing_less() -> None:
    two = [gesture.kind for gesture in watched(nod, single)]
    assert two == ["nod"]
    assert watched(single, nod) == []


def test_the_motion_tells_nothing_of_roll_so_that_the_pose_decides() -> None:
    def tilted(time: float) -> tuple[float, float, float]:
        return 0.0, 0.0, math.radians(18) * min(1.0, max(0.0, (time - 1) / 0.4))

    (tilt,) = watched(tilted, still, patterns=load_patterns().values())
    assert tilt.kind == "tilt"


def test_without_motion_the_pose_alone_decides() -> None:
    assert [gesture.kind for gesture in watched(shake, None)] == ["shake"]


def test_motion_that_is_missing_for_a_moment_does_not_leave_it_to_the_pose() -> None:
    recognizer = GestureFusion(PATTERNS)
    for number in range(4 * RATE):
        time = number / RATE
        motion = still if time < 1 else None
        assert recognizer.update(person(time, nod, motion)) is None


def people(time: float, *persons: Person, attended: str = "") -> People:
    return People(time, persons, attended)


def gestures_of_two(attended: str) -> list[tuple[str, str]]:
    recognizer, told = PeopleGestures(PATTERNS), []
    for number in range(4 * RATE):
        time = number / RATE
        pair = person(time, single, single, "p1"), person(time, shake, shake, "p2")
        for gesture in recognizer.update(people(time, *pair, attended=attended), prompted=True):
            told.append((gesture.person, gesture.kind))
    return sorted(told)


def test_each_person_is_told_by_themselves() -> None:
    assert gestures_of_two("p1") == [("p1", "nod"), ("p2", "shake")]


def test_a_single_nod_is_an_answer_only_of_the_one_who_is_asked() -> None:
    assert gestures_of_two("p2") == [("p2", "shake")]
    assert gestures_of_two("") == [("p1", "nod"), ("p2", "shake")]


def test_who_comes_back_begins_anew() -> None:
    recognizer, told = PeopleGestures(PATTERNS), []
    for number in range(4 * RATE):
        time = number / RATE
        here = [person(time, nod, nod)] if not 1.2 < time < 1.3 else []
        told += recognizer.update(people(time, *here))
    assert all(gesture.latency < 1 for gesture in told)


def turning(time: float) -> float:
    """Heading of a robot that swings a little to and fro, radians."""
    return 0.007 * math.sin(2 * math.pi * 1.2 * time)


def seen_while_turning(distance: float = 1.0) -> list[Person]:
    """Somebody who keeps still before a robot that turns: the picture moves all the same."""
    persons, yaw, before = [], 0.0, turning(0)
    for number in range(4 * RATE):
        time = number / RATE
        shift = (turning(time) - before) * distance / FACE_SIZE
        before = turning(time)
        yaw = yaw * math.exp(-1 / RATE / FADE) + shift / RADIUS
        pose = HeadPose(time, 0.0, yaw)
        persons.append(Person("p1", pose, distance=distance))
    return persons


def test_the_robots_own_turning_is_no_shake() -> None:
    own = Egomotion()
    plain, steadied = PeopleGestures(PATTERNS), PeopleGestures(PATTERNS, own)
    told: list[list[HeadGesture]] = [[], []]
    for each in seen_while_turning(distance=1.5):
        own.add(each.pose.time, turning(each.pose.time))
        for found, recognizer in zip(told, (plain, steadied), strict=True):
            found += recognizer.update(people(each.pose.time, each), prompted=True)
    assert [gesture.kind for gesture in told[0][:1]] == ["shake"]
    assert told[1] == []


def test_own_turning_is_taken_at_the_time_of_the_picture() -> None:
    own = Egomotion()
    for number in range(20):
        own.add(number / 10, 0.1 * number)
    assert own.turned(0.55, 1.25) == pytest.approx(0.7)
    assert own.turned(1.85, 9.0) == pytest.approx(0.05)
    assert own.turned(-5.0, 0.0) == 0.0


def test_a_full_turn_is_no_jump() -> None:
    own = Egomotion()
    own.add(0.0, math.pi - 0.1)
    own.add(1.0, -math.pi + 0.1)
    assert own.turned(0.0, 1.0) == pytest.approx(0.2)


def test_pictures_of_a_fast_turn_are_not_believed() -> None:
    own = Egomotion()
    steadied = Steadied(own)
    assert steadied.update(person(0.0)) is not None
    own.add(0.0, 0.0)
    own.add(0.1, 0.2)
    assert steadied.update(person(0.1)) is None
    assert steadied.update(person(0.2)) is not None


def test_a_pose_from_the_mesh_is_left_as_it_is() -> None:
    own = Egomotion()
    steadied, mesh = Steadied(own), np.zeros((468, 3), np.float32)
    for number in range(10):
        own.add(number / 10, 0.005 * number)
        before = replace(person(number / 10, nod, nod), landmarks=mesh)
        after = steadied.update(before)
        assert after is not None
        assert after.pose == before.pose
    assert after.motion != before.motion


def test_own_turning_is_taken_out_of_motion_though_no_mesh_was_fitted_to_the_picture() -> None:
    own = Egomotion()
    steadied, mesh = Steadied(own), np.zeros((468, 3), np.float32)
    for number in range(10):
        own.add(number / 10, 0.005 * number)
        pose, motion = HeadPose(0.0, 0.0, 0.0), HeadPose(number / 10, 0.0, 0.0)
        after = steadied.update(Person("p1", pose, motion, distance=1.0, landmarks=mesh))
    assert after is not None
    assert after.motion is not None
    assert after.motion.yaw < -0.1


numbers = st.floats(-1e3, 1e3) | st.sampled_from([math.nan, math.inf, -math.inf, 1e300])


@given(st.lists(st.tuples(numbers, numbers, numbers, numbers), max_size=40))
@settings(max_examples=30, deadline=None)
def test_nothing_breaks_it(rows: list[tuple[float, float, float, float]]) -> None:
    own = Egomotion()
    recognizer = PeopleGestures(PATTERNS, own)
    for time, pitch, yaw, heading in rows:
        own.add(time, heading)
        pose = HeadPose(time, pitch, yaw)
        recognizer.update(people(time, Person("p1", pose, pose, distance=heading)), yaw > 0)


class Script(Behavior):
    """Shows somebody who does something, and where the robot looks."""

    people = Output[People]("people", "one person")
    pose = Output[HeadPose]("headpose", "the same head")
    prompted = Output[bool]("boolean", "a question is open")
    odometry = Output[Pose2D]("pose", "the robot stands still")
    angles: Angles

    def compute(self, now: float, dt: float) -> None:
        self.people.send(people(now, person(now, self.angles, self.angles)))
        self.pose.send(HeadPose(now, *self.angles(now)))
        self.prompted.send(True)
        self.odometry.send(Pose2D())


def events_of(angles: Angles, port: str, **parameters: object) -> list[Event]:
    clock = FakeClock()
    bus, events = EventBus(clock), []
    bus.subscribe("*", events.append)
    script, gestures = Script(), HeadGestures(**parameters)
    script.angles = angles
    getattr(gestures, port).sources.append(getattr(script, port))
    gestures.prompted.sources.append(script.prompted)
    gestures.odometry.sources.append(script.odometry)
    context = Context(clock, bus, ResourceManager([], clock))
    gestures.start(context)
    for _ in range(3 * RATE):
        script.compute(clock.now(), 1 / RATE)
        gestures.compute(clock.now(), 1 / RATE)
        clock.advance(1 / RATE)
    return events


@pytest.mark.proves("R07")
@pytest.mark.parametrize(("port", "who"), [("people", "p1"), ("pose", "")])
@pytest.mark.parametrize(("angles", "name"), [(nod, "head.nodded"), (shake, "head.shaken")])
def test_a_gesture_is_told_by_an_event(angles: Angles, name: str, port: str, who: str) -> None:
    (event,) = events_of(angles, port)
    assert event.name == name
    assert event.properties["person"] == who
    assert 0.4 <= event.properties["confidence"] <= 1
    assert 0.1 <= event.properties["latency"] <= 0.9


class Pair(Behavior):
    """Shows two people who nod at once."""

    people = Output[People]("people", "two persons")

    def compute(self, now: float, dt: float) -> None:
        pair = (person(now, nod, nod, id) for id in ("p1", "p2"))
        self.people.send(people(now, *pair))


def test_two_who_nod_at_once_are_both_sent() -> None:
    script, gestures, clock = Pair(), HeadGestures(), FakeClock()
    gestures.people.sources.append(script.people)
    gestures.start(Context(clock, EventBus(clock), ResourceManager([], clock)))
    sent = []
    for _ in range(3 * RATE):
        gestures.gesture.value = None
        script.compute(clock.now(), 1 / RATE)
        gestures.compute(clock.now(), 1 / RATE)
        sent.append(gestures.gesture.value)
        clock.advance(1 / RATE)
    assert [gesture.person for gesture in sent if gesture is not None] == ["p1", "p2"]


@pytest.mark.proves("R07")
def test_a_network_chooses_its_gestures() -> None:
    def tilted(time: float) -> tuple[float, float, float]:
        return 0.0, 0.0, 0.3 * min(1.0, max(0.0, (time - 1) / 0.4))

    assert events_of(tilted, "pose") == []
    assert [event.name for event in events_of(tilted, "pose", gestures="all")] == ["head.tilted"]
    assert [e.name for e in events_of(tilted, "pose", gestures="nod tilt")] == ["head.tilted"]
    with pytest.raises(HriError, match='did you mean "tilt"'):
        events_of(tilted, "pose", gestures="tlit")


def nodding(pose_noise: float = 0.6, late: float = 0.1) -> list[HeadGesture]:
    """Twenty nods after a turn of the head, as mesh and motion tell of them, 15 times a second."""
    dice, nods = np.random.default_rng(0), bench.nods(0)
    recognizer, found = GestureFusion(PATTERNS), []
    for number in range(round(15 * bench.DURATION)):
        time = number / 15
        held, moved = nods(time), nods(time - late)
        noise = np.radians(dice.normal(0.0, pose_noise, 3))
        told = Person(
            "p1",
            HeadPose(time, held.pitch + noise[0], held.yaw + noise[1], noise[2]),
            HeadPose(time, moved.pitch, moved.yaw),
        )
        if (gesture := recognizer.update(told)) is not None:
            found.append(gesture)
    return found


def test_who_nods_again_and_again_is_told_each_time() -> None:
    found = nodding()
    assert bench.hits(bench.nods(0), found) >= bench.FOUND
    assert {gesture.kind for gesture in found} == {"nod"}


def test_an_answer_is_told_once_however_long_somebody_nods() -> None:
    def lasting(time: float) -> tuple[float, float, float]:
        return nod_angles(time - 0.3, cycles=6.0, frequency=1.8)

    assert len(watched(lasting, lasting)) == 3
    assert len(watched(lasting, lasting, prompted=True)) == 1


def test_a_nod_that_one_signal_tells_late_is_told() -> None:
    def lasting(time: float) -> tuple[float, float, float]:
        return nod_angles(time - 0.3, cycles=9.0, frequency=1.8)

    def turned_first(time: float) -> tuple[float, float, float]:
        return lasting(time) if time > 2.0 else (0.0, nod_angles(time)[0], 0.0)

    assert "nod" in [gesture.kind for gesture in watched(lasting, turned_first)]


@pytest.mark.parametrize("prompted", [False, True])
@pytest.mark.parametrize("rate", [15, 30])
@pytest.mark.parametrize("seed", range(3))
def test_still_pictures_one_switched_for_another_are_no_gesture(
    seed: int, rate: int, prompted: bool
) -> None:
    shown, dice = bench.pictures(seed), np.random.default_rng(seed)
    recognizer = GestureFusion(PATTERNS)
    for number in range(10 * rate):
        held = shown(number / rate)
        down, left = np.radians(dice.normal(0.0, 0.4, 2))
        pose = HeadPose(number / rate, held.pitch + down, held.yaw + left)
        assert recognizer.update(Person("p1", pose, pose), prompted) is None
