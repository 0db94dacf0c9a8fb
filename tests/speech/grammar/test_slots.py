"""The grammars of values that the house ships, over their whole ranges."""

from __future__ import annotations

from datetime import date, timedelta
from functools import cache
from pathlib import Path

import pytest
from hypothesis import example, given, settings, strategies as st

from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.dates import WEEKDAYS, resolve
from hri.speech.grammar.matching import parse
from hri.speech.grammar.numerals import in_words

GRAMMARS = Path(__file__).resolve().parents[3] / "grammars"
LIBRARY = ("numbers", "distance", "angle", "duration", "time", "date", "color", "direction")

ONES = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
]
TENS = ["-", "-", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]
ORDINALS = {"one": "first", "two": "second", "three": "third", "five": "fifth", "eight": "eighth"}
ORDINALS |= {"nine": "ninth", "twelve": "twelfth"}
MONTHS = [
    "january",
    "february",
    "march",
    "april",
    "may",
    "june",
    "july",
    "august",
    "september",
    "october",
    "november",
    "december",
]


@cache
def library(name: str) -> Grammar:
    return load_grammar(GRAMMARS / f"{name}.jsgf")


def meaning(name: str, rule: str, text: str):
    found = parse(library(name), text, {rule})
    return None if found is None else found.tags


