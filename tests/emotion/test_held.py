"""What lasts: states, open goals, forgiveness, and that none of it depends on who looks when."""

import json
import math
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given, settings, strategies as st

from hri.emotion.affect import Affect, shifted
from hri.emotion.appraisal import ActionEvent, GoalEvent
from hri.emotion.dynamics import Dynamics
from hri.emotion.held import MOST
from hri.emotion.imprint_file import decoded, encoded
from hri.emotion.ledger import Origin
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import people, switched_off, without
from hri.emotion.personality import load_personality, personality_names
from hri.emotion.stimulus import HeldSpec, StimulusSpec, load_stimuli
from tests.emotion.streams import STIMULI, numbers

HELD = (
    StimulusSpec("alone", "I am alone", {"sadness": 0.5}, held=HeldSpec(60.0, 10.0)),
    StimulusSpec("near", "you are near", {"joy": 0.4}, held=HeldSpec(2.0, 5.0, 40.0)),
)
MODELS = {
    name: Dynamics(load_personality(name), [*STIMULI, *HELD])
    for name in ("neutral", "optimist", "pessimist", "shy")
}
NEUTRAL = MODELS["neutral"]
SHIPPED = {name: load_emotions(name).dynamics() for name in sorted(personality_names())}

deeds = st.tuples(
    st.floats(0, 60),
    st.sampled_from([stimulus.name for stimulus in (*STIMULI, *HELD)]),
    st.floats(0, 1),
)
lives = st.lists(deeds, min_size=1, max_size=10)
always = settings(deadline=None)


def lived(model: Dynamics, life: list[tuple[float, str, float]], until: float = 0.0) -> Affect:
    affect = model.rest()
    for wait, name, intensity in life:
        affect = model.feel(affect, name, intensity, affect.time + wait, "Anna")
    return model.advance(affect, affect.time + until)


@always
@given(st.sampled_from(list(MODELS.values())), lives, st.lists(st.floats(0, 300), min_size=1))
def test_a_life_with_states_is_equal_however_time_is_cut(
    model: Dynamics, life: list[tuple[float, str, float]], cuts: list[float]
) -> None:
    start = lived(model, life)
    stepped = start
    for cut in sorted(cuts):
        stepped = model.settle(model.advance(stepped, start.time + cut))
    whole = model.advance(start, start.time + max(cuts))
    one, other = numbers(model, stepped), numbers(model, whole)
    assert all(abs(one[name] - value) < 1e-9 for name, value in other.items())
    rows = model.ledger(whole).values()
    pleasure = math.tanh(math.fsum(row.mood[0] for row in rows))
    assert model.read(whole).valence == pytest.approx(pleasure, abs=1e-9)


@always
@given(lives, st.floats(0, 300))
def test_the_optimist_is_never_less_pleased_whatever_lasts(
    life: list[tuple[float, str, float]], until: float
) -> None:
    happy, plain, sad = (
        MODELS[name].read(lived(MODELS[name], life, until)).valence
        for name in ("optimist", "neutral", "pessimist")
    )
    assert happy >= plain - 1e-12
    assert plain >= sad - 1e-12


@always
@given(st.sampled_from(list(MODELS.values())), lives, st.floats(0, 200))
def test_it_goes_on_from_a_file_and_on_another_clock(
    model: Dynamics, life: list[tuple[float, str, float]], until: float
) -> None:
    affect = lived(model, life, until)
    again = decoded(json.loads(json.dumps(encoded(affect.imprint))))
    assert model.resume(again, affect.time) == affect
    moved = model.resume(shifted(again, 1024.0), affect.time + 1024.0)
    one, other = numbers(model, moved), numbers(model, affect)
    assert all(abs(one[name] - value) < 1e-9 for name, value in other.items())


def test_a_file_of_an_earlier_version_goes_on() -> None:
    affect = lived(NEUTRAL, [(0.0, "praise", 1.0), (5.0, "scold", 0.5)], until=3.0)
    written = json.loads(json.dumps(encoded(affect.imprint)))
    for key in ("held", "mood_name", "named_at", "words", "soothed"):
        del written[key]
    again = NEUTRAL.resume(decoded(written), affect.time)
    assert NEUTRAL.read(again).emotions == NEUTRAL.read(affect).emotions
    assert NEUTRAL.read(again).mood == "calm"


def test_states_ended_when_the_robot_was_switched_off_and_goals_stay_open() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "alone", 1.0, 0.0)
    affect = NEUTRAL.appraise(affect, GoalEvent("snow", 0.9, 0.9), 500.0)
    off = switched_off(NEUTRAL.settle(affect).imprint, 600.0)
    later = NEUTRAL.read(NEUTRAL.resume(off, 900.0)).emotions
    assert later["sadness"] < 0.01
    assert later["hope"] > 0.4


