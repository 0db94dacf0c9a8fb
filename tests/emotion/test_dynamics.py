import itertools
import math
from dataclasses import replace
from random import Random

import pytest
from hypothesis import assume, given, settings, strategies as st

from hri.core.errors import HriError
from hri.emotion.affect import MOST_AT_ONCE, Affect, shifted
from hri.emotion.appraisal import GoalEvent
from hri.emotion.dynamics import MOST_HABITS, Dynamics
from hri.emotion.emotions import (
    EMOTIONS,
    INDEX,
    NAMES,
    OPPOSITES,
    OPPOSITES_ABOUT_ONE_THING,
    PART_OF,
    whole,
)
from hri.emotion.fading import CALMLY
from hri.emotion.label import MOODS
from hri.emotion.ledger import MOST, OTHER, TEMPERAMENT, Origin
from hri.emotion.personality import Personality, load_personality
from hri.emotion.stimulus import StimulusSpec, load_stimuli
from tests.emotion.streams import (
    DYNAMICS,
    NEUTRAL,
    STIMULI,
    Felt,
    Stream,
    felt,
    happen,
    impulses,
    models,
    numbers,
    play,
    streams,
    waits,
)

always = settings(deadline=None)


def near(one: dict[str, float], other: dict[str, float], tolerance: float = 1e-9) -> bool:
    return one.keys() == other.keys() and all(
        abs(value - other[name]) <= tolerance for name, value in one.items()
    )


@always
@given(models, streams, st.floats(0, 1e4))
def test_everything_stays_within_its_bounds(model: Dynamics, stream: Stream, until: float) -> None:
    affect = play(model, stream, until)
    state = model.read(affect)
    assert tuple(state.emotions) == NAMES
    assert all(0 <= value <= 1 for value in state.emotions.values())
    assert all(math.copysign(1, value) == 1 for value in state.emotions.values())
    assert all(0 <= value <= 1 for value in state.drives.values())
    assert all(-1 <= axis <= 1 for axis in (state.valence, state.arousal, state.dominance))
    assert all(-1 <= value <= 1 for value in model.relations(affect).values())
    assert 0 <= state.intensity <= 1
    assert state.label in (*NAMES, *MOODS)


def test_a_thousand_times_the_same_saturates_without_a_limit() -> None:
    affect = NEUTRAL.rest()
    for _ in range(1000):
        affect = NEUTRAL.feel(affect, "insulted", 1.0, 0.0, "Ben")
    state = NEUTRAL.read(NEUTRAL.advance(affect, 20.0))
    assert 0.999 < state.emotions["anger"] <= 1.0
    assert -1.0 <= state.valence < -0.999


@always
@given(models, streams, st.lists(st.floats(0, 300), min_size=1, max_size=20))
def test_any_partition_of_time_gives_the_same_state(
    model: Dynamics, stream: Stream, cuts: list[float]
) -> None:
    start = play(model, stream)
    end = start.time + max(cuts)
    stepped = worked_out = start
    for cut in sorted(cuts):
        stepped = model.advance(stepped, start.time + cut)
        model.read(stepped)
        worked_out = model.settle(model.advance(worked_out, start.time + cut))
    whole = model.advance(start, end)
    assert model.advance(stepped, end) == whole
    assert near(numbers(model, model.advance(worked_out, end)), numbers(model, whole))


@pytest.mark.parametrize("steps", [1, 10, 1000])
def test_ticks_make_no_difference(steps: int) -> None:
    affect = play(NEUTRAL, [(0.0, Felt("scold", 1.0, "Anna")), (1.0, Felt("petted", 1.0, None))])
    stepped = affect
    for step in range(1, steps + 1):
        stepped = NEUTRAL.settle(NEUTRAL.advance(stepped, 1.0 + 100.0 * step / steps))
    assert near(numbers(NEUTRAL, stepped), numbers(NEUTRAL, NEUTRAL.advance(affect, 101.0)))


