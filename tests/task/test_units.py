import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.quantities import FACTORS, factor
from hri.task import units
from hri.task.units import (
    UNIT_ACCELERATION,
    UNIT_ANGLE,
    UNIT_DISTANCE,
    UNIT_TIME,
    UNIT_VELOCITY,
    convert_to_specified_units,
    get_default_units,
    in_si,
    set_default_units,
)

pytestmark = pytest.mark.proves("C04", "C06", "C07")

DEFAULTS = {UNIT_DISTANCE: "cm", UNIT_ANGLE: "rad", UNIT_TIME: "sec"}


@pytest.fixture(autouse=True)
def _restored():
    yield
    for quantity, unit in DEFAULTS.items():
        set_default_units(quantity, unit)


def test_the_defaults_are_those_of_2003():
    assert {quantity: get_default_units(quantity) for quantity in DEFAULTS} == DEFAULTS
    assert get_default_units(UNIT_VELOCITY) == "cm/sec"


def test_derived_units_follow():
    set_default_units(UNIT_DISTANCE, "inches")
    set_default_units(UNIT_TIME, "seconds")
    assert get_default_units(UNIT_VELOCITY) == "inches/seconds"
    assert convert_to_specified_units(UNIT_VELOCITY, "cm/s", 5) == pytest.approx(12.7)
    assert in_si(UNIT_ACCELERATION, 20) == pytest.approx(0.508)


def test_the_factor_from_default_units_to_milliseconds():
    assert convert_to_specified_units(UNIT_TIME, "millisecond", 1) == pytest.approx(1000)
    set_default_units(UNIT_TIME, "min")
    assert convert_to_specified_units(UNIT_TIME, "millisecond", 1) == pytest.approx(60_000)


def test_a_wrong_unit_changes_nothing():
    with pytest.raises(HriError, match='did you mean "degrees"'):
        set_default_units(UNIT_ANGLE, "degres")
    with pytest.raises(ValueError, match="follows from"):
        set_default_units(UNIT_VELOCITY, "cm/s")
    assert get_default_units(UNIT_ANGLE) == "rad"


@given(
    st.sampled_from(sorted(FACTORS["distance"])),
    st.sampled_from(sorted(FACTORS["time"])),
    st.floats(-1e6, 1e6),
)
def test_there_and_back(distance, time, value):
    set_default_units(UNIT_DISTANCE, distance)
    set_default_units(UNIT_TIME, time)
    unit = units.get_default_units(UNIT_VELOCITY)
    assert in_si(UNIT_VELOCITY, value) == pytest.approx(value * factor(UNIT_VELOCITY, unit))
    assert convert_to_specified_units(UNIT_VELOCITY, unit, value) == pytest.approx(value)
