"""What a motion is in words: "forward 2 meters", "a little to the left"."""

from __future__ import annotations

LITTLE_M, USUAL_M = 0.3, 0.5
"""Meters that are called a little, and that need not be said."""
LITTLE_DEG, QUARTER_DEG, HALF_DEG, WHOLE_DEG = 20.0, 90.0, 180.0, 360.0


def way_words(distance: float) -> str:
    """A straight way in meters, after "going"; below 0 it leads back."""
    side = "back" if distance < 0 else "forward"
    meters = abs(distance)
    if _is_near(meters, USUAL_M):
        return side
    if _is_near(meters, LITTLE_M):
        return f"{side} a little"
    if meters < 0.995:
        return f"{side} {_count(round(100 * meters), 'centimeter')}"
    return f"{side} {_count(meters, 'meter')}"


def turn_words(angle: float) -> str:
    """A turn in degrees, after "turning"; above 0 it is to the left."""
    side = "right" if angle < 0 else "left"
    degrees = abs(angle)
    if _is_near(degrees, QUARTER_DEG):
        return side
    if _is_near(degrees, LITTLE_DEG):
        return f"a little to the {side}"
    times = round(degrees / WHOLE_DEG)
    if times > 1 and _is_near(degrees, times * WHOLE_DEG):
        return f"{times} times to the {side}"
    return "around" if _is_near(degrees, HALF_DEG) else f"{side} {_count(degrees, 'degree')}"


def _is_near(value: float, other: float) -> bool:
    return abs(value - other) < 0.001 * other


def _count(value: float, unit: str) -> str:
    """A number that is said easily, with its unit."""
    rounded = round(value) if abs(value - round(value)) < 0.05 else round(value, 1)
    return f"{rounded} {unit}{'s' * (rounded != 1)}"
