"""Replies that lie in several files."""

import pytest

from hri.core.errors import AuthoringError, AuthoringErrors
from tests.apps.test_own_app import JOKE, live, named, put, robot_of  # noqa: F401

TWO = {
    **JOKE,
    "grammar.jsgf": JOKE["grammar.jsgf"] + "public <riddle> = ask me a riddle;\n",
    "replies.toml": 'also = ["riddles.toml"]\n' + JOKE["replies.toml"],
    "riddles.toml": '[reply.riddle]\nsay = "What has hands and no arms? A clock."\n',
}


def said(events):
    return [event.properties["text"] for event in named(events, "speech.said")]


def test_replies_of_a_named_file_count_as_those_of_the_file(put):  # noqa: F811
    robot = robot_of(put(TWO))
    events = live(robot, 9, {1.0: "tell me a twister", 5.0: "ask me a riddle"})
    assert said(events) == [
        "What is brown and sticky? A stick.",
        "What has hands and no arms? A clock.",
    ]


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (
            {"replies.toml": 'also = ["ridles.toml"]\n' + JOKE["replies.toml"]},
            r'replies.toml:1:1: there is no file "ridles.toml" in .* - did you mean "riddles.toml"',
        ),
        (
            {"replies.toml": 'also = ["../riddles.toml"]\n' + JOKE["replies.toml"]},
            r"replies.toml:1:1: .* is outside of the folder",
        ),
        (
            {"replies.toml": 'also = ["riddles.toml", "riddles.toml"]\n' + JOKE["replies.toml"]},
            r'replies.toml:1:1: "riddles.toml" is named twice',
        ),
        (
            {"riddles.toml": TWO["riddles.toml"] + 'shw = "happy"\n'},
            r'riddles.toml:3:1: unknown key "shw" - did you mean "show"',
        ),
        (
            {"riddles.toml": TWO["riddles.toml"].replace("riddle]", "ridle]")},
            r'riddles.toml:1:1: the grammar has no rule "ridle" - did you mean "riddle"',
        ),
        ({"riddles.toml": "[reply.riddle\n"}, r"riddles.toml:1:14: expected .\]. at the end"),
        (
            {"riddles.toml": 'name = "Ruby"\n' + TWO["riddles.toml"]},
            r'riddles.toml:1:1: unknown key "name" - known are: reply',
        ),
        (
            {"riddles.toml": TWO["riddles.toml"] + "[reply.twister]\n"},
            r"riddles.toml:3:1: <twister> has another reply in .*replies.toml - delete one",
        ),
    ],
)
def test_a_mistake_in_a_named_file_has_its_place(put, changed, message):  # noqa: F811
    with pytest.raises(AuthoringError, match=message) as error:
        robot_of(put({**TWO, **changed}))
    assert not isinstance(error.value, AuthoringErrors) or "ridle" in str(error.value)


def test_a_saved_named_file_is_taken_while_it_runs(put):  # noqa: F811
    robot = robot_of(put(TWO))
    other = '[reply.riddle]\nsay = "What gets wetter as it dries? A towel."\n'
    events = live(
        robot,
        14,
        {1.0: "ask me a riddle", 10.0: "ask me a riddle"},
        {5.0: lambda: put({"riddles.toml": other})},
    )
    assert len(named(events, "replies.changed")) == 1
    assert said(events)[-1] == "What gets wetter as it dries? A towel."


def test_a_file_that_is_named_while_it_runs_is_watched_too(put):  # noqa: F811
    robot = robot_of(put({**TWO, "replies.toml": TWO["riddles.toml"] + JOKE["replies.toml"]}))
    wrong, right = TWO["riddles.toml"].replace("]", "", 1), TWO["riddles.toml"]
    events = live(
        robot,
        14,
        then={
            2.0: lambda: put({"riddles.toml": wrong, "replies.toml": TWO["replies.toml"]}),
            8.0: lambda: put({"riddles.toml": right}),
        },
    )
    changes = [event.name for event in events if event.name.startswith("replies.")]
    assert changes == ["replies.refused", "replies.changed"]
