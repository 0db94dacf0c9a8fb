"""What people write is read as they would read it."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.pronunciation.notation import goes_on, read_aloud


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("Write to a.b@example.com.", "Write to a dot b at example dot com."),
        ("See https://www.x.org/a-b?", "See w w w dot x dot org slash a dash b?"),
        ("Go to example.org!", "Go to example dot org!"),
        ("Open config.xml now.", "Open config dot xml now."),
        ("Call +1 (555) 123-4567.", "Call plus 1, 5 5 5, 1 2 3, 4 5 6 7."),
        ("Call 555-0123.", "Call 5 5 5, 0 1 2 3."),
        ("On 24.11.2026 we met.", "On November 24, 2026 we met."),
        ("99.99.2026", "99.99.2026"),
        ("It is 5' 11\".", "It is 5 feet 11 inches."),
        ("At 3.5 m/s for 10 m.", "At 3.5 meters per second for 10 meters."),
        ("A battery of 12 V.", "A battery of 12 volts."),
        ("2 1/2 cups, 3¾ more", "2 and a half cups, 3 and three quarters more"),
        ("open 24/7", "open 24 7"),
        ("and/or AC/DC", "and or AC DC"),
        ("#5 and #fun", "number 5 and hashtag fun"),
        ("~5 of 007", "about 5 of 0 0 7"),
        ("12:05 and 0.05 and 2026-01-02", "12:05 and 0.05 and 2026-01-02"),
        ("a < b, e.g. this... 7 a.m. U.S.", "a < b, e.g. this... 7 a.m. U.S."),
    ],
)  # fmt: skip
def test_notation_is_read_as_people_read_it(written, read):
    assert read_aloud(written) == read


def test_an_abbreviation_goes_on_before_a_number_only():
    assert goes_on("On Nov.", "24 we met.")
    assert not goes_on("On Nov.", "We met.")
    assert not goes_on("It is done.", "24 came.")


@given(st.text(max_size=400))
def test_any_text_is_read(text):
    assert len(read_aloud(text)) <= 20 * len(text) + 20


@pytest.mark.parametrize("piece", ["a.", "1/", "a@", "www.", "-", "+1 ", "0", "(555) ", "#"])
def test_long_texts_of_one_kind_take_no_time(piece):
    assert read_aloud(piece * 20_000)
