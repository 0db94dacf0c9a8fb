import math
from itertools import pairwise

import pytest
from hypothesis import assume, given, settings, strategies as st

from hri.emotion.emotions import EMOTIONS, NAMES, SLOW_SHARES
from hri.emotion.label import (
    CALM,
    CLEAR,
    FALL,
    LEAD,
    MOODS,
    NARROW,
    NOTHING,
    OCTANTS,
    RISE,
    course,
    label_at,
    mood_name,
)

TAU = {emotion.name: emotion.tau_s for emotion in EMOTIONS}
RATES = {name: 1 / tau for name, tau in TAU.items()}
charges = st.dictionaries(st.sampled_from(NAMES), st.floats(0, 5, exclude_min=True), max_size=8)
rivals = st.dictionaries(
    st.sampled_from(NAMES), st.integers(1, 500).map(lambda cents: cents / 100), max_size=2
)
"""Two at most: of three, two may take the lead between two looks."""
labels = st.sampled_from((NOTHING, *NAMES))


def label(current: str, start: dict[str, float], seconds: float = 0.0) -> str:
    return label_at(course(current, start, RATES), seconds)


def faded(start: dict[str, float], seconds: float) -> dict[str, float]:
    return {name: charge * math.exp(-RATES[name] * seconds) for name, charge in start.items()}


def test_the_strongest_emotion_gives_the_label() -> None:
    assert label(NOTHING, {"joy": 1.0, "pride": 0.6}) == "joy"
    assert label(NOTHING, {"joy": 0.9 * RISE}) == NOTHING
    assert label(NOTHING, {}) == label("joy", {}) == NOTHING


def test_of_equals_the_one_that_lasts_longer_has_the_label() -> None:
    assert label(NOTHING, {"joy": 1.0, "satisfaction": 1.0}) == "satisfaction"


def test_a_label_is_kept_until_it_has_faded_well_below() -> None:
    start = {"joy": 0.5}
    falls = TAU["joy"] * math.log(0.5 / FALL)
    assert label("joy", start, falls - 0.01) == "joy"
    assert label("joy", start, falls + 0.01) == NOTHING
    assert label("joy", {"joy": (RISE + FALL) / 2}) == "joy"
    assert label(NOTHING, {"joy": (RISE + FALL) / 2}) == NOTHING


def test_a_rival_must_clearly_lead() -> None:
    assert label("joy", {"joy": 1.0, "fear": 1.1}) == "joy"
    assert label("joy", {"joy": 1.0, "fear": 1.01 * LEAD}) == "fear"


def test_surprise_gives_way_to_what_lasts_longer() -> None:
    steps = course(NOTHING, {"surprise": 1.4, "fear": 0.6, "anger": 0.5}, RATES)
    assert [name for _, name in steps] == ["surprise", "anger", NOTHING]
    times = [at for at, _ in steps]
    assert times[0] == 0.0
    assert times == sorted(times)


@settings(deadline=None)
@given(labels, charges)
def test_a_course_begins_now_and_ends_with_nothing(current: str, start: dict[str, float]) -> None:
    steps = course(current, start, RATES)
    times = [at for at, _ in steps]
    assert times[0] == 0.0
    assert all(one < other for one, other in pairwise(times))
    assert steps[-1][1] == NOTHING
    assert all(one[1] != other[1] for one, other in pairwise(steps))


@settings(deadline=None)
@given(labels, charges, st.floats(0, 100), st.floats(0, 1))
def test_it_does_not_matter_when_anyone_looks(
    current: str, start: dict[str, float], seconds: float, share: float
) -> None:
    first = seconds * share
    steps = course(current, start, RATES)
    # On the edge itself rounding decides.
    assume(all(abs(at - moment) > 1e-6 for at, _ in steps for moment in (first, seconds)))
    between = label_at(steps, first)
    later = label(between, faded(start, first), seconds - first)
    assert later == label_at(steps, seconds)


@settings(deadline=None, max_examples=40)
@given(labels, rivals)
def test_the_closed_form_is_what_somebody_who_looks_all_the_time_would_see(
    current: str, start: dict[str, float]
) -> None:
    steps = course(current, start, RATES)
    look = 0.1
    assume(all(other - one > 3 * look for (one, _), (other, _) in pairwise(steps)))
    seen = current
    for tick in range(300):
        now = tick * look
        seen = _watched(seen, faded(start, now))
        if not any(0 < now - at <= 2 * look for at, _ in steps):
            assert seen == label_at(steps, now)


def _watched(current: str, levels: dict[str, float]) -> str:
    """The rule as it is told. A quick part counts with the slow one that comes with it."""
    levels = {name: level / (1 - SLOW_SHARES.get(name, 0.0)) for name, level in levels.items()}
    own = levels.get(current, 0.0)
    others = {n: v for n, v in levels.items() if v >= RISE and n != current}
    if current != NOTHING and own >= FALL:
        others = {name: level for name, level in others.items() if level >= LEAD * own}
        if not others:
            return current
    return min(others, key=lambda n: (-others[n], RATES[n], n), default=NOTHING)


def test_near_the_origin_the_mood_is_calm() -> None:
    assert mood_name((0.0, 0.0, 0.0)) == CALM
    assert mood_name((CLEAR / 2, 0.6, 0.6)) == mood_name((-CLEAR / 2, 0.6, 0.6)) == CALM
    assert mood_name((0.3, 0.2 * NARROW, -0.2 * NARROW)) == "peaceful"
    assert len(set(MOODS)) == 9


@given(st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_the_name_of_a_mood_never_contradicts_the_sign_of_an_axis(mood) -> None:
    name = mood_name(mood)
    for signs, known in OCTANTS.items():
        if name == known:
            assert abs(mood[0]) >= CLEAR
            assert all(
                abs(axis) < NARROW or (axis > 0.0) == sign
                for axis, sign in zip(mood, signs, strict=True)
            )


@pytest.mark.parametrize("mood", [(-1.0, 1.0, -1.0), (1.0, -1.0, 1.0)])
def test_the_corners_have_names(mood: tuple[float, float, float]) -> None:
    assert mood_name(mood) in MOODS