def spell(number: int, link: str = "and ") -> str:
    """A number in words: an independent little speller."""
    if number < 20:
        return ONES[number]
    if number < 100:
        return TENS[number // 10] + (f" {ONES[number % 10]}" if number % 10 else "")
    unit, word = (100, "hundred") if number < 1000 else (1000, "thousand")
    rest = number % unit
    head = f"{spell(number // unit, link)} {word}"
    return f"{head} {link if rest < 100 else ''}{spell(rest, link)}" if rest else head


def spell_ordinal(number: int) -> str:
    head, _, last = spell(number).rpartition(" ")
    last = f"{last[:-1]}ieth" if last.endswith("y") else ORDINALS.get(last, f"{last}th")
    return f"{head} {last}".strip()


@pytest.mark.parametrize("name", [*LIBRARY, "companion"])
def test_every_example_of_a_shipped_grammar_is_understood(name):
    grammar = library(name)
    examples = [(key, text) for key in grammar.public_rules for text in grammar.rules[key].examples]

    assert examples
    assert [text for key, text in examples if parse(grammar, text, {key}) is None] == []


@given(st.integers(0, 999_999), st.sampled_from(["and ", ""]))
@example(100_000, "").via("a round one")
@example(999_999, "and ")
@settings(max_examples=150, deadline=None)
def test_a_whole_number_means_itself(number, link):
    said = spell(number, link)

    assert meaning("numbers", "whole", said) == {"number": number}
    assert meaning("numbers", "number", f"minus {said}") == {"number": -number}
    if 1 <= number <= 999:
        assert meaning("numbers", "small", said) == {"number": number}
        assert meaning("numbers", "small", f"{said} and a half") == {"number": number + 0.5}


@given(st.integers(0, 999), st.text("0123456789", min_size=1, max_size=3))
@settings(max_examples=100, deadline=None)
def test_decimals_are_read_digit_by_digit(whole, decimals):
    said = f"{spell(whole)} point {' '.join(ONES[int(digit)] for digit in decimals)}"

    assert meaning("numbers", "number", said)["number"] == float(f"{whole}.{decimals}")


@pytest.mark.parametrize("number", range(1, 100))
def test_an_ordinal_means_its_number(number):
    assert meaning("numbers", "ordinal", spell_ordinal(number)) == {"ordinal": number}
    assert meaning("numbers", "ordinal", spell(number)) is None


@given(st.text("0123456789", min_size=1, max_size=20))
@settings(max_examples=50, deadline=None)
def test_digits_keep_their_zeros(text):
    said = " ".join("oh" if digit == "0" else ONES[int(digit)] for digit in text)

    assert meaning("numbers", "digits", said) == {"digits": text}


UNITS = {
    "meters": 1, "centimeters": 0.01, "millimeters": 0.001, "kilometers": 1000,
    "feet": 0.3048, "inches": 0.0254, "yards": 0.9144, "miles": 1609.344,
}  # fmt: skip


@given(st.integers(1, 999), st.sampled_from(sorted(UNITS)), st.booleans())
@settings(max_examples=100, deadline=None)
def test_lengths_are_meters(number, unit, half):
    said = f"{spell(number)}{' and a half' if half else ''} {unit}"

    expected = (number + 0.5 * half) * UNITS[unit]
    assert meaning("distance", "distance", said) == {"distance": pytest.approx(expected)}


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("distance", "half a meter", 0.5),
        ("distance", "a meter and a half", 1.5),
        ("distance", "two meters and a half", 2.5),
        ("distance", "a kilometer and a quarter", 1250),
        ("distance", "half an inch", 0.0127),
        ("distance", "a half meter", 0.5),
        ("distance", "five feet six inches", 1.6764),
        ("distance", "two meters fifty centimeters", 2.5),
        ("distance", "three quarters of a mile", 1207.008),
        ("distance", "a quarter of an inch", 0.00635),
        ("distance", "meters", None),
        ("angle", "forty five degrees", 45),
        ("angle", "twenty two and a half degrees", 22.5),
        ("angle", "a quarter turn", 90),
        ("angle", "half a turn", 180),
        ("angle", "a full turn", 360),
        ("angle", "a full circle", 360),
        ("angle", "one and a half turns", 540),
        ("angle", "one degree", 1),
        ("duration", "half an hour", 1800),
        ("duration", "an hour and a half", 5400),
        ("duration", "one and a half hours", 5400),
        ("duration", "an hour and ten minutes", 4200),
        ("duration", "a day two hours and thirty seconds", 93630),
        ("duration", "three quarters of an hour", 2700),
        ("duration", "two weeks", 1209600),
        ("duration", "two hours and a half", 9000),
        ("duration", "a half hour", 1800),
        ("duration", "one minute", 60),
        ("duration", "ten minute", 600),
        ("duration", "an hours", None),
        ("duration", "a minutes", None),
        ("duration", "ten minutes an hour", None),
        ("color", "light blue", "light blue"),
        ("color", "grey", "gray"),
        ("color", "light black", None),
        ("direction", "to the left", "left"),
        ("direction", "straight ahead", "forward"),
        ("time", "noon", "12:00"),
        ("time", "midnight", "00:00"),
        ("time", "quarter to one", "12:45"),
        ("time", "five to midnight", None),
        ("time", "half past seven in the evening", "19:30"),
        ("time", "ten at night", "22:00"),
        ("time", "half past twelve at night", "00:30"),
        ("time", "quarter to twelve at night", "23:45"),
        ("time", "two at night", "02:00"),
        ("time", "ten to one at night", "00:50"),
        ("time", "five at night", None),
        ("time", "thirteen fifteen", "13:15"),
        ("time", "ten", None),
    ],
)
def test_values_are_said_in_many_ways(name, text, value):
    found = meaning(name, name, text)

    assert found == (None if value is None else {name: value})


@given(st.integers(0, 999_999))
def test_numbers_are_told_in_the_words_that_mean_them(number):
    assert meaning("numbers", "whole", in_words(str(number))) == {"number": number}


@pytest.mark.parametrize(
    ("text", "value"),
    [("a thousand", 1000), ("a thousand and five", 1005), ("one thousand two hundred", 1200)],
)
def test_a_thousand_needs_no_one(text, value):
    assert meaning("numbers", "whole", text) == {"number": value}


@given(st.integers(0, 99), st.integers(0, 59), st.integers(1, 59))
@settings(max_examples=60, deadline=None)
def test_durations_add_up(hours, minutes, seconds):
    parts = [(hours, "hours"), (minutes, "minutes"), (seconds, "seconds")]
    said = " and ".join(f"{spell(count)} {unit}" for count, unit in parts if count)

    total = 3600 * hours + 60 * minutes + seconds
    assert meaning("duration", "duration", said) == {"duration": total}


