"""The units in which tasks take and give numbers: centimeters, radians, seconds at first.

They hold for the whole process, for all threads and tasks, like in 2003: a program sets them once,
before its first task. They hold for the tasks of `hri.task.navigation` and its neighbors only;
everything below, and every `robot.move(0.5)`, is in SI units.

set_default_units(UNIT_DISTANCE, "inches")
in_si(UNIT_VELOCITY, 5)  # 0.127 meters a second
"""

from __future__ import annotations

from hri.core.quantities import Quantity, factor

UNIT_DISTANCE = Quantity.DISTANCE
UNIT_ANGLE = Quantity.ANGLE
UNIT_TIME = Quantity.TIME
UNIT_VELOCITY = Quantity.VELOCITY
UNIT_ACCELERATION = Quantity.ACCELERATION
UNIT_ANGULAR_VELOCITY = Quantity.ANGULAR_VELOCITY
UNIT_ANGULAR_ACCELERATION = Quantity.ANGULAR_ACCELERATION

_BASES = {"distance": UNIT_DISTANCE, "angle": UNIT_ANGLE, "time": UNIT_TIME}

_default = {UNIT_DISTANCE: "cm", UNIT_ANGLE: "rad", UNIT_TIME: "sec"}


def set_default_units(quantity: Quantity, unit: str) -> None:
    """Choose the unit of distance, angle or time; derived units follow.

    Raises HriError for an unknown unit, ValueError for a derived quantity.
    """
    if quantity not in _default:
        raise ValueError(f"{quantity.name} follows from distance, angle and time - set those")
    factor(quantity, unit)
    _default[quantity] = unit


def get_default_units(quantity: Quantity) -> str:
    """The unit now in use, as it was spelled; "cm/sec" for a derived quantity."""
    base, power = quantity.value
    time = _default[UNIT_TIME]
    return _default[_BASES[base]] + ("", f"/{time}", f"/{time}^2")[power]


def convert_to_specified_units(quantity: Quantity, unit: str, value: float) -> float:
    """A value in default units, in the unit that is asked for. Raises HriError."""
    return in_si(quantity, value) / factor(quantity, unit)


def in_si(quantity: Quantity, value: float) -> float:
    """A value in default units, in meters, radians and seconds."""
    return value * factor(quantity, get_default_units(quantity))
