import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Image
from hri.simulation.people.body_motion import (
    DISTRACTORS,
    GESTURES,
    MOTIONS,
    REST,
    Posture,
    idle_angles,
)
from hri.simulation.people.scripted_film import Film, Role

seeds = st.integers(0, 10**6)
FIELDS = Posture.__dataclass_fields__


def amounts(posture: Posture) -> list[float]:
    return [getattr(posture, name) for name in FIELDS]


def swings(angles: list[float], least: float) -> int:
    """How many swings of at least that many degrees there are."""
    count, extreme, direction = 0, 0.0, 0
    for angle in np.degrees(angles):
        if abs(angle - extreme) >= least and (angle > extreme) != (direction > 0):
            count, direction = count + 1, 1 if angle > extreme else -1
            extreme = angle
        elif direction and (angle - extreme) * direction > 0:
            extreme = angle
    return count


@given(st.sampled_from(sorted(MOTIONS)), seeds)
@settings(max_examples=40, deadline=None)
def test_every_motion_begins_and_ends_at_rest_and_never_jumps(name: str, seed: int) -> None:
    motion = MOTIONS[name]
    assert motion.at(-0.01, seed) == motion.at(motion.duration + 0.01, seed) == REST
    for time in (0.0, motion.duration):
        assert amounts(motion.at(time, seed)) == pytest.approx([0] * len(FIELDS), abs=1e-6)
    times = np.arange(0, motion.duration, 1 / 100)
    course = np.array([amounts(motion.at(time, seed)) for time in times])
    angles, places = course[:, :3], course[:, 3:6]
    assert np.abs(np.diff(angles, axis=0)).max() < math.radians(3.5)
    assert np.abs(np.diff(places, axis=0)).max() < 0.01
    assert course[:, 6:8].min() >= 0
    assert course[:, 6:8].max() <= 1


@given(st.sampled_from([name for name in DISTRACTORS if name != "look_around"]), seeds)
@settings(max_examples=40, deadline=None)
def test_no_distractor_is_a_nod_or_a_shake(name: str, seed: int) -> None:
    """None swings three times to and fro as far as a gesture does; looks around are slower."""
    motion = MOTIONS[name]
    course = [motion.at(i / 100, seed) for i in range(round(100 * motion.duration))]
    assert swings([posture.pitch for posture in course], 6) < 3
    assert swings([posture.yaw for posture in course], 8) < 3


def test_gestures_swing_three_times() -> None:
    for name, axis in zip(GESTURES, ("pitch", "yaw"), strict=True):
        course = [MOTIONS[name].at(i / 100) for i in range(120)]
        assert swings([getattr(posture, axis) for posture in course], 8) >= 3


def test_talking_moves_the_mouth_and_walking_the_place() -> None:
    talking = [MOTIONS["talk"].at(i / 50, 4).mouth for i in range(200)]
    assert max(talking) > 0.4
    walking = [MOTIONS["walk"].at(i / 50, 4) for i in range(250)]
    assert np.ptp([posture.right for posture in walking]) > 0.1
    assert np.ptp([posture.down for posture in walking]) == pytest.approx(0.04, abs=0.01)


def test_postures_add() -> None:
    assert Posture(pitch=1, mouth=0.5) + Posture(pitch=2, smile=1) == Posture(
        pitch=3, mouth=0.5, smile=1
    )


def pictures(film: Film) -> list[Image]:
    return [frame.image for frame in film.frames()]


def test_a_film_is_the_same_each_time_and_shows_who_is_there() -> None:
    def comes(time: float) -> Posture | None:
        return REST if time >= 0.1 else None

    film = Film([Role(comes), Role(actor="mei", right=0.2)], duration=0.2, rate=20)
    first = pictures(film)
    assert len(first) == 4
    assert all(np.array_equal(a, b) for a, b in zip(first, pictures(film), strict=True))
    steps = [np.abs(a.astype(int) - b).mean() for a, b in itertools.pairwise(first)]
    assert steps[1] > 2 * max(steps[0], steps[2])
    assert [frame.time for frame in film.frames()] == [0.0, 0.05, 0.1, 0.15]


def test_a_role_tells_what_the_film_shows() -> None:
    role = Role(lambda time: Posture(yaw=0.3), seed=5)
    held = role.posture(2.0)
    assert held is not None
    assert held.yaw == pytest.approx(0.3 + idle_angles(2.0, 5)[1])
    assert Role(lambda time: None).posture(0.0) is None
