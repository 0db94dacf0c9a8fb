"""Which words are said, whatever was said before."""

from dataclasses import replace

from hypothesis import given, strategies as st

from hri.conversation.choosing import (
    MOST_REMEMBERED,
    RECENT_SECONDS,
    Moment,
    Pool,
    Spoken,
    Wording,
    pools,
)
from hri.emotion.emotions import NAMES
from hri.emotion.everyday_words import FEELINGS, KNOWN_FEELINGS, fitting
from hri.emotion.label import MOODS

LABELS = (*NAMES, *MOODS)
TEXTS = st.lists(st.sampled_from("abcdefgh"), min_size=1, max_size=6, unique=True).map(tuple)
FOUND = st.lists(TEXTS.map(Pool), min_size=1, max_size=2)
TURNS = st.lists(st.tuples(FOUND, st.floats(0.0, 400.0)), max_size=40)


def said_in(turns, spoken):
    """What is said, with the texts that fitted and what had been said within five minutes."""
    now, before, told = 0.0, [], []
    for found, pause in turns:
        now += pause
        text, pool = spoken.choose(found, now)
        recent = {words for words, when in before if now - when < RECENT_SECONDS}
        told.append((text, pool, {one for each in found for one in each.texts}, recent))
        spoken.note(text, now)
        before.append((text, now))
    return told


@given(TURNS)
def test_nothing_is_said_again_within_five_minutes_while_something_else_fits(turns):
    for text, pool, texts, recent in said_in(turns, Spoken()):
        assert text in pool.texts
        assert text not in recent or texts <= recent


@given(TURNS)
def test_the_same_visit_gives_the_same_words(turns):
    assert said_in(turns, Spoken()) == said_in(turns, Spoken())


@given(TEXTS, st.integers(1, 30))
def test_each_text_has_its_turn(texts, rounds):
    told = said_in([([Pool(texts)], 400.0)] * (rounds * len(texts)), Spoken())
    assert [text for text, *_ in told] == list(texts) * rounds


@given(st.lists(st.text(max_size=4), max_size=50))
def test_the_memory_is_bounded(texts):
    spoken = Spoken(most=5)
    for number, text in enumerate(texts):
        spoken.note(text, float(number))
        spoken.answer(text, float(number))
    assert max(len(spoken._said), len(spoken._answered)) <= 5
    assert MOST_REMEMBERED >= 5


def test_where_nothing_fits_nothing_is_said():
    assert Spoken().choose([], 0.0) == ("", Pool())
    assert pools(Wording(), Moment()) == []


def test_a_rule_is_answered_again_for_five_minutes():
    spoken = Spoken()
    answered = [spoken.answer("name", now) for now in (0.0, 299.0, 600.0)]
    assert answered == [False, True, False]
    assert not spoken.answer("time", 600.0)


ALL = Wording(
    say=("Hi.",),
    again=("Hi again.",),
    feeling={"angry": ("What?",), "hate": ("You.",)},
    hour={"night": ("Up late?",)},
    personality={"shy": ("Oh, hi.",)},
)


def texts_at(**moment):
    return [pool.texts for pool in pools(ALL, Moment(**moment))]


def test_hour_and_personality_widen_what_is_said():
    assert texts_at() == [("Hi.",)]
    assert texts_at(part_of_day="night", personality="shy") == [("Up late?", "Oh, hi.", "Hi.")]


def test_a_feeling_replaces_it():
    assert texts_at(feeling="anger", part_of_day="night") == [("What?",)]
    assert texts_at(feeling="hate") == [("You.",)]
    assert [pool.is_felt for pool in pools(ALL, Moment(feeling="anger"))] == [True]
    assert [pool.is_felt for pool in pools(ALL, Moment("anger", is_again=True))] == [True, True]
    assert [pool.is_felt for pool in pools(ALL, Moment("joy", is_again=True))] == [False, False]


def test_again_comes_first_and_the_rest_is_left_when_it_is_used_up():
    assert texts_at(is_again=True) == [("Hi again.",), ("Hi.",)]
    worn = replace(ALL, worn=("Hi, hi, hi.",))
    found = pools(worn, Moment(is_again=True, is_worn=True))
    assert [pool.texts for pool in found] == [("Hi, hi, hi.",), ("Hi again.",), ("Hi.",)]
    assert texts_at(is_again=True, feeling="anger") == [("Hi again.",), ("What?",)]
    spoken, told = Spoken(), []
    for now in (0.0, 10.0, 20.0):
        found = pools(ALL, Moment(is_again=spoken.answer("greet", now)))
        told.append(spoken.choose(found, now)[0])
        spoken.note(told[-1], now)
    assert told == ["Hi.", "Hi again.", "Hi."]


@given(st.sampled_from(LABELS))
def test_each_feeling_has_one_everyday_word(label):
    words = [word for word, labels in FEELINGS.items() if label in labels]
    assert len(words) == 1
    assert fitting(label, FEELINGS) in (label, *words)
    assert fitting(label, (label, *words)) == label
    assert label in KNOWN_FEELINGS


@given(st.sampled_from(LABELS), st.sets(st.sampled_from(sorted(KNOWN_FEELINGS))))
def test_words_never_fit_another_feeling(label, given_words):
    found = fitting(label, given_words)
    assert not found or found == label or label in FEELINGS[found]
