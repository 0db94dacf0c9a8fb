import math
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from hri.emotion.affect import Affect
from hri.emotion.appraisal import (
    CERTAIN,
    SELF,
    ActionEvent,
    GoalEvent,
    ObjectEvent,
    OccEvent,
    appraise,
)
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import NAMES
from hri.emotion.ledger import Origin
from hri.emotion.personality import Personality, Temper
from tests.emotion.streams import NEUTRAL, goals


def goal(utility: float, before: float, after: float, **more: Any) -> GoalEvent:
    return GoalEvent("goal", utility, after, before, **more)


REACHED: dict[str, OccEvent] = {
    "hope": goal(0.8, 0.5, 0.9),
    "fear": goal(-0.8, 0.5, 0.9),
    "joy": goal(0.8, 0.4, 1.0),
    "sadness": goal(-0.8, 0.4, 1.0),
    "satisfaction": goal(1.0, 0.6, 1.0),
    "fears_confirmed": goal(-1.0, 0.6, 1.0),
    "disappointment": goal(0.8, 0.9, 0.0),
    "relief": goal(-0.8, 0.9, 0.0),
    "happy_for": goal(0.8, 0.2, 1.0, owner="Anna", liking=0.9),
    "resentment": goal(0.8, 0.2, 1.0, owner="Anna", liking=-0.9),
    "pity": goal(-0.8, 0.2, 1.0, owner="Anna", liking=0.9),
    "gloating": goal(-0.8, 0.2, 1.0, owner="Anna", liking=-0.9),
    "pride": ActionEvent("deed", 0.8),
    "shame": ActionEvent("deed", -0.8),
    "admiration": ActionEvent("deed", 0.8, "Anna"),
    "reproach": ActionEvent("deed", -0.8, "Anna"),
    "gratitude": goal(0.8, 0.2, 1.0, agent="Anna"),
    "anger": goal(-0.8, 0.2, 1.0, agent="Anna"),
    "gratification": goal(0.8, 0.2, 1.0, agent=SELF),
    "remorse": goal(-0.8, 0.2, 1.0, agent=SELF),
    "love": ObjectEvent("ball", 0.8),
    "hate": ObjectEvent("spider", -0.8),
}
"""An event that brings each emotion of OCC."""


@pytest.mark.parametrize("emotion", REACHED)
def test_every_emotion_of_occ_is_reached_and_gives_its_name(emotion: str) -> None:
    assert set(REACHED) == set(NAMES) - {"surprise", "disgust"}
    affect = NEUTRAL.appraise(NEUTRAL.rest(), REACHED[emotion], 0.0)
    assert NEUTRAL.read(affect).label == emotion


@settings(deadline=None)
@given(goals, st.floats(0, 1))
def test_what_is_at_stake_more_is_felt_more(event: GoalEvent, share: float) -> None:
    less = {
        name: getattr(event, name)
        for name in ("goal", "likelihood_after", "likelihood_before", "owner", "liking", "agent")
    }
    weak = appraise(GoalEvent(utility=event.utility * share, **less)).charges
    strong = appraise(GoalEvent(utility=event.utility, **less)).charges
    assert all(charge <= strong.get(name, 0.0) + 1e-12 for name, charge in weak.items())


def test_an_intensity_is_that_of_the_expected_utility() -> None:
    charges = appraise(goal(0.6, 0.25, 0.75)).charges
    assert -math.expm1(-charges["hope"]) == pytest.approx(CERTAIN * 0.6 * 0.5)


def test_hope_ends_when_it_is_decided() -> None:
    hopes = NEUTRAL.appraise(NEUTRAL.rest(), goal(1.0, 0.5, 0.9), 0.0)
    other = NEUTRAL.appraise(hopes, GoalEvent("another", 1.0, 0.9), 0.0)
    for after, label in ((1.0, "satisfaction"), (0.0, "disappointment")):
        decided = NEUTRAL.appraise(hopes, goal(1.0, 0.9, after, agent="Anna"), 1.0)
        assert NEUTRAL.read(decided).emotions["hope"] == 0.0
        assert label in NEUTRAL.charges(decided)
        left = NEUTRAL.charges(NEUTRAL.appraise(other, goal(1.0, 0.9, after), 1.0))
        assert left.get("hope", 0.0) > 0.0


def test_hope_for_one_goal_leaves_the_fear_for_another() -> None:
    afraid = NEUTRAL.appraise(NEUTRAL.rest(), goal(-1.0, 0.2, 0.9), 0.0)
    origin = Origin("goal.goal")
    before = NEUTRAL.ledger(NEUTRAL.advance(afraid, 1.0))[origin].charges["fear"]

    hopeful = NEUTRAL.appraise(afraid, GoalEvent("another", 1.0, 0.9), 1.0)
    assert NEUTRAL.ledger(hopeful)[origin].charges["fear"] == pytest.approx(before)
    assert NEUTRAL.charges(hopeful)["hope"] > 0.0

    safer = NEUTRAL.appraise(afraid, goal(-1.0, 0.9, 0.2), 1.0)
    assert NEUTRAL.charges(safer)["fear"] < 0.7 * before


