import math
from collections.abc import Callable, Iterable

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import HeadGesture, HeadPose
from hri.vision.gestures.angle_noise import Noise
from hri.vision.gestures.gesture_patterns import answer_patterns, load_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

RATE = 30.0
ANSWERS = answer_patterns()
EVERYTHING = list(load_patterns().values())
Angle = Callable[[float], float]


def nothing(time: float) -> float:
    return 0.0


def swing(degrees: float, hertz: float, cycles: float, start: float = 1.0) -> Angle:
    """A sine that begins at a time and ends after so many cycles."""

    def angle(time: float) -> float:
        phase = (time - start) * hertz
        return degrees * math.sin(2 * math.pi * phase) if 0 <= phase <= cycles else 0.0

    return angle


def series(
    pitch: Angle = nothing,
    yaw: Angle = nothing,
    roll: Angle = nothing,
    seconds: float = 4.0,
    noise: float = 0.2,
    rate: float = RATE,
) -> list[HeadPose]:
    """Poses so many a second; angles in degrees."""
    dice = np.random.default_rng(0)
    times = np.arange(0, seconds, 1 / rate)
    return [
        HeadPose(t, *np.radians(dice.normal((pitch(t), yaw(t), roll(t)), noise)).tolist())
        for t in times.tolist()
    ]


def recognize(poses: Iterable[HeadPose], prompted: bool = False) -> list[HeadGesture]:
    recognizer = GestureRecognizer(ANSWERS)
    found = [recognizer.update(pose, prompted) for pose in poses]
    return [gesture for gesture in found if gesture is not None]


def kinds(poses: Iterable[HeadPose], prompted: bool = False) -> list[str]:
    return [gesture.kind for gesture in recognize(poses, prompted)]


@pytest.mark.parametrize("hertz", [1.2, 1.8, 2.5])
@pytest.mark.parametrize("degrees", [5, 10])
def test_nods_and_shakes_are_told_apart(degrees: float, hertz: float) -> None:
    assert kinds(series(pitch=swing(degrees, hertz, 2))) == ["nod"]
    assert kinds(series(yaw=swing(degrees * 1.5, hertz, 2))) == ["shake"]


def test_a_long_nod_is_reported_once_and_the_next_one_again() -> None:
    assert kinds(series(pitch=swing(8, 2, 8), seconds=6)) == ["nod"]
    twice = [
        *series(pitch=swing(8, 2, 2), seconds=4),
        *(HeadPose(p.time + 4, p.pitch, p.yaw) for p in series(yaw=swing(12, 2, 2))),
    ]
    assert kinds(twice) == ["nod", "shake"]


def test_who_thinks_better_of_it_nods_and_shakes_at_once() -> None:
    nod, shake = swing(8, 2, 2), swing(14, 2, 2, start=2.1)
    assert kinds(series(pitch=nod, yaw=shake)) == ["nod", "shake"]


def test_it_is_seen_while_it_lasts_and_wide_ones_are_surer() -> None:
    small, wide = (recognize(series(pitch=swing(d, 1.5, 3)))[0] for d in (4, 12))
    assert wide.time < 1 + 3 / 1.5
    assert 0.5 <= small.confidence < wide.confidence <= 1


def test_a_single_nod_counts_only_as_an_answer() -> None:
    single = series(pitch=swing(9, 1.5, 0.5))
    assert kinds(single) == []
    assert kinds(single, prompted=True) == ["nod"]


def test_a_head_that_quivers_with_laughter_does_not_nod() -> None:
    assert kinds(series(pitch=swing(3.5, 4.8, 8), noise=0.1, rate=100)) == []


def test_a_small_nod_counts_only_as_an_answer() -> None:
    small = series(pitch=swing(1.6, 1.8, 3), noise=0.05)
    assert kinds(small) == []
    assert kinds(small, prompted=True) == ["nod"]


def test_a_head_that_fidgets_answers_nothing() -> None:
    fidgets = series(pitch=swing(1.6, 1.8, 2), noise=0.05)
    assert kinds(fidgets, prompted=True) == []


