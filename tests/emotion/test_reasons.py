import pytest
from hypothesis import given, strategies as st

from hri.emotion.ledger import Cause
from hri.emotion.reasons import age_words, why_words

WORDS = {"scold": "you scolded me", "bump": "I bumped into something", "praise": "you praised me"}


def test_one_cause_is_the_reason() -> None:
    causes = [Cause("scold", 1.0, 2.0)]
    assert why_words("sad", causes, WORDS, {}) == "I am sad because you scolded me."


def test_of_two_causes_the_larger_weighs_more_and_each_has_its_age() -> None:
    causes = [Cause("scold", 0.7, 130.0), Cause("bump", 0.25, 30.0), Cause("praise", 0.05, 1.0)]
    told = why_words("sad", causes, WORDS, {})
    assert told == (
        "I am sad, mostly because you scolded me 2 minutes ago, "
        "and a little because I bumped into something a moment ago."
    )
    causes = [Cause("scold", 0.5, 0.0), Cause("bump", 0.45, 0.0)]
    told = why_words("sad", causes, WORDS, {})
    assert told == "I am sad because you scolded me, and because I bumped into something."


@pytest.mark.parametrize(
    ("person", "told"),
    [("Anna", "Anna praised me"), (None, "you praised me"), ("p12", "you praised me")],
)
def test_who_has_a_name_is_named(person: str | None, told: str) -> None:
    words = {"praise": "{you} praised me"}
    causes = [Cause("praise", 1.0, 0.0, person)]
    assert why_words("happy", causes, words, {}) == f"I am happy because {told}."


def test_what_two_people_did_is_one_reason_where_the_words_are_the_same() -> None:
    causes = [Cause("praise", 0.6, 0.0, "p1"), Cause("praise", 0.35, 0.0, "p2")]
    told = why_words("happy", causes, {"praise": "{you} praised me"}, {})
    assert told == "I am happy because you praised me."


def test_a_cause_that_is_most_of_it_is_the_reason() -> None:
    causes = [Cause("scold", 0.8, 0.0), Cause("bump", 0.15, 0.0)]
    assert why_words("sad", causes, WORDS, {}) == "I am sad because you scolded me."


def test_how_it_is_comes_last_among_the_reasons() -> None:
    causes = [Cause("temperament", 0.7, 0.0), Cause("scold", 0.3, 0.0)]
    told = why_words("sad", causes, WORDS, {})
    assert told == "I am sad because you scolded me, and because that is how I am."


def test_one_is_sorry_that_and_sad_because() -> None:
    causes = [Cause("scold", 1.0, 0.0)]
    assert why_words("very sorry", causes, WORDS, {}) == "I am very sorry that you scolded me."
    exam = {"goal.exam": "of {your} exam"}
    told = why_words("sorry", [Cause("goal.exam", 1.0, 0.0, "Anna")], exam, {})
    assert told == "I am sorry because of Anna's exam."


def test_what_speaks_against_a_feeling_is_said_so() -> None:
    causes = [Cause("goal.x", 1.0, 0.0, lasts=True)]
    told = why_words("hopeful", causes, {"goal.x": "even though she is not here yet"}, {})
    assert told == "I am hopeful even though she is not here yet."


def test_what_pulls_the_other_way_or_has_no_words_is_not_told() -> None:
    causes = [Cause("other", 1.2, 0.0), Cause("praise", -0.2, 0.0)]
    assert why_words("calm", [], WORDS, {}) == "I am calm, for no special reason."
    assert why_words("sad", causes, WORDS, {}) == "I am sad, for no special reason."


@pytest.mark.parametrize(
    ("cause", "needs", "reason"),
    [
        ("temperament", {}, "that is how I am"),
        ("drive.company", {"company": 0.9}, "I have been alone"),
        ("drive.company", {"company": 0.1}, "I have had company"),
        ("drive.energy", {"energy": 1.0, "company": 0.0}, "my battery runs down"),
    ],
)
def test_what_is_no_stimulus_has_words_too(
    cause: str, needs: dict[str, float], reason: str
) -> None:
    told = why_words("so", [Cause(cause, 1.0, 0.0)], WORDS, needs)
    assert told == f"I am so because {reason}."


@pytest.mark.parametrize(
    ("age_s", "words"),
    [
        (0.0, ""),
        (9.9, ""),
        (10.0, "a moment ago"),
        (59.7, "a minute ago"),
        (100.0, "2 minutes ago"),
        (660.0, "11 minutes ago"),
        (840.0, "15 minutes ago"),
        (1700.0, "half an hour ago"),
        (2200.0, "half an hour ago"),
        (3180.0, "50 minutes ago"),
        (3590.0, "an hour ago"),
        (7300.0, "2 hours ago"),
        (86390.0, "a day ago"),
        (300000.0, "3 days ago"),
    ],
)
def test_ages_are_told_in_the_unit_that_people_use(age_s: float, words: str) -> None:
    assert age_words(age_s) == words


@given(st.floats(0, 1e9))
def test_every_age_has_words_without_large_numbers_of_small_units(age_s: float) -> None:
    words = age_words(age_s)
    number = next((int(word) for word in words.split() if word.isdigit()), 0)
    assert "minutes" not in words or 1 < number < 60
    assert number <= 12 or "minutes" not in words or number % 5 == 0
    assert "24 hours" not in words


@pytest.mark.parametrize(
    "lasting",
    [
        "nobody has talked to me for a while",
        "my battery is low",
        "I waited for two hours",
        "someone rang yesterday",
        "you called me an hour ago",
    ],
)
def test_what_lasts_or_says_its_own_time_is_no_time_ago(lasting: str) -> None:
    told = why_words("bored", [Cause("x", 1.0, 40.0)], {"x": lasting}, {})
    assert told == f"I am bored because {lasting}."


def test_what_is_over_has_its_age() -> None:
    told = why_words("happy", [Cause("x", 1.0, 40.0)], {"x": "you took me for a walk"}, {})
    assert told == "I am happy because you took me for a walk a moment ago."
