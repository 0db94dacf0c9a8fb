"""Twenty minutes with two people, and the next day: what counts as a mistake."""

from __future__ import annotations

from benchmarks.conversation.transcript import Line, Words
from benchmarks.conversation.two_days import ALL, days, mistakes

ANNA = ("my name is anna", "Hello, Anna! I haven't seen you for a day. How is your sister Eva?")
BEN = ("my name is ben", "Hello, Ben! I haven't seen you for a day. How is Rex, your dog?")
OF_ANNA = (ALL, "You're Anna. You like jazz. Your sister is called Eva. Your birthday is on May 3.")


def found(*turns):
    """The mistakes of a second day."""
    lines = [
        Line(
            f"two days/{number}",
            "",
            "the next day",
            0.0,
            say,
            "",
            "",
            said=(Words(0.0, told, told),),
        )
        for number, (say, told) in enumerate(turns)
    ]
    return [*mistakes(lines)]


def test_who_is_greeted_by_name_with_a_fact_is_known():
    assert found(ANNA, OF_ANNA, BEN) == []


def test_each_mistake_is_found():
    assert found(ANNA) == ["only ['Anna'] were greeted"]
    assert found(ANNA, (ALL, "You like jazz."), BEN) == [
        'of Anna it did not know "Eva"',
        'of Anna it did not know "May 3"',
    ]
    assert found(ANNA, BEN, ("hi", "How was your jazz?")) == ['Ben heard of "jazz"']
    without = found(ANNA, ("my name is ben", "Hello, Ben! I haven't seen you for a day."))
    assert without[0].startswith("Ben was greeted without their name or a fact")


def test_both_days_are_as_long_as_they_say():
    first, second = days()
    assert len(first.turns) > 150
    assert {turn.say for turn in second.turns} >= {"my name is anna", "my name is ben", ALL}
