import math

import pytest

from hri.simulation.people.person import WALK_TIME, SimulatedPerson
from hri.simulation.world import SimulatedWorld

TIMES = [i / 100 for i in range(300)]


def pitches(person: SimulatedPerson) -> list[float]:
    return [math.degrees(person.head(time).pitch) for time in TIMES]


def yaws(person: SimulatedPerson) -> list[float]:
    return [math.degrees(person.head(time).yaw) for time in TIMES]


def turns(angles: list[float], least: float) -> int:
    """How many swings of at least that many degrees there are."""
    count, extreme, direction = 0, angles[0], 0
    for angle in angles:
        if abs(angle - extreme) >= least and (angle > extreme) != (direction > 0):
            count, direction = count + 1, 1 if angle > extreme else -1
            extreme = angle
        elif (angle - extreme) * direction > 0 or not direction:
            extreme = angle if direction else extreme
    return count


def test_a_head_at_rest_only_sways() -> None:
    person = SimulatedPerson(seed=3)
    assert max(map(abs, pitches(person) + yaws(person))) < 2.5


def test_a_nod_swings_up_and_down_and_a_shake_to_both_sides() -> None:
    person = SimulatedPerson()
    person.nod(1.0)
    assert turns(pitches(person), 4) >= 3
    assert turns(yaws(person), 4) == 0
    person = SimulatedPerson()
    person.shake(1.0)
    assert turns(yaws(person), 6) >= 3
    assert turns(pitches(person), 4) == 0


def test_a_glance_goes_aside_and_comes_back() -> None:
    person = SimulatedPerson()
    person.look_aside(0.5)
    assert max(map(abs, yaws(person))) > 20
    assert turns(yaws(person), 6) == 2


def test_a_movement_changes_nothing_before_and_after_itself() -> None:
    still, moved = SimulatedPerson(seed=1), SimulatedPerson(seed=1)
    moved.nod(1.0)
    assert still.head(0.99) == moved.head(0.99)
    assert still.head(2.8) == moved.head(2.8)
    assert still.head(1.7) != moved.head(1.7)


def test_coming_and_going_takes_a_walk() -> None:
    person = SimulatedPerson(starts_present=False)
    person.enter(1.0)
    person.enter(2.0)  # is there already
    person.leave(5.0)
    assert not person.is_present(0.5)
    assert person.is_present(1.0 + WALK_TIME / 2)
    assert person.aside(1.0 + WALK_TIME) == 0.0
    assert person.is_present(5.0 + WALK_TIME / 2)
    assert not person.is_present(5.0 + WALK_TIME)


def test_sentences_follow_each_other_and_move_the_mouth(world: SimulatedWorld) -> None:
    person = world.person
    first, second = person.say("hello there", 1.0), person.say("robot", 1.2)
    assert first is not None
    assert second is not None
    assert second.start > first.end
    assert person.mouth(0.9) == 0.0
    assert person.mouth(1.3) > 0.3
    assert person.mouth(second.end + 0.1) == 0.0


def test_without_a_voice_nothing_is_said() -> None:
    assert SimulatedPerson().say("hello", 1.0) is None


def test_the_eyes_blink_now_and_then() -> None:
    person = SimulatedPerson(seed=2)
    lids = [person.lids(time / 50) for time in range(60 * 50)]
    assert min(lids) < 0.2
    assert sum(lids) / len(lids) == pytest.approx(1.0, abs=0.05)


def test_whoever_looks_ahead_turns_to_where_they_go_and_stays_so() -> None:
    person = SimulatedPerson()
    there = person.go(3.0, 0.0, at=1.0, speed=0.5, looks_ahead=True)
    assert there == pytest.approx(7.0)
    robot = math.pi
    assert person.facing(0.9, robot) == robot
    assert abs(person.facing(3.0, robot)) == pytest.approx(0.0, abs=1e-6)
    assert abs(person.facing(20.0, robot)) == pytest.approx(0.0, abs=1e-6)
    assert person.place(4.0) == pytest.approx((1.5, 0.0))
    assert person.posture(4.0).stride != 0


def test_whoever_does_not_faces_the_robot() -> None:
    person = SimulatedPerson()
    person.go(3.0, 0.0, at=1.0)
    for time in (0.0, 2.0, 20.0):
        assert person.facing(time, 0.7) == pytest.approx(0.7)
