import math
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from hri.emotion.formula import DEEPEST, LONGEST, parse_formula

EVENT = {
    "value": 0.25,
    "level": 3,
    "pressed": True,
    "rule": "praise",
    "path": [1, 2],
    "odd": math.nan,
}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.5", 0.5),
        ("clip(value, 0, 1)", 0.25),
        ("clip(level, 0, 1)", 1.0),
        ("1 - 2 * value", 0.5),
        ("-(level - 4) / 2", 0.5),
        ("min(level, value, 1) + max(0, -value)", 0.25),
        ("abs(value - 1)", 0.75),
        ("level > 2", 1.0),
        ("(level > 2) * (value >= 0.3)", 0.0),
        ("pressed", 1.0),
        ("rule == 'praise'", 1.0),
        ('0.8 * (rule != "scold")', 0.8),
        ("value == 0.25", 1.0),
        ("rule == 1", 0.0),
    ],
)
def test_a_formula_is_worked_out(text: str, value: float) -> None:
    assert parse_formula(text).value(EVENT) == pytest.approx(value)


def test_it_knows_the_fields_that_it_asks_for() -> None:
    assert parse_formula("clip(a, 0, b) * (c == 'x')").fields == {"a", "b", "c"}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "value +",
        "__import__('os').system('true')",
        "value.real",
        "path[0]",
        "(lambda: 1)()",
        "[1 for x in path]",
        "value ** 9",
        "2 ** 2 ** 99",
        "1 < value < 2",
        "value and level",
        "not value",
        "value if level else 0",
        "sin(value)",
        "min(value)",
        "clip(value)",
        "clip(value, low=0, high=1)",
        "abs(*path)",
        "'praise'",
        "'a' < rule",
        "True",
        "1j",
        "f'{value}'",
        "(x := 1)",
        "9" * 190 + "e99999",
        "value\0",
        "value in path",
        "value is 1",
    ],
)
def test_what_is_no_formula_is_refused_in_one_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w") as caught:
        parse_formula(text)
    assert "\n" not in str(caught.value).replace(text, "")


@pytest.mark.parametrize(
    "text",
    [
        "1" + " + 1" * LONGEST,
        "(" * 150 + "1" + ")" * 150,
        "-" * 150 + "1",
        "abs(" * 45 + "1" + ")" * 45,
    ],
)
def test_a_formula_without_end_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"within each other|characters|no formula"):
        parse_formula(text)


def test_a_deep_formula_within_the_limits_is_fine() -> None:
    text = "-" * (DEEPEST - 2) + "1"
    assert parse_formula(text).value({}) == 1.0


@pytest.mark.parametrize("operator", "+-*")
def test_a_long_row_is_not_deep(operator: str) -> None:
    text = operator.join(["value"] * 33)
    assert math.isfinite(parse_formula(text).value({"value": 1.0}))
    assert parse_formula("+".join(["1"] * 100)).value({}) == 100.0


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("missing", 'no field "missing"'),
        ("valu", 'did you mean "value"'),
        ("rule + 1", "is a text"),
        ("rule", "is a text"),
        ("path", "not a number"),
        ("1 / (value - value)", "divides by zero"),
        ("odd", "is nan"),
        ("1e300 * 1e300", "is inf"),
        ("rule < 2", "is a text"),
    ],
)
def test_an_event_that_does_not_fit_is_told(text: str, what: str) -> None:
    with pytest.raises(ValueError, match=what):
        parse_formula(text).value(EVENT)


@settings(deadline=None)
@given(st.text(max_size=60))
def test_no_text_does_more_than_be_refused(text: str) -> None:
    try:
        formula = parse_formula(text)
    except ValueError:
        return
    properties: dict[str, Any] = dict.fromkeys(formula.fields, 0.5)
    try:
        assert 0.0 <= formula.intensity(properties) <= 1.0
    except ValueError:
        return


@given(st.floats() | st.integers() | st.booleans() | st.text(max_size=5) | st.none())
def test_an_intensity_is_within_0_and_1_or_refused(value: object) -> None:
    formula = parse_formula("2 * value - 0.5")
    try:
        assert 0.0 <= formula.intensity({"value": value}) <= 1.0
    except ValueError:
        return
