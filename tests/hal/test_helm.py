"""Who steers a drive, as pure arithmetic."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.hal.helm import PROGRAM, Helm, Outranked, Rank, Writer

FIRST = Writer(object(), "the first", Rank.BEHAVIORS)
SECOND = Writer(object(), "the second", Rank.BEHAVIORS)
PERSON = Writer(object(), "the person", Rank.TELEOP)
IDLE = Writer(object(), "an idle gate", Rank.NOBODY)
WRITERS = [FIRST, SECOND, PERSON, IDLE, PROGRAM]
ORDER = list(Rank)


def test_the_more_important_takes_over_and_the_others_wait_until_it_is_silent() -> None:
    helm = Helm("drive")
    helm.take(FIRST, 0.0, 0.5)
    helm.take(PERSON, 0.1, 0.4)
    with pytest.raises(Outranked, match=r"drive: the person steers it \(rank teleop\)"):
        helm.take(FIRST, 0.2, 0.7)
    assert helm.rank(0.2) is Rank.TELEOP
    helm.take(FIRST, 0.41, 0.9)
    assert helm.rank(0.5) is Rank.BEHAVIORS
    assert helm.rank(1.0) is Rank.NOBODY


def test_who_came_first_goes_on_among_equals() -> None:
    helm = Helm("drive")
    helm.take(FIRST, 0.0, 0.5)
    with pytest.raises(Outranked):
        helm.take(SECOND, 0.1, 0.6)
    helm.take(FIRST, 0.2, 0.7)


def test_a_gate_that_nobody_asks_gives_way_to_all_and_takes_nothing() -> None:
    helm = Helm("drive")
    helm.take(IDLE, 0.0, 0.5)
    helm.take(PROGRAM, 0.1, math.inf)
    with pytest.raises(Outranked):
        helm.take(IDLE, 0.2, 0.7)
    assert helm.rank(0.2) is Rank.TASKS


def test_a_claim_is_refused_to_the_second_of_a_rank_and_names_both() -> None:
    helm = Helm("drive")
    helm.claim(FIRST)
    helm.claim(PERSON)
    with pytest.raises(HriError, match=r"the first steers it already.* as the second - stop one"):
        helm.claim(SECOND)
    helm.leave(FIRST)
    helm.claim(SECOND)


@given(st.lists(st.tuples(st.sampled_from(WRITERS), st.floats(0, 0.4)), max_size=40))
def test_nobody_is_interrupted_by_somebody_who_is_not_more_important(said) -> None:
    helm, now, until, steering = Helm("drive"), 0.0, -1.0, None
    for writer, pause in said:
        now += pause
        try:
            helm.take(writer, now, now + 0.5)
        except Outranked:
            assert steering is not None
            assert now <= until
            assert ORDER.index(writer.rank) >= ORDER.index(steering.rank)
            continue
        if steering is not None and steering is not writer and now <= until:
            assert ORDER.index(writer.rank) < ORDER.index(steering.rank)
        steering, until = (None if writer is IDLE else writer), now + 0.5
