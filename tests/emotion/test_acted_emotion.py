import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.signals import EmotionState
from hri.emotion.acted_emotion import MOST_ACTS, NOTHING_ACTED, whole_vector
from hri.emotion.emotions import NAMES

SAD = EmotionState("sadness", 0.5, -0.2, -0.1, -0.1, {"sadness": 0.5, "joy": 0.1})
NUMBERS = st.floats(0, 1)


def test_what_is_put_on_is_shown_until_its_time_is_over() -> None:
    acting = NOTHING_ACTED.set({"joy": 0.9}, duration=2.0, now=10.0)
    shown = acting.shown(SAD, 11.9)
    assert (shown.label, shown.intensity) == ("joy", 0.9)
    assert shown.emotions == {"sadness": 0.5, "joy": 0.9}
    assert shown.valence == SAD.valence
    assert acting.ends(11.0) == 12.0
    assert acting.shown(SAD, 12.0) is SAD
    assert acting.ends(13.0) == 13.0


def test_a_newer_act_counts_and_leaves_other_emotions_alone() -> None:
    acting = NOTHING_ACTED.set({"joy": 0.9, "anger": 0.3}, 5.0, now=0.0)
    acting = acting.set({"joy": 0.4}, 1.0, now=0.0)
    assert acting.shown(SAD, 0.5).emotions == {"sadness": 0.5, "joy": 0.4, "anger": 0.3}
    assert acting.shown(SAD, 2.0).emotions == {"sadness": 0.5, "joy": 0.9, "anger": 0.3}


def test_an_increment_starts_from_what_is_shown_and_stops_at_the_ends() -> None:
    acting = NOTHING_ACTED.raised("sadness", 0.2, SAD, 5.0, now=0.0)
    assert acting.shown(SAD, 1.0).emotions["sadness"] == pytest.approx(0.7)
    acting = acting.raised("sadness", 0.2, SAD, 5.0, now=1.0)
    assert acting.shown(SAD, 1.0).emotions["sadness"] == pytest.approx(0.9)
    assert acting.raised("sadness", 1.0, SAD, 5.0, 1.0).shown(SAD, 1.0).intensity == 1.0
    assert acting.raised("sadness", -1.0, SAD, 5.0, 1.0).shown(SAD, 1.0).emotions["sadness"] == 0.0


def test_what_was_put_on_for_longer_is_shown_again_after_something_shorter() -> None:
    acting = NOTHING_ACTED.set({"joy": 0.5}, 10.0, now=0.0).raised("joy", 0.3, SAD, 2.0, now=1.0)
    joys = [acting.shown(SAD, now).emotions["joy"] for now in (1.0, 2.9, 3.0, 9.9, 10.0)]
    assert joys == [pytest.approx(0.8), pytest.approx(0.8), 0.5, 0.5, 0.1]
    assert acting.ends(5.0) == 10.0
    longer = acting.set({"joy": 0.2}, 20.0, now=1.5)
    assert [longer.shown(SAD, now).emotions["joy"] for now in (2.0, 11.0)] == [0.2, 0.2]
    for step in range(10 * MOST_ACTS):
        acting = acting.set({"joy": 0.1}, 9.0 - 0.01 * step, now=0.0)
    assert len(acting.acts["joy"]) == MOST_ACTS


def test_a_feeling_that_is_hidden_leaves_the_mood_to_be_seen() -> None:
    shown = NOTHING_ACTED.set(whole_vector({}), 1.0, 0.0).shown(SAD, 0.5)
    assert shown.label == "bored"
    assert set(shown.emotions.values()) == {0.0}
    still = EmotionState("sadness", 0.5, 0.0, 0.0, 0.0, {"sadness": 0.5})
    assert NOTHING_ACTED.set({"sadness": 0.0}, 1.0, 0.0).shown(still, 0.5).label == "calm"


def test_a_whole_vector_is_given_by_name_or_in_order() -> None:
    by_name = whole_vector({"fear": 0.5})
    assert set(by_name) == set(NAMES)
    assert sum(by_name.values()) == by_name["fear"] == 0.5
    assert whole_vector(list(by_name.values())) == by_name
    with pytest.raises(HriError, match=f"2 values for {len(NAMES)} emotions - give one for each"):
        whole_vector([0.1, 0.2])


@pytest.mark.parametrize(
    ("emotion", "value", "duration", "told"),
    [
        ("joyy", 0.5, 1.0, 'no emotion "joyy" - did you mean "joy"?'),
        ("joy", 1.5, 1.0, "joy of 1.5 - give 0 to 1"),
        ("joy", math.nan, 1.0, "joy of nan - give 0 to 1"),
        ("joy", 0.5, 0.0, "an emotion for 0.0 seconds - give a time above 0"),
        ("joy", 0.5, math.nan, "an emotion for nan seconds - give a time above 0"),
    ],
)
def test_mistakes_are_told(emotion: str, value: float, duration: float, told: str) -> None:
    with pytest.raises(HriError) as error:
        NOTHING_ACTED.set({emotion: value}, duration, 0.0)
    assert told in str(error.value)


@given(st.dictionaries(st.sampled_from(NAMES), NUMBERS), NUMBERS, NUMBERS)
def test_what_is_shown_is_always_within_its_range(
    values: dict[str, float], felt: float, increment: float
) -> None:
    state = EmotionState("joy", felt, 0.1, 0.0, 0.0, {"joy": felt})
    acting = NOTHING_ACTED.set(values, 1.0, 0.0).raised("joy", increment, state, 1.0, 0.0)
    shown = acting.shown(state, 0.5)
    assert all(0 <= value <= 1 for value in shown.emotions.values())
    assert 0 <= shown.intensity <= 1
    assert shown.emotions["joy"] >= values.get("joy", felt)