@always
@given(models, streams)
def test_in_the_end_the_baseline_is_all_that_is_left(model: Dynamics, stream: Stream) -> None:
    full_battery = model.report(play(model, stream), "energy", 0.0, 0.0)
    for origin in full_battery.imprint.held:
        decided = GoalEvent(origin.name.removeprefix("goal."), 0.0, 1.0)
        full_battery = model.appraise(full_battery, decided, full_battery.time)
    affect = model.advance(full_battery, full_battery.time + 40 * 7200)
    assert model.mood(affect) == pytest.approx(model.personality.baseline, abs=1e-6)
    assert max(model.read(affect).emotions.values()) < 1e-6
    assert model.drives(affect) == pytest.approx(model.drives(model.rest()), abs=1e-6)


@always
@given(models, st.floats(0, 1e9))
def test_without_stimuli_nothing_changes(model: Dynamics, now: float) -> None:
    rest = model.rest()
    assert model.mood(rest) == pytest.approx(model.personality.baseline, abs=1e-15)
    assert model.read(model.advance(rest, now)) == model.read(rest)
    assert model.read(model.settle(model.advance(rest, now))) == model.read(rest)


@always
@given(models, st.lists(st.tuples(waits, felt), min_size=1, max_size=12), st.data())
def test_a_stronger_stimulus_is_felt_more(
    model: Dynamics, stream: Stream, data: st.DataObject
) -> None:
    at = data.draw(st.integers(0, len(stream) - 1))
    until = data.draw(st.floats(0, 200))
    wait, event = stream[at]
    assert isinstance(event, Felt)
    spec = STIMULI[[stimulus.name for stimulus in STIMULI].index(event.name)]
    # These move what follows by other ways than the emotions, and what was nothing did not happen.
    assume(not spec.relation and not spec.satisfies and event.intensity > 0)
    stronger = [*stream]
    more = event.intensity + (1 - event.intensity) * data.draw(st.floats(0, 1))
    stronger[at] = (wait, replace(event, intensity=more))
    weak, strong = play(model, stream, until), play(model, stronger, until)
    one, other = model.charges(weak), model.charges(strong)
    assert all(other.get(name, 0.0) >= one.get(name, 0.0) - 1e-12 for name in spec.emotions)
    assert _kind(spec) * (model.mood(strong)[0] - model.mood(weak)[0]) >= -1e-12


def _kind(spec: StimulusSpec) -> float:
    """1 when all its emotions are pleasant, -1 when none is, 0 when they are mixed."""
    signs = {math.copysign(1, e.pleasure) for e in EMOTIONS if spec.emotions.get(e.name)}
    return signs.pop() if len(signs) == 1 else 0


@settings(deadline=None, max_examples=200)
@given(streams, st.floats(0, 600))
def test_the_optimist_is_never_less_pleased_than_the_pessimist(
    stream: Stream, until: float
) -> None:
    happy, plain, sad = (
        DYNAMICS[name].read(play(DYNAMICS[name], stream, until)).valence
        for name in ("optimist", "neutral", "pessimist")
    )
    assert happy >= plain - 1e-12
    assert plain >= sad - 1e-12


@always
@given(models, streams, st.floats(0, 300))
def test_the_causes_sum_to_the_state(model: Dynamics, stream: Stream, until: float) -> None:
    affect = play(model, stream, until)
    state, rows = model.read(affect), model.ledger(affect).values()
    for name in NAMES:
        charge = math.fsum(row.charges.get(name, 0.0) for row in rows)
        assert state.emotions[name] == pytest.approx(-math.expm1(-charge), rel=0, abs=1e-12)
    mood = [math.tanh(math.fsum(row.mood[axis] for row in rows)) for axis in range(3)]
    assert [state.valence, state.arousal, state.dominance] == pytest.approx(mood, abs=1e-12)
    causes = model.why(affect)
    shares = [cause.share for cause in causes]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0 if state.label != "calm" else 0.0, abs=1e-12)
    assert all(0 < cause.share <= 1 for cause in causes)
    assert all(0 <= cause.age_s <= affect.time for cause in causes)


def test_many_causes_are_kept_as_a_few_and_the_rest_without_losing_the_sum() -> None:
    stimuli = [StimulusSpec(f"s{n}", "it happened", {"joy": 0.1}) for n in range(100)]
    model = Dynamics(Personality("many"), stimuli)
    one = Dynamics(Personality("one"), [StimulusSpec("s", "it happened", {"joy": 0.1})])
    affect, plain = model.rest(), one.rest()
    for n in range(100):
        affect = model.feel(affect, f"s{n}", 1.0, float(n))
        plain = one.feel(plain, "s", 1.0, float(n))
    assert len(affect.imprint.ledger) <= MOST + 1
    assert near(numbers(model, affect), numbers(one, plain), 1e-12)
    causes = model.why(affect)
    assert sum(cause.share for cause in causes) == pytest.approx(1.0, abs=1e-12)
    assert OTHER in [cause.name for cause in causes]


