"""Units by their names: factors to meters, radians and seconds.

The constants make SI code readable: `move(context, 50 * cm)`.
"""

from __future__ import annotations

import math
from enum import Enum

from hri.core.errors import HriError, did_you_mean

cm = 0.01
inch = 0.0254
foot = 0.3048
degree = math.pi / 180
minute = 60.0
millisecond = 0.001


class Quantity(Enum):
    """What is measured: a base quantity, by which power of time it is divided."""

    DISTANCE = ("distance", 0)
    ANGLE = ("angle", 0)
    TIME = ("time", 0)
    VELOCITY = ("distance", 1)
    ACCELERATION = ("distance", 2)
    ANGULAR_VELOCITY = ("angle", 1)
    ANGULAR_ACCELERATION = ("angle", 2)


_SPELLINGS: dict[str, dict[float, tuple[str, ...]]] = {
    "distance": {
        0.001: ("mm", "millimeter", "millimeters"),
        cm: ("cm", "centimeter", "centimeters"),
        1.0: ("m", "meter", "meters"),
        inch: ("in", "inch", "inches"),
        foot: ("ft", "foot", "feet"),
    },
    "angle": {
        1.0: ("rad", "radian", "radians"),
        degree: ("deg", "degree", "degrees"),
    },
    "time": {
        millisecond: ("ms", "msec", "millisecond", "milliseconds"),
        1.0: ("s", "sec", "second", "seconds"),
        minute: ("min", "minute", "minutes"),
    },
}

FACTORS = {
    base: {name: factor for factor, names in spellings.items() for name in names}
    for base, spellings in _SPELLINGS.items()
}
"""By base quantity and spelling: how many SI units one of it is."""


def factor(quantity: Quantity, unit: str) -> float:
    """How many SI units one `unit` is: 0.0254 for "inches", 0.01 for "cm/s".

    A derived unit reads `distance/time` or `distance/time^2`. Raises HriError for an unknown one.
    """
    base, power = quantity.value
    numerator, slash, denominator = unit.partition("/")
    if power == 0 and not slash:
        return _base_factor(base, unit)
    time, _, exponent = denominator.partition("^")
    if not slash or exponent != ("" if power == 1 else str(power)) or power == 0:
        raise HriError(f'"{unit}" is not a unit of {_words(quantity)} - try {_si(quantity)}')
    divisor = _base_factor("time", time)
    return _base_factor(base, numerator) / math.pow(divisor, power)


def _base_factor(base: str, unit: str) -> float:
    known = FACTORS[base]
    if unit not in known:
        raise HriError(f'unknown unit of {base} "{unit}" - {did_you_mean(unit, known)}')
    return known[unit]


def _words(quantity: Quantity) -> str:
    return quantity.name.lower().replace("_", " ")


def _si(quantity: Quantity) -> str:
    base, power = quantity.value
    unit = {"distance": "m", "angle": "rad", "time": "s"}[base]
    return unit + ("", "/s", "/s^2")[power]
