import math

import pytest
from hypothesis import given, strategies as st

from hri.behavior.library.arithmetic import Addition
from hri.behavior.library.arrays import DoubleArraySplitter
from hri.behavior.library.constant import Constant, parsed
from hri.behavior.library.logic import Not
from hri.behavior.network import Network
from hri.core.errors import AuthoringError
from tests.behavior.library.ticking import tick

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3", 3.0),
        (" -5*pi/6 ", -5 * math.pi / 6),
        ("(1 + 2) * 3", 9.0),
        ("1, 2, 3", (1.0, 2.0, 3.0)),
        ("(1, 2, 3)", (1.0, 2.0, 3.0)),
        ("(1), (2)", (1.0, 2.0)),
        ("(pi/2, -1)", (math.pi / 2, -1.0)),
        ("4,", (4.0,)),
        ("()", ()),
        ("true", True),
        ("False", False),
        ("text from client", "text from client"),
        ("hello, world", "hello, world"),
        ('"5"', "5"),
        ("", ""),
        ("(", "("),
    ],
)
@pytest.mark.proves("B13", "B19")
def test_a_text_is_read_as_number_array_truth_or_text(text, value):
    assert parsed(text) == value
    assert type(parsed(text)) is type(value)
    assert tick(Constant(parsed_value=text)) == {"value": value}


@given(st.text(max_size=300))
def test_any_text_means_something_and_quotes_keep_it_as_it_is(text):
    assert isinstance(parsed(text), (float, str, bool, tuple))
    assert parsed(f'"{text}"') == text


@given(st.lists(NUMBERS, min_size=2))
def test_arrays_are_read_back(values):
    assert parsed(", ".join(map(repr, values))) == tuple(values)
    assert parsed(str(tuple(values))) == tuple(values)


def network(text):
    made = Network("test")
    for behavior in (Constant("c", parsed_value=text), Addition("sum"), Not("not")):
        made.add(behavior)
    made.add(DoubleArraySplitter("split"))
    return made


@pytest.mark.parametrize(
    ("text", "target"), [("5", "sum.input"), ("true", "not.input"), ("1, 2", "split.array")]
)
def test_a_constant_links_to_the_ports_of_its_datatype(text, target):
    network(text).connect("c.value", target)


def test_a_link_that_does_not_fit_is_refused_when_it_is_made():
    with pytest.raises(AuthoringError, match=r"c\.value is string, but sum\.input takes double"):
        network("fast").connect("c.value", "sum.input")


def test_the_value_may_change_while_it_runs():
    constant = Constant(parsed_value="1")
    constant.set_parameter("parsed_value", "2")
    assert tick(constant) == {"value": 2.0}
