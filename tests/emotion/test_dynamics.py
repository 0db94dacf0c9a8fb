import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.core.errors import HriError
from hri.emotion.dynamics import Affect, Dynamics, drive_response
from hri.emotion.emotions import EMOTIONS, OPPOSITION, PAD
from hri.emotion.personality import Personality, load_personality
from hri.emotion.stimulus import StimulusSpec, load_stimuli

STIMULI = list(load_stimuli().values())
NAMES = [stimulus.name for stimulus in STIMULI]
PERSONALITIES = {
    name: load_personality(name)
    for name in ("neutral", "optimist", "pessimist", "shy", "hot_tempered", "easy_going")
}
DYNAMICS = {name: Dynamics(personality, STIMULI) for name, personality in PERSONALITIES.items()}
NEUTRAL = DYNAMICS["neutral"]

dynamics = st.sampled_from(list(DYNAMICS.values()))
streams = st.lists(
    st.tuples(st.floats(0, 120), st.sampled_from(NAMES), st.floats(0, 1)), min_size=1, max_size=12
)
"""Seconds since the one before, stimulus, intensity."""

Stream = list[tuple[float, str, float]]


def play(model: Dynamics, stream: Stream, until: float = 0.0) -> Affect:
    """The state `until` seconds after the last stimulus."""
    affect = model.rest()
    for wait, name, intensity in stream:
        affect = model.feel(affect, name, intensity, affect.time + wait)
    return model.advance(affect, affect.time + until)


def same(one: Affect, other: Affect, tolerance: float = 1e-9) -> bool:
    pairs = (
        (one.charges, other.charges),
        (one.mood, other.mood),
        (one.habituation, other.habituation),
    )
    return all(np.allclose(a, b, rtol=0, atol=tolerance) for a, b in pairs)


@settings(deadline=None)
@given(dynamics, streams, st.floats(0, 100))
def test_everything_stays_within_its_bounds(model: Dynamics, stream: Stream, until: float) -> None:
    state = model.read(play(model, stream, until))
    assert all(0 <= value <= 1 for value in state.emotions.values())
    assert all(-1 <= axis <= 1 for axis in (state.valence, state.arousal, state.dominance))
    assert 0 <= state.intensity <= 1


@settings(deadline=None)
@given(dynamics, streams, st.lists(st.floats(0, 300), min_size=1, max_size=20))
def test_any_partition_of_time_gives_the_same_state(
    model: Dynamics, stream: Stream, cuts: list[float]
) -> None:
    start = play(model, stream)
    end = start.time + max(cuts)
    stepped = start
    for cut in sorted(cuts):
        stepped = model.advance(stepped, start.time + cut)
    whole = model.advance(start, end)
    assert same(whole, model.advance(stepped, end))
    assert model.read(whole).label == model.read(stepped).label


@pytest.mark.parametrize("steps", [1, 10, 1000, 20000])
def test_ticks_make_no_difference(steps: int) -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "scold", 1.0, 0.0)
    stepped = affect
    for step in range(1, steps + 1):
        stepped = NEUTRAL.advance(stepped, 100.0 * step / steps)
    assert same(stepped, NEUTRAL.advance(affect, 100.0))


@settings(deadline=None)
@given(dynamics, streams)
def test_in_the_end_the_baseline_is_all_that_is_left(model: Dynamics, stream: Stream) -> None:
    affect = play(model, stream, until=20 * model.personality.return_s)
    assert np.allclose(model.mood(affect), model.personality.baseline, atol=1e-6)
    assert max(model.read(affect).emotions.values()) < 1e-6


@settings(deadline=None)
@given(dynamics, st.floats(0, 1e9))
def test_without_stimuli_nothing_changes(model: Dynamics, now: float) -> None:
    assert np.allclose(model.mood(model.rest()), model.personality.baseline, atol=1e-15)
    assert model.read(model.advance(model.rest(), now)) == model.read(model.rest())


@settings(deadline=None)
@given(dynamics, streams, st.integers(0, 11), st.floats(0, 1), st.floats(0, 200))
def test_a_stronger_stimulus_is_felt_more(
    model: Dynamics, stream: Stream, at: int, more: float, until: float
) -> None:
    at %= len(stream)
    wait, name, intensity = stream[at]
    stronger = [*stream]
    stronger[at] = (wait, name, intensity + (1 - intensity) * more)
    weak, strong = play(model, stream, until), play(model, stronger, until)
    row = NAMES.index(name)
    assert (strong.charges[row] >= weak.charges[row] - 1e-12).all()
    assert _kind(STIMULI[row]) * (model.mood(strong)[0] - model.mood(weak)[0]) >= -1e-12


def _kind(spec: StimulusSpec) -> float:
    """1 when all its emotions are pleasant, -1 when none is, 0 when they are mixed."""
    signs = {math.copysign(1, e.pleasure) for e in EMOTIONS if spec.emotions.get(e.name)}
    return signs.pop() if len(signs) == 1 else 0


@settings(deadline=None, max_examples=200)
@given(streams, st.floats(0, 600))
def test_the_optimist_is_never_less_pleased_than_the_pessimist(
    stream: Stream, until: float
) -> None:
    moods = [
        DYNAMICS[name].read(play(DYNAMICS[name], stream, until)).valence
        for name in ("optimist", "neutral", "pessimist")
    ]
    assert moods == sorted(moods, reverse=True)


