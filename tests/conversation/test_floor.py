"""When the robot may say something that nobody asked for."""

import dataclasses

import pytest
from hypothesis import given, strategies as st

from hri.conversation.floor import (
    BETWEEN_SECONDS,
    CALM_SECONDS,
    COMPANY_SECONDS,
    FAREWELL_SECONDS,
    GIVES_WAY_SECONDS,
    NEVER,
    TENDER_SECONDS,
    UNSEEN_SECONDS,
    Importance,
    Scene,
    gives_way,
    is_night,
    may_begin,
    may_murmur,
    why_silent,
)

FREE = Scene(now=1000.0, hour=10, is_seen=True, understood=990.0)


def changed(**changes):
    return dataclasses.replace(FREE, **changes)


def test_it_may_begin_when_someone_is_there_and_nothing_goes_on():
    assert why_silent(FREE) == ""


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"is_asleep": True}, "it sleeps"),
        ({"is_quiet": True}, "it was asked to be quiet"),
        ({"tender": 1001.0 - TENDER_SECONDS}, "someone told it something sad"),
        ({"is_voice_heard": True}, "someone speaks"),
        ({"is_speaking": True}, "it speaks"),
        ({"is_question_open": True}, "a question is open"),
        ({"is_driving": True}, "it drives"),
        ({"hour": 22}, "it is night"),
        ({"hour": 5}, "it is night"),
        ({"puzzled": 995.0}, "it did not understand"),
        ({"farewell": 981.0, "understood": 982.0}, "someone said goodbye"),
        ({"dialogue": 981.0}, "a dialogue goes on"),
        ({"voice": 995.0}, "someone spoke just now"),
        ({"understood": 995.0}, "someone spoke just now"),
        ({"spoke": 999.0}, "someone spoke just now"),
        ({"understood": 900.0}, "no one is there"),
        ({"understood": NEVER}, "no one is there"),
        ({"is_seen": False, "understood": 975.0}, "no one is there"),
        ({"wondered": 970.0}, "it asked just now"),
    ],
)
def test_why_it_does_not_begin(changes, why):
    assert why_silent(changed(**changes)) == why


def test_what_was_not_understood_counts_until_something_is_understood():
    assert may_begin(changed(puzzled=985.0, understood=990.0))


times = st.one_of(st.just(NEVER), st.floats(0.0, 1000.0))
scenes = st.builds(
    Scene,
    now=st.just(1000.0),
    hour=st.integers(0, 23),
    is_asleep=st.booleans(),
    is_quiet=st.booleans(),
    is_voice_heard=st.booleans(),
    is_speaking=st.booleans(),
    is_question_open=st.booleans(),
    is_driving=st.booleans(),
    is_seen=st.booleans(),
    understood=times,
    voice=times,
    puzzled=times,
    farewell=times,
    dialogue=times,
    wondered=times,
)
NEAR_FREE = scenes.map(
    lambda scene: dataclasses.replace(
        scene, understood=985.0, is_asleep=False, is_quiet=False, is_speaking=False
    )
)


@given(st.one_of(scenes, NEAR_FREE))
def test_it_never_talks_over_people(scene):
    if may_begin(scene):
        assert not any([scene.is_voice_heard, scene.is_question_open, scene.is_driving])
        assert not is_night(scene.hour)
        assert scene.now - scene.farewell >= FAREWELL_SECONDS
        assert scene.now - scene.voice >= CALM_SECONDS
        assert scene.now - scene.wondered >= BETWEEN_SECONDS
        assert scene.puzzled <= scene.understood
        patience = COMPANY_SECONDS if scene.is_seen else UNSEEN_SECONDS
        assert CALM_SECONDS <= scene.now - scene.understood < patience


@given(scenes, st.sampled_from(["is_voice_heard", "is_question_open", "is_driving", "is_asleep"]))
def test_more_that_goes_on_never_lets_it_begin(scene, what):
    busier = dataclasses.replace(scene, **{what: True})
    assert not may_begin(busier)


@given(st.floats(0.0, 100.0), st.floats(-5.0, 5.0))
def test_who_began_no_later_than_a_moment_after_it_has_the_floor(begun, later):
    voice = begun + later
    assert gives_way(begun, voice) == (voice - begun <= GIVES_WAY_SECONDS)


STILL = Scene(now=1000.0, hour=10, understood=930.0, voice=920.0)


def test_it_hums_to_itself_when_nothing_happens_and_someone_was_there():
    assert may_murmur(STILL)
    assert may_murmur(dataclasses.replace(STILL, is_seen=True))


@pytest.mark.parametrize(
    "changes",
    [
        {"understood": 950.0},
        {"voice": 995.0},
        {"dialogue": 990.0},
        {"understood": 50.0, "voice": 50.0},
        {"understood": NEVER, "voice": 900.0},
        {"tender": 900.0},
        {"is_asleep": True},
        {"is_quiet": True},
        {"is_voice_heard": True},
        {"is_speaking": True},
        {"is_question_open": True},
        {"is_driving": True},
        {"hour": 23},
    ],
)
def test_it_does_not_hum_into_anything(changes):
    assert not may_murmur(dataclasses.replace(STILL, **changes))


@pytest.mark.parametrize(
    "changes",
    [{"is_driving": True}, {"understood": NEVER}, {"puzzled": 995.0}, {"wondered": 970.0}],
)
def test_news_wait_for_less_than_chat(changes):
    assert not may_begin(changed(**changes))
    assert may_begin(changed(**changes), Importance.NEWS)


@pytest.mark.parametrize(
    "changes",
    [{"is_asleep": True}, {"is_quiet": True}, {"hour": 3}, {"dialogue": 995.0}, {"voice": 999.5}],
)
def test_an_alarm_waits_for_less_than_news(changes):
    assert not may_begin(changed(**changes), Importance.NEWS)
    assert may_begin(changed(**changes), Importance.ALARM)


@pytest.mark.parametrize("name", ["is_voice_heard", "is_speaking", "is_question_open"])
def test_not_even_an_alarm_talks_into_a_sentence(name):
    assert not may_begin(changed(**{name: True}), Importance.ALARM)


@pytest.mark.parametrize(
    ("hours", "hour", "is_quiet"),
    [((22, 6), 23, True), ((13, 15), 14, True), ((13, 15), 15, False), ((0, 0), 3, False)],
)
def test_quiet_hours_are_those_of_the_app(hours, hour, is_quiet):
    scene = changed(quiet_hours=hours, hour=hour)
    assert (why_silent(scene, Importance.NEWS) == "it is night") == is_quiet