@pytest.mark.parametrize(("utility", "saved"), [(0.9, 1.0), (-0.9, 0.0)])
def test_pity_ends_when_the_goal_is_saved(utility: float, saved: float) -> None:
    anna = {"owner": "Anna", "liking": 0.9}
    endangered = goal(utility, 0.5, 0.9 if utility < 0 else 0.1, **anna)
    sorry = NEUTRAL.appraise(NEUTRAL.rest(), endangered, 0.0)
    other = NEUTRAL.appraise(sorry, GoalEvent("another", 0.8, 0.0, **anna), 0.5)
    assert NEUTRAL.read(sorry).label == "pity"

    glad = NEUTRAL.appraise(sorry, goal(utility, 0.5, saved, **anna), 1.0)
    assert "pity" not in NEUTRAL.charges(glad)
    assert NEUTRAL.charges(glad)["happy_for"] > 0.0
    assert "pity" in NEUTRAL.charges(NEUTRAL.appraise(other, goal(utility, 0.5, saved, **anna), 1))

    lost = NEUTRAL.appraise(glad, goal(utility, 0.5, 1.0 - saved, **anna), 2.0)
    assert "happy_for" not in NEUTRAL.charges(lost)


def test_a_likelihood_that_does_not_change_is_nothing_new() -> None:
    assert appraise(goal(1.0, 0.7, 0.7)).charges == {}
    assert appraise(goal(1.0, 1.0, 1.0)).charges == {}


def test_a_good_deed_of_which_harm_comes_makes_neither_angry_nor_grateful() -> None:
    charges = appraise(goal(-0.7, 0.2, 1.0, agent="Anna", praiseworthiness=0.9)).charges
    assert set(charges) == {"sadness", "admiration"}
    charges = appraise(goal(-0.7, 0.2, 1.0, agent="Anna", praiseworthiness=0.0)).charges
    assert set(charges) == {"sadness"}


def test_harm_to_a_friend_makes_angry_and_harm_to_an_enemy_does_not() -> None:
    harm = {"owner": "Ben", "agent": "Anna"}
    assert set(appraise(goal(-0.7, 0.2, 1.0, liking=0.8, **harm)).charges) == {
        "pity",
        "reproach",
        "anger",
    }
    assert set(appraise(goal(-0.7, 0.2, 1.0, liking=-0.8, **harm)).charges) == {
        "gloating",
        "reproach",
    }


def test_the_relation_decides_what_is_felt_for_others() -> None:
    def after(liked: float) -> Affect:
        affect = NEUTRAL.rest()
        for n in range(20):
            affect = NEUTRAL.appraise(affect, ActionEvent("deed", liked, "Anna"), 60.0 * n)
        return NEUTRAL.appraise(affect, goal(0.9, 0.2, 1.0, owner="Anna"), 1e4)

    assert NEUTRAL.read(after(1.0)).label == "happy_for"
    assert NEUTRAL.read(after(-1.0)).label == "resentment"
    stranger = NEUTRAL.appraise(NEUTRAL.rest(), goal(0.9, 0.2, 1.0, owner="Anna"), 0.0)
    assert max(NEUTRAL.read(stranger).emotions.values()) == 0.0


def test_nothing_is_left_to_hope_for_once_a_goal_is_decided_whatever_came_between() -> None:
    affect = NEUTRAL.appraise(NEUTRAL.rest(), goal(0.3, 0.5, 0.7), 0.0)
    assert NEUTRAL.charges(affect)["hope"] > 0.05
    for n in range(30):
        affect = NEUTRAL.feel(affect, "petted", 1.0, 0.1 * (n + 1), f"person {n}")
    affect = NEUTRAL.appraise(affect, goal(0.3, 0.7, 1.0), 4.0)
    assert NEUTRAL.charges(affect).get("hope", 0.0) == 0.0


def test_a_personality_has_its_gains_on_appraisals_too() -> None:
    cold = Dynamics(Personality("cold", positive=Temper(0.5)), ())
    warm = NEUTRAL.appraise(NEUTRAL.rest(), REACHED["joy"], 0.0)
    cool = cold.appraise(cold.rest(), REACHED["joy"], 0.0)
    assert cold.charges(cool)["joy"] == pytest.approx(0.5 * NEUTRAL.charges(warm)["joy"])


def test_the_ledger_names_what_happened_and_who_did_it() -> None:
    affect = NEUTRAL.appraise(NEUTRAL.rest(), REACHED["anger"], 0.0)
    (cause,) = NEUTRAL.why(NEUTRAL.advance(affect, 2.0))
    assert (cause.name, cause.person, cause.age_s) == ("goal.goal", "Anna", 2.0)
    affect = NEUTRAL.appraise(NEUTRAL.rest(), REACHED["pity"], 0.0)
    assert NEUTRAL.why(affect)[0].person == "Anna"


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: goal(1.1, 0.5, 1.0), "utility is 1.1 - give -1 to 1"),
        (lambda: goal(1.0, -0.1, 1.0), "likelihood_before is -0.1 - give 0 to 1"),
        (lambda: goal(1.0, 0.5, math.nan), "likelihood_after is nan"),
        (lambda: goal(1.0, 0.5, 1.0, liking=2.0), "liking is 2"),
        (lambda: goal(1.0, 0.5, 1.0, praiseworthiness=-2.0), "praiseworthiness is -2"),
        (lambda: goal(1.0, 0.5, 1.0, owner=""), "owner has 0 letters"),
        (lambda: GoalEvent("x" * 1000, 1.0, 1.0), "goal has 1000 letters"),
        (lambda: ActionEvent("deed", 1.5), "praiseworthiness is 1.5"),
        (lambda: ObjectEvent("ball", math.inf), "appeal is inf"),
    ],
)
def test_what_is_out_of_range_is_refused(make: Any, what: str) -> None:
    with pytest.raises(ValueError, match=what):
        make()