@pytest.mark.parametrize("hour", range(24))
def test_every_minute_of_the_day_can_be_said(hour):
    half, clock = ("pm" if hour >= 12 else "a m"), spell(hour % 12 or 12)
    after = spell((hour + 1) % 12 or 12)
    half_after = "pm" if (hour + 1) % 24 >= 12 else "a m"
    for minute in range(60):
        digits = f"oh {spell(minute)}" if minute < 10 else spell(minute)
        said = [f"{clock} {digits if minute else ''} {half}"]
        if 0 < minute < 30:
            said.append(f"{spell(minute)} minutes past {clock} {half}")
        if minute > 30:
            said.append(f"{spell(60 - minute)} to {after} {half_after}")
        for text in said:
            assert meaning("time", "time", text) == {"time": f"{hour:02}:{minute:02}"}, text


@given(st.dates(date(1910, 1, 1), date(2099, 12, 31)), st.booleans())
@settings(max_examples=150, deadline=None)
def test_a_day_of_the_calendar_means_itself(day, month_first):
    month, number = MONTHS[day.month - 1], spell_ordinal(day.day)
    said = f"{month} {number}" if month_first else f"the {number} of {month}"
    century, rest = divmod(day.year, 100)
    if rest == 0:
        year = "two thousand" if century == 20 else "nineteen oh one"
        day = day if century == 20 else day.replace(year=1901)
    elif rest < 10 and century == 20:
        year = f"two thousand and {spell(rest)}"
    else:
        year = f"{spell(century)} {'oh ' if rest < 10 else ''}{spell(rest)}"

    assert meaning("date", "date", said) == {"date": f"--{day:%m-%d}"}
    assert meaning("date", "date", f"{said} {year}") == {"date": day.isoformat()}
    assert resolve(f"--{day:%m-%d}", day) == resolve(day.isoformat(), day) == day


@given(st.dates(date(1950, 1, 1), date(2090, 1, 1)), st.sampled_from(WEEKDAYS))
@settings(max_examples=100, deadline=None)
def test_days_of_the_week_follow_today(today, weekday):
    coming, following = resolve(weekday, today), resolve(f"next {weekday}", today)
    last = resolve(f"last {weekday}", today)

    assert {WEEKDAYS[day.weekday()] for day in (coming, following, last)} == {weekday}
    assert 1 <= (coming - today).days <= 7
    assert following.isocalendar()[:2] == (today + timedelta(7)).isocalendar()[:2]
    assert last.isocalendar()[:2] == (today - timedelta(7)).isocalendar()[:2]


@pytest.mark.parametrize(
    ("text", "day"),
    [
        ("today", "2026-02-27"),
        ("tomorrow", "2026-02-28"),
        ("the day after tomorrow", "2026-03-01"),
        ("yesterday", "2026-02-26"),
        ("in three days", "2026-03-02"),
        ("in a week", "2026-03-06"),
        ("two weeks ago", "2026-02-13"),
        ("friday", "2026-03-06"),
        ("this saturday", "2026-02-28"),
        ("next friday", "2026-03-06"),
        ("next saturday", "2026-03-07"),
        ("last monday", "2026-02-16"),
        ("the first", "2026-03-01"),
        ("the thirty first", "2026-03-31"),
        ("february twenty ninth", "2028-02-29"),
        ("the third of may", "2026-05-03"),
        ("january second", "2027-01-02"),
    ],
)
def test_a_spoken_day_is_found_from_today(text, day):
    spoken = meaning("date", "date", text)["date"]

    assert resolve(spoken, date(2026, 2, 27)) == date.fromisoformat(day)


@pytest.mark.parametrize("text", ["", "soon", "---32", "--02-30", "--13-01", "+999999", "next"])
def test_what_is_no_date_is_refused(text):
    with pytest.raises(ValueError, match=r"\w"):
        resolve(text, date(9000, 1, 1))


def test_a_value_may_get_another_name(write):
    grammar = load_grammar(
        write(
            "import <distance.distance>;\nimport <color.*>;\n"
            "public <go> = go <distance> {far=$distance} to the <color> door;"
        )
    )

    found = parse(grammar, "go two and a half meters to the dark green door")
    assert found.tags == {"far": 2.5, "color": "dark green"}


def test_two_numbers_do_not_run_into_each_other(write):
    rules = "import <numbers.whole>;\npublic <a> = from <whole> {from=$number} to <whole>;"

    found = parse(load_grammar(write(rules)), "from twenty one to forty")
    assert found.tags == {"from": 21.0, "number": 40.0}
