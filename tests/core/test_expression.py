import contextlib
import math
import warnings

import pytest
from hypothesis import given, strategies as st

from hri.core.expression import evaluate


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-pi/4", -math.pi / 4),
        ("5*pi/6", 5 * math.pi / 6),
        ("-5*pi/6", -5 * math.pi / 6),
        ("150E-6", 150e-6),
        ("-1711", -1711),
        (" 1/30 ", 1 / 30),
        ("(1+2)*3", 9),
    ],
)
def test_expressions_of_configurations(text, value):
    assert evaluate(text) == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "abc",
        "1/0",
        "__import__('os')",
        "2**9999",
        "1e400",
        "True",
        "[1]",
        "9" * 300,
        "pi()",
        "1j",
    ],
)
def test_everything_else_is_refused_with_a_sentence(text):
    with pytest.raises(ValueError, match=r"\w"):
        evaluate(text)


@given(st.text(max_size=80))
def test_no_text_does_anything_but_give_a_number_or_a_value_error(text):
    with contextlib.suppress(ValueError):
        assert math.isfinite(evaluate(text))


@given(st.text("0123456789.eEpi+-*/() xj_", max_size=120))
def test_nothing_that_looks_like_arithmetic_does_more(text):
    with contextlib.suppress(ValueError):
        assert math.isfinite(evaluate(text))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_number_reads_back(number):
    assert evaluate(repr(number)) == number


def test_a_refused_expression_warns_of_nothing():
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        with pytest.raises(ValueError, match="not a number"):
            evaluate("1or 2")
    assert warned == []