@always
@given(models, st.lists(impulses, min_size=2, max_size=6), streams, st.randoms(), st.floats(0, 50))
def test_what_happens_at_the_same_instant_commutes(
    model: Dynamics, together: list[Felt], stream: Stream, chance: Random, until: float
) -> None:
    before = play(model, stream)
    shuffled = list(together)
    chance.shuffle(shuffled)
    states = []
    for order in (together, shuffled):
        affect = before
        for event in order:
            affect = happen(model, affect, event, before.time + 1)
        states.append(numbers(model, model.advance(affect, affect.time + until)))
    assert near(states[0], states[1], 1e-12)


@pytest.mark.parametrize("dt", [0.0, 1e-9, 1e9])
def test_extreme_steps_give_numbers(dt: float) -> None:
    stream: Stream = [(0.0, Felt(stimulus.name, 1.0, "Anna")) for stimulus in STIMULI]
    affect = NEUTRAL.settle(play(NEUTRAL, stream, until=dt))
    assert all(map(math.isfinite, numbers(NEUTRAL, affect).values()))
    again = NEUTRAL.feel(affect, "scold", 1.0, dt + dt)
    assert all(map(math.isfinite, numbers(NEUTRAL, again).values()))


@pytest.mark.parametrize("gap", [0.0, 1e-15, 1e-12, 1e-9, 1e-6])
@pytest.mark.parametrize("dt", [0.0, 1e-9, 1.0, 1e3, 1e9])
def test_equal_time_constants_are_a_smooth_limit(gap: float, dt: float) -> None:
    """An emotion as slow as the mood, against the limit u t exp(-t / tau) / tau."""
    tau = EMOTIONS[0].tau_s
    model = Dynamics(Personality("twin", return_s=tau * (1 + gap), follow_s=tau), STIMULI)
    affect = model.feel(model.rest(), "played", 1.0, 0.0)
    affect = model.report(affect, "play", 0.5, 0.0)
    affect = model.report(affect, "rest", 0.4, 0.0)
    charge = model.charges(affect)["joy"]
    pleasure = model.ledger(model.advance(affect, dt))[Origin("played")].mood[0]
    limit = charge * EMOTIONS[0].pleasure * dt / tau * math.exp(-dt / tau)
    assert pleasure == pytest.approx(limit, rel=1e-3, abs=1e-300)


@pytest.mark.parametrize("return_s", [3.0, 150.0, 86400.0])
def test_the_closed_form_solves_the_equations(return_s: float) -> None:
    """Against many small Euler steps, for a mood slower and quicker than emotions and drives."""
    spec = Personality("any", return_s=return_s)
    model = Dynamics(spec, STIMULI)
    affect = model.feel(model.rest(), "bump", 1.0, 0.0)
    affect = model.feel(affect, "petted", 1.0, 0.0)
    charges, mood, dt = dict(affect.outlook.charges), [0.0, 0.0, 0.0], 2e-3
    parts = [(part, EMOTIONS[INDEX[name]]) for part, name in PART_OF.items()]
    force = {part: 1.0 if part == e.name else CALMLY for part, e in parts}
    tau = {part: e.tau_s if part == e.name else e.slow_tau_s for part, e in parts}
    company, drive = model.drives(affect)["company"], spec.drives[0]
    for _ in range(5000):
        forces = [(drive, (company - drive.resting) / return_s)]
        forces += [(e, force[p] * charges.get(p, 0.0) / spec.follow_s) for p, e in parts]
        for axis, name in enumerate(("pleasure", "arousal", "dominance")):
            pull = sum(strength * getattr(force, name) for force, strength in forces)
            mood[axis] += dt * (pull - mood[axis] / return_s)
        company += dt * (drive.resting - company) / drive.tau_s
        charges = {part: charge * (1 - dt / tau[part]) for part, charge in charges.items()}
    exact = model.advance(affect, 10.0)
    assert model.mood(exact) == pytest.approx([math.tanh(axis) for axis in mood], abs=1e-3)
    assert model.drives(exact)["company"] == pytest.approx(company, abs=1e-6)
    for name, charge in model.charges(exact).items():
        assert charge == pytest.approx(whole(charges)[name], abs=1e-3)


