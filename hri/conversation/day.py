"""The parts of a day, as people name them."""

from __future__ import annotations

from collections.abc import Mapping

PARTS_OF_DAY: Mapping[str, tuple[int, int]] = {
    "morning": (6, 12),
    "afternoon": (12, 18),
    "evening": (18, 22),
    "night": (22, 6),
}
"""The hours at which each begins and ends."""


def part_of_day(hour: int) -> str:
    """The part of the day of an hour, 0 to 23."""
    within = (part for part, (begin, end) in PARTS_OF_DAY.items() if begin <= hour < end)
    return next(within, "night")


def clock_words(hour: int, minute: int) -> str:
    """The time as it is said in the US: "3:05 PM", "noon", "midnight"."""
    if minute == 0 and hour % 12 == 0:
        return "midnight" if hour == 0 else "noon"
    return f"{(hour - 1) % 12 + 1}:{minute:02d} {'AM' if hour < 12 else 'PM'}"