def test_who_made_up_for_a_deed_can_be_forgotten() -> None:
    affect = lived(SHIPPED["neutral"], [(0.0, "kicked", 1.0), (5.0, "apologized", 1.0)])
    kept = affect.imprint._replace(ledger={}, fresh={}, habituation={}, relations={})
    assert kept.soothed is not None
    assert people(kept) == {"Anna"}
    assert without(kept, "Anna").soothed is None


def test_a_state_rises_lasts_and_ends_in_relief() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "alone", 1.0, 0.0)
    seen = [NEUTRAL.read(NEUTRAL.advance(affect, 20.0 * n)).emotions["sadness"] for n in range(60)]
    assert seen == sorted(seen)
    assert seen[0] == 0.0
    assert seen[-1] == pytest.approx(0.5, abs=1e-3)
    assert NEUTRAL.why(NEUTRAL.advance(affect, 900.0))[0].lasts
    over = NEUTRAL.feel(affect, "alone", 0.0, 900.0)
    assert NEUTRAL.read(over).label == "relief"
    assert not any(cause.lasts for cause in NEUTRAL.why(over, "sadness"))
    assert NEUTRAL.read(NEUTRAL.advance(over, 960.0)).emotions["sadness"] < 0.01


def test_a_state_that_is_not_felt_again_is_over_by_itself() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "near", 1.0, 0.0, "Anna")
    assert NEUTRAL.read(NEUTRAL.advance(affect, 39.0)).emotions["joy"] > 0.39
    assert NEUTRAL.read(NEUTRAL.advance(affect, 80.0)).emotions["joy"] < 0.01
    kept = NEUTRAL.feel(affect, "near", 1.0, 30.0, "Anna")
    assert NEUTRAL.read(NEUTRAL.advance(kept, 69.0)).emotions["joy"] > 0.39


def test_no_more_states_are_held_than_there_is_room_for() -> None:
    affect = NEUTRAL.rest()
    for number in range(2 * MOST):
        affect = NEUTRAL.feel(affect, "near", 1.0, 0.01 * number, f"person {number}")
    assert len(affect.imprint.held) == MOST
    assert 0.99 < NEUTRAL.read(NEUTRAL.advance(affect, 20.0)).emotions["joy"] <= 1.0


def test_a_hope_turns_into_a_worry_when_its_time_is_past() -> None:
    goal = GoalEvent("Anna comes", 0.8, 0.9, expected_s=300.0, waiting="Anna is not here yet")
    affect = NEUTRAL.appraise(NEUTRAL.rest(), goal, 0.0)
    seen = [NEUTRAL.read(NEUTRAL.advance(affect, 30.0 * n)).emotions for n in range(1, 40)]
    assert all(one["hope"] > other["hope"] for one, other in pairwise(seen))
    assert all(one["fear"] < other["fear"] for one, other in pairwise(seen))
    assert [NEUTRAL.read(NEUTRAL.advance(affect, at)).label for at in (60, 900)] == ["hope", "fear"]
    came = GoalEvent("Anna comes", 0.8, 1.0, agent="Anna", praiseworthiness=0.2)
    glad = NEUTRAL.read(NEUTRAL.appraise(affect, came, 900.0))
    assert glad.emotions["relief"] > 0.4
    assert 0.0 < glad.emotions["reproach"] < 0.3
    assert glad.emotions["hope"] == glad.emotions["fear"] == 0.0
    gone = NEUTRAL.read(NEUTRAL.appraise(affect, GoalEvent("Anna comes", 0.8, 0.0), 900.0))
    assert gone.label in ("disappointment", "sadness")


def test_who_is_sorry_is_forgiven_and_less_so_each_time() -> None:
    model = SHIPPED["neutral"]
    left = []
    affect = model.rest()
    for number in range(4):
        at = 600.0 * number
        affect = model.feel(affect, "kicked", 1.0, at, "Ben")
        angry = model.read(model.advance(affect, at + 5.0)).emotions["anger"]
        affect = model.feel(affect, "apologized", 1.0, at + 5.0, "Ben")
        left.append(model.read(affect).emotions["anger"] / angry)
    assert left[0] < 0.5
    assert left == sorted(left)
    assert affect.imprint.soothed is not None
    assert affect.imprint.soothed[:3] == ("kicked", "apologized", "Ben")
    other = model.feel(
        model.feel(model.rest(), "kicked", 1.0, 0.0, "Ben"), "apologized", 1.0, 1.0, "Al"
    )
    assert other.imprint.soothed is None
    assert model.read(other).label == "anger"