def test_a_repeated_stimulus_wears_off_and_recovers() -> None:
    affect = NEUTRAL.rest()
    gains = []
    for now in (0.0, 5.0, 10.0, 600.0):
        before = NEUTRAL.charges(NEUTRAL.advance(affect, now)).get("joy", 0.0)
        affect = NEUTRAL.feel(affect, "praise", 1.0, now)
        gains.append(NEUTRAL.charges(affect)["joy"] - before)
    assert gains[0] > gains[1] > gains[2]
    assert gains[3] == pytest.approx(gains[0], rel=1e-3)


def test_of_intensity_0_nothing_has_happened() -> None:
    before = play(NEUTRAL, [(0.0, Felt("praise", 1.0, "Anna"))])
    for person in ("Anna", "Ben", None):
        after = NEUTRAL.feel(before, "praise", 0.0, 5.0, person)
        assert after == NEUTRAL.advance(before, 5.0)


def test_it_gets_used_to_each_person_apart() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "scold", 1.0, 0.0, "Anna")
    again = NEUTRAL.feel(affect, "scold", 1.0, 1.0, "Anna")
    other = NEUTRAL.feel(affect, "scold", 1.0, 1.0, "Ben")
    assert NEUTRAL.charges(other)["shame"] > NEUTRAL.charges(again)["shame"]


def test_to_people_without_a_name_it_gets_used_as_to_one() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "praise", 1.0, 0.0, "p1")
    again = NEUTRAL.feel(affect, "praise", 1.0, 1.0, "p2")
    assert NEUTRAL.charges(again)["joy"] < 1.8 * NEUTRAL.charges(affect)["joy"]
    assert set(NEUTRAL.relations(again)) == {"p1", "p2"}


def test_what_it_is_used_to_and_whom_it_knows_is_bounded() -> None:
    affect = NEUTRAL.rest()
    for n in range(MOST_HABITS + 50):
        affect = NEUTRAL.feel(affect, "praise", 1.0, float(n), f"person {n}")
    assert len(affect.imprint.habituation) == MOST_HABITS
    assert len(affect.imprint.relations) == 200


def test_a_crowd_at_one_instant_is_felt_in_full_but_not_kept_apart() -> None:
    apart = together = NEUTRAL.rest()
    for n in range(2 * MOST_AT_ONCE):
        apart = NEUTRAL.feel(apart, "insulted", 0.1, 0.0, f"person {n}")
        together = NEUTRAL.feel(together, "insulted", 0.1, 0.0, "Ben")
    assert len(apart.imprint.fresh) <= MOST_AT_ONCE + 1
    assert NEUTRAL.charges(apart) == pytest.approx(NEUTRAL.charges(together), abs=1e-12)


def test_a_scolding_drives_out_the_joy_of_a_praise() -> None:
    praised = play(NEUTRAL, [(0.0, Felt("praise", 1.0, None))], until=3.0)
    scolded = NEUTRAL.feel(praised, "scold", 1.0, praised.time)
    assert NEUTRAL.read(scolded).label == "sadness"
    assert NEUTRAL.read(scolded).emotions["joy"] < NEUTRAL.read(praised).emotions["joy"] / 1.5


def test_opposites_are_always_of_opposite_sign() -> None:
    """The condition under which more pleasure never leaves less of it."""
    positive = {emotion.name: emotion.is_positive for emotion in EMOTIONS}
    pairs = (*OPPOSITES, *OPPOSITES_ABOUT_ONE_THING)
    assert all(positive[one] != positive[other] for one, other in pairs)
    assert len({frozenset(pair) for pair in pairs}) == len(pairs)


def test_a_late_event_counts_as_now() -> None:
    affect = play(NEUTRAL, [(10.0, Felt("praise", 1.0, None))])
    assert NEUTRAL.advance(affect, 5.0) is affect
    assert NEUTRAL.feel(affect, "scold", 1.0, 5.0).time == 10.0


