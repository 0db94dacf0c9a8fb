import math
import sys

import pytest
from hypothesis import given, strategies as st

from hri.behavior.library.arithmetic import (
    Absolute,
    Addition,
    Division,
    Maximum,
    Minimum,
    Multiplication,
    Subtraction,
)
from hri.behavior.library.arrays import DoubleArrayJoiner, DoubleArraySplitter
from hri.behavior.library.comparison import Equal, Greater, Less
from hri.behavior.library.logic import And, Not, Or
from hri.behavior.library.selection import Select
from tests.behavior.library.ticking import Links, tick

REASONABLE = st.floats(-1e6, 1e6)
ANY_NUMBER = st.floats()
MANY = st.lists(st.none() | REASONABLE, max_size=6)
FOLDS = {
    Addition: ("sum", sum),
    Multiplication: ("product", math.prod),
    Minimum: ("minimum", min),
    Maximum: ("maximum", max),
}


@pytest.mark.proves("B11", "B19")
@pytest.mark.parametrize("cls", FOLDS)
@given(links=MANY)
def test_folds_take_all_links_skip_those_that_carry_nothing_and_commute(cls, links):
    output, fold = FOLDS[cls]
    came_in = [value for value in links if value is not None]
    sent = tick(cls(), input=Links(links))
    turned = tick(cls(), input=Links(reversed(links)))
    if not came_in:
        assert sent == turned == {}
    else:
        assert sent[output] == pytest.approx(fold(came_in))
        assert turned[output] == pytest.approx(sent[output], rel=1e-9, abs=1e-6)


@pytest.mark.proves("B19")
@given(positive=MANY, negative=MANY)
def test_subtraction_takes_the_sum_of_the_negative_from_the_sum_of_the_positive(positive, negative):
    sent = tick(Subtraction(), input_positive=Links(positive), input_negative=Links(negative))
    plus = [value for value in positive if value is not None]
    minus = [value for value in negative if value is not None]
    assert sent == ({"difference": sum(plus) - sum(minus)} if plus else {})


@given(dividend=st.none() | REASONABLE, divisor=st.none() | REASONABLE)
def test_division_sends_nothing_where_there_is_no_quotient(dividend, divisor):
    sent = tick(Division(), dividend=dividend, divisor=divisor)
    assert bool(sent) == (dividend is not None and divisor not in (None, 0.0))
    if sent:
        assert sent["quotient"] == dividend / divisor


@pytest.mark.parametrize("cls", [*FOLDS, Subtraction, Division, Absolute])
@given(values=st.lists(ANY_NUMBER, min_size=2, max_size=2))
def test_no_operator_sends_what_is_no_number(cls, values):
    ports = dict.fromkeys(cls.inputs, Links(values))
    assert not any(math.isnan(value) for value in tick(cls(), **ports).values())


@given(REASONABLE)
def test_absolute_is_never_negative_and_idempotent(value):
    once = tick(Absolute(), input=value)["magnitude"]
    assert once >= 0
    assert tick(Absolute(), input=once)["magnitude"] == once


@given(first=REASONABLE, second=REASONABLE)
def test_just_one_of_less_equal_greater_holds(first, second):
    pair = {"first": first, "second": second}
    results = [
        tick(Less(), **pair)["is_less"],
        tick(Equal(tolerance=0.0), **pair)["is_equal"],
        tick(Greater(), **pair)["is_greater"],
    ]
    assert results.count(True) == 1
    assert tick(Less(), first=second, second=first)["is_less"] == results[2]


@pytest.mark.parametrize("cls", [Less, Equal, Greater])
def test_a_comparison_without_both_numbers_says_nothing(cls):
    assert tick(cls(), first=1.0) == tick(cls(), second=1.0) == tick(cls()) == {}


def test_equal_has_a_tolerance_and_knows_infinity():
    assert tick(Equal(tolerance=0.5), first=1.0, second=1.5) == {"is_equal": True}
    assert tick(Equal(tolerance=0.5), first=1.0, second=1.6) == {"is_equal": False}
    assert tick(Equal(), first=math.inf, second=math.inf) == {"is_equal": True}


@given(st.lists(st.none() | st.booleans(), max_size=5))
def test_logic_follows_de_morgan_and_skips_what_is_missing(truths):
    opposites = [None if truth is None else not truth for truth in truths]
    both = tick(And(), input=Links(truths))
    either = tick(Or(), input=Links(opposites))
    assert tick(Not(), input=either.get("result")) == both
    assert bool(both) == any(truth is not None for truth in truths)


def test_select_passes_the_chosen_value_of_any_datatype():
    values = {"when_true": "yes", "when_false": (1.0, 2.0)}
    assert tick(Select(), choice=True, **values) == {"selected": "yes"}
    assert tick(Select(), choice=False, **values) == {"selected": (1.0, 2.0)}
    assert tick(Select(), **values) == {}
    assert tick(Select(), choice=False, when_true="yes") == {}


@pytest.mark.proves("B19")
@given(st.lists(ANY_NUMBER.filter(lambda value: not math.isnan(value)), max_size=6))
def test_an_array_is_split_and_joined_again(elements):
    names = ("first", "second", "third", "fourth")
    parts = tick(DoubleArraySplitter(), array=tuple(elements))
    assert tuple(parts) == names[: len(elements)]
    joined = tick(DoubleArrayJoiner(), **parts)
    assert joined.get("array", ()) == tuple(elements[:4])


def test_a_joiner_waits_for_all_linked_inputs_so_that_no_element_changes_place():
    assert tick(DoubleArrayJoiner(), first=1.0, second=None, third=3.0) == {}
    assert tick(DoubleArrayJoiner(), first=1.0, third=3.0) == {"array": (1.0, 3.0)}
    assert tick(DoubleArrayJoiner()) == tick(DoubleArraySplitter()) == {}


def test_the_largest_number_stands_a_sum():
    largest = sys.float_info.max
    assert tick(Addition(), input=Links([largest, largest])) == {"sum": math.inf}
    assert tick(Addition(), input=Links([math.inf, -math.inf])) == {}