def test_to_make_good_is_not_admired() -> None:
    kicked = ActionEvent("kicked me", -0.8, "Ben", desirability=-0.7)
    affect = NEUTRAL.appraise(NEUTRAL.rest(), kicked, 0.0)
    assert NEUTRAL.read(affect).label == "anger"
    sorry = ActionEvent("said sorry", 0.7, "Ben", makes_good="kicked me")
    after = NEUTRAL.read(NEUTRAL.appraise(affect, sorry, 10.0))
    assert after.emotions["admiration"] == 0.0
    assert (
        after.emotions["anger"] < NEUTRAL.read(NEUTRAL.advance(affect, 10.0)).emotions["anger"] / 2
    )


@pytest.mark.parametrize("personality", SHIPPED)
def test_labels_do_not_flicker(personality: str) -> None:
    model = SHIPPED[personality]
    affect, labels = model.rest(), []
    for second in range(600):
        if second % 25 == 0:
            affect = model.feel(affect, "ignored", 1.0, float(second))
        labels.append(model.read(model.advance(affect, second + 0.5)).label)
    assert sum(one != other for one, other in pairwise(labels)) <= 5


@pytest.mark.parametrize("personality", SHIPPED)
def test_trivial_events_seldom_take_the_label(personality: str) -> None:
    """Half a change a minute at most, in three half hours with a hundred events each."""
    model = SHIPPED[personality]
    moments = [name for name, spec in load_stimuli().items() if spec.held is None]
    changes = 0
    for seed in (5, 6, 7):
        chance = Random(seed)
        events = sorted(
            (chance.uniform(0, 1800), chance.choice(moments), chance.uniform(0.0, 0.2))
            for _ in range(100)
        )
        affect, labels = model.rest(), []
        for second in range(1800):
            while events and events[0][0] <= second:
                time, name, intensity = events.pop(0)
                affect = model.feel(affect, name, intensity, time)
            labels.append(model.read(model.advance(affect, float(second))).label)
        changes += sum(one != other for one, other in pairwise(labels))
    assert changes <= 0.5 * 90


def test_two_minutes_of_praise_do_not_last_for_ever() -> None:
    model = SHIPPED["neutral"]
    affect = model.rest()
    for number in range(24):
        affect = model.feel(affect, "praise", 1.0, 5.0 * number, "Anna")
    moods = [model.read(model.advance(affect, 115.0 + after)).valence for after in (0, 100, 300)]
    assert 0.3 < moods[0] < 0.8
    assert moods[0] > moods[1] > moods[2]
    assert moods[2] < 0.3


def test_a_friend_who_was_away_is_greeted_longer() -> None:
    model = SHIPPED["neutral"]
    affect = model.rest()
    for number in range(6):
        affect = model.feel(affect, "helped", 1.0, 60.0 * number, "Anna")
    joys = []
    for away in (600.0, 6 * 3600.0):
        met = model.feel(affect, "person_seen", 1.0, 300.0 + away, "Anna")
        joys.append(model.read(model.advance(met, met.time + 60.0)).emotions["joy"])
    assert joys[1] > 1.5 * joys[0]
    stranger = model.feel(affect, "person_seen", 1.0, 300.0 + 6 * 3600.0, "Zoe")
    assert model.read(model.advance(stranger, stranger.time + 60.0)).emotions["joy"] < joys[1] / 2


def test_a_goal_that_nobody_decides_is_given_up() -> None:
    goal = GoalEvent("Anna comes", 0.8, 0.9, expected_s=60.0)
    affect = NEUTRAL.appraise(NEUTRAL.rest(), goal, 0.0)
    assert NEUTRAL.read(NEUTRAL.advance(affect, 400.0)).emotions["fear"] > 0.4
    assert NEUTRAL.read(NEUTRAL.advance(affect, 3600.0)).emotions["fear"] < 1e-6
    any_time = NEUTRAL.appraise(NEUTRAL.rest(), GoalEvent("snow", 0.9, 0.9), 0.0)
    lonely = NEUTRAL.feel(any_time, "alone", 1.0, 10.0)
    assert NEUTRAL.read(NEUTRAL.advance(lonely, 80_000.0)).label == "hope"
    assert NEUTRAL.read(NEUTRAL.advance(lonely, 90_000.0)).label == "sadness"


def test_the_words_of_goals_go_with_their_cause() -> None:
    affect = NEUTRAL.appraise(NEUTRAL.rest(), GoalEvent("tea", 0.5, 0.9), 0.0)
    assert NEUTRAL.said(affect) == {"goal.tea": "of the tea"}
    done = NEUTRAL.appraise(affect, GoalEvent("tea", 0.5, 1.0), 10.0)
    much_later = NEUTRAL.feel(done, "praise", 1.0, 86400.0)
    assert Origin("goal.tea") not in much_later.imprint.held
    assert "goal.tea" not in NEUTRAL.said(NEUTRAL.feel(much_later, "praise", 1.0, 2 * 86400.0))
