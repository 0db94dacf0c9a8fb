"""Motions, hours and times in words."""

import pytest
from hypothesis import given, strategies as st

from hri.conversation.day import PARTS_OF_DAY, clock_words, part_of_day
from hri.conversation.motions import turn_words, way_words


@pytest.mark.parametrize(
    ("distance", "words"),
    [
        (0.5, "forward"),
        (-0.5, "back"),
        (0.3, "forward a little"),
        (1.0, "forward 1 meter"),
        (-2.5, "back 2.5 meters"),
        (0.2, "forward 20 centimeters"),
        (0.01, "forward 1 centimeter"),
        (3 * 0.3048, "forward 91 centimeters"),
        (0.999, "forward 1 meter"),
    ],
)
def test_a_way_in_words(distance, words):
    assert way_words(distance) == words


@pytest.mark.parametrize(
    ("angle", "words"),
    [
        (90, "left"),
        (-90, "right"),
        (20, "a little to the left"),
        (180, "around"),
        (-180, "around"),
        (-45, "right 45 degrees"),
        (1, "left 1 degree"),
        (360, "left 360 degrees"),
        (-1080, "3 times to the right"),
    ],
)
def test_a_turn_in_words(angle, words):
    assert turn_words(angle) == words


@given(st.integers(0, 23))
def test_each_hour_is_in_one_part_of_the_day(hour):
    begin, end = PARTS_OF_DAY[part_of_day(hour)]
    assert (hour - begin) % 24 < (end - begin) % 24


@pytest.mark.parametrize(
    ("hour", "minute", "words"),
    [
        (0, 0, "midnight"),
        (12, 0, "noon"),
        (0, 5, "12:05 AM"),
        (12, 30, "12:30 PM"),
        (15, 5, "3:05 PM"),
        (9, 0, "9:00 AM"),
    ],
)
def test_the_time_is_said_as_in_the_us(hour, minute, words):
    assert clock_words(hour, minute) == words