@pytest.mark.parametrize("hertz", [0.75, 0.9, 1.2])
def test_wide_nods_take_their_time(hertz: float) -> None:
    nods = recognize(series(pitch=swing(14, hertz, 3, start=0.1), seconds=5))
    assert [nod.kind for nod in nods] == ["nod"]
    assert nods[0].latency <= 2 * 0.5 / hertz, "reported in the third swing"
    assert kinds(series(yaw=swing(14, 0.75, 3), seconds=6)) == []


def test_who_looks_about_from_one_side_far_to_the_other_does_not_shake() -> None:
    def about(degrees: float) -> list[str]:
        return kinds(series(yaw=swing(degrees, 1.1, 1.5)))

    assert about(40) == ["shake"]
    assert about(52) == []


def test_what_was_done_before_the_question_is_no_answer() -> None:
    recognizer = GestureRecognizer(ANSWERS)
    poses = series(pitch=swing(9, 1.5, 0.5), seconds=3)
    found = [recognizer.update(pose, prompted=pose.time > 2.2) for pose in poses]
    assert not any(found)


@pytest.mark.parametrize("prompted", [False, True])
def test_a_glance_and_a_look_down_are_no_gestures(prompted: bool) -> None:
    def aside(time: float) -> float:
        return 25 * min(1.0, max(0.0, min(time - 1, 3 - time) / 0.4))

    assert kinds(series(yaw=aside), prompted) == []
    assert kinds(series(pitch=aside), prompted) == []


def test_a_nod_does_not_hide_in_a_shake() -> None:
    both = series(pitch=swing(5, 2, 3), yaw=swing(15, 2, 3))
    assert kinds(both, prompted=True) == ["shake"]


def test_thresholds_follow_the_noise() -> None:
    assert kinds(series(seconds=60, noise=0.6), prompted=True) == []
    assert len(kinds(series(seconds=60, noise=1.5))) <= 2


@pytest.mark.parametrize("degrees", [0.3, 2.0])
def test_the_noise_is_measured_whatever_the_head_does_and_as_it_is_now(degrees: float) -> None:
    noise = Noise()
    deaf = series(pitch=swing(10, 1.5, 2), noise=9.0, seconds=6)
    for pose in [*deaf, *series(pitch=swing(10, 1.5, 2), noise=degrees, seconds=6)]:
        noise.add((pose.pitch, pose.yaw, pose.roll))
    assert np.degrees(noise.deviations()) == pytest.approx([degrees] * 3, rel=0.4)


def test_poses_that_are_no_poses_are_passed_over() -> None:
    good = series(pitch=swing(8, 2, 2))
    broken = [
        odd
        for p in good
        for odd in (p, HeadPose(p.time + 0.001, math.nan, math.inf), HeadPose(math.nan, 0.0, 0.0))
    ]
    assert recognize(broken) == recognize(good)


@pytest.mark.parametrize("rate", [10.0, 15.0, 30.0, 100.0])
def test_any_rate_of_poses_will_do(rate: float) -> None:
    nod, shake = swing(8, 1.6, 2.5), swing(14, 1.6, 2.5)
    for noise in (0.0, 0.5):
        assert kinds(series(pitch=nod, rate=rate, noise=noise), prompted=True) == ["nod"]
        assert kinds(series(yaw=shake, rate=rate, noise=noise), prompted=True) == ["shake"]


@pytest.mark.parametrize("noise", [1.5, 3.0])
def test_noisy_poses_are_steadied(noise: float) -> None:
    assert kinds(series(pitch=swing(14, 1.5, 3), noise=noise)) == ["nod"]
    assert kinds(series(yaw=swing(20, 1.5, 3), noise=noise)) == ["shake"]


def test_latency_counts_from_where_the_movement_began() -> None:
    for start in (1.0, 1.5):
        (nod,) = recognize(series(pitch=swing(8, 1.8, 3, start), noise=0.1))
        assert nod.time - nod.latency == pytest.approx(start, abs=0.1)


