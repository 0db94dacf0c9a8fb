"""A sentence turned around."""

import pytest
from hypothesis import given, strategies as st

from hri.conversation.reflection import deed_of, echo_of


@pytest.mark.parametrize(
    ("text", "echo"),
    [
        ("My dog ate my shoe.", "your dog ate your shoe"),
        ("i was late for my bus", "you were late for your bus"),
        ("well, we're going to our lake, Robin", "you're going to your lake"),
        ("tyler said i can come", "tyler said you can come"),
        ("i had a dog named robin once", ""),
        ("i like you", ""),
        ("i don't want to", ""),
        ("that was nice of them", ""),
        ("i ran", ""),
        ("", ""),
    ],
)
def test_what_is_told_is_said_again_from_the_other_side(text, echo):
    assert echo_of(text, "Robin") == echo


@pytest.mark.parametrize(
    ("text", "deed"),
    [
        ("Could you close your eyes, please?", "close my eyes"),
        ("bring me my coat because i am cold", "bring you your coat"),
        ("i want you to iron a shirt", "iron a shirt"),
        ("do what you like", ""),
        ("be nice", ""),
        ("can i have a cookie", ""),
        ("my coat is wet", ""),
        ("", ""),
    ],
)
def test_what_is_asked_for_is_named_from_the_other_side(text, deed):
    assert deed_of(text, "Robin") == deed


@given(st.text(max_size=60))
def test_any_text_is_turned_or_left(text):
    assert isinstance(echo_of(text) + deed_of(text), str)


@pytest.mark.parametrize(
    "text", ["he's laughing do it again", "i hear a car they're here bye", "i think i'll doze"]
)
def test_two_things_in_one_line_are_not_said_again(text):
    assert echo_of(text) == ""