def test_why_can_be_asked_about_another_feeling() -> None:
    affect = play(NEUTRAL, [(0.0, Felt("praise", 1.0, "Anna")), (5.0, Felt("scold", 1.0, "Ben"))])
    affect = NEUTRAL.advance(affect, 8.0)
    sad, joy = NEUTRAL.why(affect), NEUTRAL.why(affect, "joy")
    assert [(cause.name, cause.person, cause.age_s) for cause in sad] == [("scold", "Ben", 3.0)]
    assert [(cause.name, cause.person, cause.age_s) for cause in joy] == [("praise", "Anna", 8.0)]
    assert NEUTRAL.why(affect, "love") == ()
    assert NEUTRAL.why(affect, "calm") == ()
    with pytest.raises(HriError, match='did you mean "joy"'):
        NEUTRAL.why(affect, "joi")


def test_a_mood_has_the_temperament_among_its_causes() -> None:
    model = DYNAMICS["pessimist"]
    (cause,) = model.why(model.rest())
    assert (cause.name, cause.share, cause.age_s) == (TEMPERAMENT, 1.0, 0.0)


def test_a_settled_state_goes_on_under_another_personality() -> None:
    neutral = play(NEUTRAL, [(0.0, Felt("scold", 1.0, "Anna"))], until=5.0)
    pessimist = DYNAMICS["pessimist"]
    moved = pessimist.resume(NEUTRAL.settle(neutral).imprint, 5.0)
    assert pessimist.charges(moved) == pytest.approx(NEUTRAL.charges(neutral))
    assert pessimist.mood(moved)[0] < NEUTRAL.mood(neutral)[0]


@always
@given(models, streams, st.floats(0, 1e5))
def test_a_state_goes_on_from_its_imprint_to_the_last_bit(
    model: Dynamics, stream: Stream, until: float
) -> None:
    affect = play(model, stream, until)
    assert model.resume(affect.imprint, affect.time) == affect
    moved = model.resume(shifted(affect.imprint, 1024.0), affect.time + 1024.0)
    assert near(numbers(model, moved), numbers(model, affect))


@pytest.mark.parametrize("intensity", [-0.1, 1.1, math.nan, math.inf])
def test_an_intensity_out_of_range_is_refused(intensity: float) -> None:
    with pytest.raises(ValueError, match="0 to 1"):
        NEUTRAL.feel(NEUTRAL.rest(), "praise", intensity, 0.0)
    with pytest.raises(ValueError, match="0 to 1"):
        NEUTRAL.report(NEUTRAL.rest(), "energy", intensity, 0.0)


@pytest.mark.parametrize("now", [math.nan, math.inf])
def test_a_time_that_is_none_is_refused(now: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        NEUTRAL.advance(NEUTRAL.rest(), now)
    with pytest.raises(ValueError, match="finite"):
        NEUTRAL.feel(NEUTRAL.rest(), "praise", 1.0, now)


@pytest.mark.parametrize("person", ["", "x" * 101])
def test_a_person_needs_a_name_that_can_be_kept(person: str) -> None:
    with pytest.raises(ValueError, match="person has"):
        NEUTRAL.feel(NEUTRAL.rest(), "praise", 1.0, 0.0, person)


def test_unknown_names_are_refused_with_a_remedy() -> None:
    with pytest.raises(HriError, match='did you mean "praise"'):
        NEUTRAL.feel(NEUTRAL.rest(), "prase", 1.0, 0.0)
    with pytest.raises(HriError, match='did you mean "energy"'):
        NEUTRAL.report(NEUTRAL.rest(), "enery", 1.0, 0.0)


def test_the_shipped_files_order_optimist_and_pessimist() -> None:
    stimuli = list(load_stimuli().values())
    models = [Dynamics(load_personality(name), stimuli) for name in ("optimist", "pessimist")]
    for one, other in itertools.permutations([stimulus.name for stimulus in stimuli], 2):
        happy, sad = (_after(model, one, other) for model in models)
        assert happy > sad


def _after(model: Dynamics, *names: str) -> float:
    affect: Affect = model.rest()
    for number, name in enumerate(names):
        affect = model.feel(affect, name, 1.0, 10.0 * number)
    return model.mood(model.advance(affect, 30.0))[0]
