import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.quantities import FACTORS, Quantity, cm, factor, inch, minute

pytestmark = pytest.mark.proves("C05", "C06")


@pytest.mark.parametrize(
    ("quantity", "unit", "expected"),
    [
        (Quantity.DISTANCE, "cm", cm),
        (Quantity.DISTANCE, "ft", 0.3048),
        (Quantity.DISTANCE, "m", 1.0),
        (Quantity.DISTANCE, "in", inch),
        (Quantity.DISTANCE, "inches", inch),
        (Quantity.ANGLE, "rad", 1.0),
        (Quantity.ANGLE, "deg", math.pi / 180),
        (Quantity.ANGLE, "degrees", math.pi / 180),
        (Quantity.TIME, "sec", 1.0),
        (Quantity.TIME, "seconds", 1.0),
        (Quantity.TIME, "min", minute),
        (Quantity.TIME, "millisecond", 0.001),
    ],
)
def test_all_spellings_of_2003(quantity, unit, expected):
    assert factor(quantity, unit) == expected


def test_derived_units_are_divided_by_time():
    assert factor(Quantity.VELOCITY, "in/s") == pytest.approx(0.0254)
    assert factor(Quantity.ACCELERATION, "ft/min^2") == pytest.approx(0.3048 / 3600)
    assert factor(Quantity.ANGULAR_VELOCITY, "degrees/second") == pytest.approx(math.pi / 180)


@pytest.mark.parametrize(
    ("quantity", "unit", "message"),
    [
        (Quantity.DISTANCE, "inchs", 'unknown unit of distance "inchs" - did you mean "inches"?'),
        (Quantity.ANGLE, "cm", "unknown unit of angle"),
        (Quantity.VELOCITY, "cm", "not a unit of velocity - try m/s"),
        (Quantity.VELOCITY, "cm/s^2", "not a unit of velocity"),
        (Quantity.ACCELERATION, "cm/s", "not a unit of acceleration - try m/s^2"),
        (Quantity.DISTANCE, "cm/s", "not a unit of distance - try m"),
        (Quantity.VELOCITY, "cm/hour", "unknown unit of time"),
    ],
)
def test_a_wrong_unit_is_named(quantity, unit, message):
    with pytest.raises(HriError) as error:
        factor(quantity, unit)
    assert message in str(error.value)


@given(
    st.sampled_from(sorted(FACTORS["distance"])),
    st.sampled_from(sorted(FACTORS["time"])),
    st.integers(1, 2),
)
def test_a_derived_unit_is_its_distance_by_its_time(distance, time, power):
    quantity = {1: Quantity.VELOCITY, 2: Quantity.ACCELERATION}[power]
    exponent = "" if power == 1 else "^2"
    expected = FACTORS["distance"][distance] / FACTORS["time"][time] ** power
    assert factor(quantity, f"{distance}/{time}{exponent}") == pytest.approx(expected)