def test_a_shake_after_a_slow_drift_begins_where_the_drift_ends() -> None:
    shaken = swing(14, 1.8, 2, start=4)

    def drifting(time: float) -> float:
        return 2 * min(4.0, time) + shaken(time)

    (shake,) = recognize(series(yaw=drifting, seconds=7, noise=0.1))
    assert shake.time - shake.latency == pytest.approx(4, abs=0.15)
    assert shake.latency < 0.65


def test_who_nods_while_turning_the_head_nods_all_the_same() -> None:
    found = kinds(series(pitch=swing(8, 2, 3), yaw=lambda t: 8 * t), prompted=True)
    assert found == ["nod"]


def test_a_look_to_one_side_and_far_to_the_other_is_no_shake() -> None:
    def about(time: float) -> float:
        # A little to the right first, as one does before a wide turn to the left.
        wound = -10 * math.sin(math.pi * min(1.0, max(0.0, (time - 1) / 0.5)))
        return wound + 80 * min(1.0, max(0.0, (time - 1.4) / 0.6))

    assert kinds(series(yaw=about), prompted=True) == []


def test_angles_that_go_round_at_half_a_turn_are_no_movement() -> None:
    behind = [
        HeadPose(p.time, p.pitch, math.remainder(p.yaw + math.pi, math.tau))
        for p in series(pitch=swing(8, 2, 3))
    ]
    assert kinds(behind) == ["nod"]


def test_other_gestures_are_found_when_they_are_asked_for() -> None:
    def held(degrees: float) -> Angle:
        return lambda time: degrees * min(1.0, max(0.0, (time - 1) / 0.4))

    def told(poses: list[HeadPose]) -> list[str]:
        recognizer = GestureRecognizer(EVERYTHING)
        found = [recognizer.update(pose) for pose in poses]
        return [gesture.kind for gesture in found if gesture is not None]

    assert told(series(roll=held(18))) == ["tilt"]
    assert told(series(pitch=held(-20))) == ["look_up"]
    assert told(series(pitch=held(20))) == []
    assert told(series(roll=swing(12, 1.5, 3))) == ["wobble"]
    assert told(series(pitch=swing(8, 2, 2))) == ["nod"]
    assert kinds(series(roll=held(18))) == []


def test_a_gap_makes_no_gesture_of_what_lies_around_it() -> None:
    before, after = series(seconds=1), series(pitch=lambda t: 20 * (t > 1.4), seconds=3)
    assert kinds([*before, *(p for p in after if p.time > 1.5)], prompted=True) == []


def test_it_goes_on_after_time_went_back() -> None:
    nods = series(pitch=swing(8, 2, 2))
    later = [HeadPose(p.time + 1000, p.pitch, p.yaw) for p in nods]
    assert kinds([*later, *nods]) == ["nod", "nod"]


numbers = st.floats(-1e3, 1e3) | st.sampled_from([math.nan, math.inf, -math.inf, 1e300])


@given(st.lists(st.tuples(numbers, numbers, numbers, st.booleans()), max_size=60))
@settings(max_examples=50, deadline=None)
def test_nothing_breaks_it(rows: list[tuple[float, float, float, bool]]) -> None:
    recognizer = GestureRecognizer(EVERYTHING)
    for time, pitch, yaw, prompted in rows:
        gesture = recognizer.update(HeadPose(time, pitch, yaw, pitch), prompted)
        if gesture is not None:
            assert 0 <= gesture.confidence <= 1
            assert 0 <= gesture.latency <= 3


@given(st.lists(st.floats(-1.2, 1.2), min_size=60, max_size=60), st.booleans())
@settings(max_examples=50, deadline=None)
def test_what_stays_below_the_least_swing_is_never_a_gesture(
    degrees: list[float], prompted: bool
) -> None:
    poses = [HeadPose(i / RATE, math.radians(d), -math.radians(d)) for i, d in enumerate(degrees)]
    assert kinds(poses, prompted) == []
