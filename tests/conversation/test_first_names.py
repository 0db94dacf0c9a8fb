"""Who is named by a sentence."""

import pytest

from hri.conversation.first_names import first_names, introduced, introduces_self


@pytest.mark.parametrize(
    ("text", "person"),
    [
        ("I'm Katherine.", "Katherine"),
        ("well hi i'm deborah i'm the sister", "Deborah"),
        ("this is tommy he's our grandson", "Tommy"),
        ("my name is Leo", "Leo"),
        ("Robert", "Robert"),
        ("i'm tired", ""),
        ("this is so stupid", ""),
        ("tommy is here", ""),
        ("i'm", ""),
        ("", ""),
    ],
)
def test_who_is_introduced_has_a_common_name(text, person):
    assert introduced(text) == person


@pytest.mark.parametrize(
    ("text", "is_own"),
    [
        ("hi i'm deborah", True),
        ("my name's Leo", True),
        ("this is tommy", False),
        ("i'm tired", False),
    ],
)
def test_who_says_their_own_name_introduces_nobody_else(text, is_own):
    assert introduces_self(text) is is_own


def test_the_name_of_the_robot_introduces_no_one():
    assert introduced("leo", "Leo") == introduced("i'm leo", "Leo") == ""


def test_names_are_single_words_in_small_letters():
    assert len(first_names()) > 400
    assert all(name.isalpha() and name.islower() for name in first_names())