@settings(deadline=None)
@given(dynamics, streams, st.floats(0, 300))
def test_the_causes_sum_to_the_state(model: Dynamics, stream: Stream, until: float) -> None:
    affect = play(model, stream, until)
    state = model.read(affect)
    charges = affect.charges.sum(axis=0)
    assert np.allclose(list(state.emotions.values()), 1 - np.exp(-charges), rtol=0, atol=1e-12)
    latent = np.arctanh(model.personality.baseline) + affect.mood.sum(axis=0)
    mood = [state.valence, state.arousal, state.dominance]
    assert np.allclose(mood, np.tanh(latent), rtol=0, atol=1e-12)
    shares = [share for _, share in model.why(affect)]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0 if state.label != "calm" else 0.0, abs=1e-9)


@settings(deadline=None)
@given(dynamics, st.permutations(NAMES[:5]), streams)
def test_stimuli_of_the_same_instant_commute(
    model: Dynamics, order: list[str], stream: Stream
) -> None:
    before = play(model, stream)
    one, other = before, before
    for name in order:
        one = model.feel(one, name, 0.7, before.time + 1)
    for name in NAMES[:5]:
        other = model.feel(other, name, 0.7, before.time + 1)
    assert same(one, other, 1e-12)


@pytest.mark.parametrize("dt", [0.0, 1e-9, 1e9])
def test_extreme_steps_give_numbers(dt: float) -> None:
    affect = play(NEUTRAL, [(0.0, name, 1.0) for name in NAMES], until=dt)
    for values in (affect.charges, affect.mood, affect.habituation):
        assert np.isfinite(values).all()
    assert NEUTRAL.read(affect).label


@pytest.mark.parametrize("gap", [0.0, 1e-300, 1e-16, 1e-12, 1e-9, 1e-6])
@pytest.mark.parametrize("dt", [0.0, 1e-9, 1.0, 1e3, 1e9])
def test_equal_time_constants_are_a_smooth_limit(gap: float, dt: float) -> None:
    rate = 0.01
    limit = dt * math.exp(-rate * dt)
    found = drive_response(dt, np.array([rate + gap]), rate)[0]
    assert found == pytest.approx(limit, rel=1e-3, abs=1e-300)


def test_a_mood_as_quick_as_an_emotion_is_fine() -> None:
    slow = replace(Personality("twin"), return_s=EMOTIONS[0].tau_s)
    affect = play(Dynamics(slow, STIMULI), [(0.0, "praise", 1.0)], until=20.0)
    assert np.isfinite(affect.mood).all()


def test_the_closed_form_solves_the_equations() -> None:
    """Against many small Euler steps."""
    affect = NEUTRAL.feel(NEUTRAL.rest(), "bump", 1.0, 0.0)
    charges, mood, dt = affect.charges.sum(axis=0), np.zeros(3), 1e-3
    rates = 1 / np.array([emotion.tau_s for emotion in EMOTIONS])
    spec = PERSONALITIES["neutral"]
    for _ in range(20000):
        mood = mood + dt * (charges @ PAD / spec.follow_s - mood / spec.return_s)
        charges = charges * (1 - dt * rates)
    exact = NEUTRAL.advance(affect, 20.0)
    assert np.allclose(exact.mood.sum(axis=0), mood, atol=1e-3)
    assert np.allclose(exact.charges.sum(axis=0), charges, atol=1e-3)


def test_a_repeated_stimulus_wears_off_and_recovers() -> None:
    affect = NEUTRAL.rest()
    gains = []
    for now in (0.0, 5.0, 10.0, 600.0):
        before = NEUTRAL.advance(affect, now)
        affect = NEUTRAL.feel(before, "praise", 1.0, now)
        gains.append(float((affect.charges - before.charges).sum()))
    assert gains[0] > gains[1] > gains[2]
    assert gains[3] == pytest.approx(gains[0], rel=1e-3)


def test_a_scolding_drives_out_the_joy_of_a_praise() -> None:
    praised = play(NEUTRAL, [(0.0, "praise", 1.0)], until=3.0)
    scolded = NEUTRAL.feel(praised, "scold", 1.0, praised.time)
    assert NEUTRAL.read(scolded).label == "sadness"
    assert NEUTRAL.read(scolded).emotions["joy"] < NEUTRAL.read(praised).emotions["joy"] / 1.5


def test_opposites_are_always_of_opposite_sign() -> None:
    """The condition under which more pleasure never leaves less of it."""
    for one, other in itertools.combinations(range(len(EMOTIONS)), 2):
        if OPPOSITION[one, other]:
            assert EMOTIONS[one].pleasure * EMOTIONS[other].pleasure < 0


def test_a_late_event_counts_as_now() -> None:
    affect = play(NEUTRAL, [(10.0, "praise", 1.0)])
    assert NEUTRAL.advance(affect, 5.0) is affect
    assert NEUTRAL.feel(affect, "scold", 1.0, 5.0).time == 10.0


@pytest.mark.parametrize("intensity", [-0.1, 1.1, math.nan, math.inf])
def test_an_intensity_out_of_range_is_refused(intensity: float) -> None:
    with pytest.raises(ValueError, match="0 to 1"):
        NEUTRAL.feel(NEUTRAL.rest(), "praise", intensity, 0.0)


def test_an_unknown_stimulus_and_a_bad_time_are_refused() -> None:
    with pytest.raises(HriError, match='did you mean "praise"'):
        NEUTRAL.feel(NEUTRAL.rest(), "prase", 1.0, 0.0)
    with pytest.raises(ValueError, match="finite"):
        NEUTRAL.advance(NEUTRAL.rest(), math.nan)
