"""Topics of the grammar that an app does not hear."""

import pytest

from hri.core.errors import AuthoringError
from tests.apps.test_own_app import JOKE, live, named, put, robot_of  # noqa: F401

GRAMMAR = """#JSGF V1.0; /** @extends companion */ grammar joke;
/** @topic fun */
public <twister> = tell me a twister;
/** @topic teasing rude */
public <tease> = you are a toaster;
"""
TEASED = {
    "app.toml": 'extends = "companion"\nsilent_topics = ["teasing"]\n',
    "grammar.jsgf": GRAMMAR,
    "replies.toml": JOKE["replies.toml"],
}
LINES = {1.0: "you are a toaster", 6.0: "tell me a twister"}


def test_a_silent_topic_is_not_heard_and_needs_no_reply(put):  # noqa: F811
    events = live(robot_of(put(TEASED)), 9, LINES)
    assert [event.properties["rule"] for event in named(events, "speech.heard")] == ["twister"]


@pytest.mark.slow
def test_replies_to_a_silent_topic_may_stay(put):  # noqa: F811
    replies = TEASED["replies.toml"] + '[reply.tease]\nsay = "Beep."\n'
    heard = {**TEASED, "replies.toml": replies, "app.toml": 'extends = "companion"\n'}
    for files, rules in (({**TEASED, "replies.toml": replies}, ["twister"]), (heard, None)):
        events = live(robot_of(put(files)), 9, LINES)
        found = [event.properties["rule"] for event in named(events, "speech.heard")]
        assert found == (rules or ["tease", "twister"])


def test_an_unknown_topic_is_refused(put):  # noqa: F811
    app = TEASED["app.toml"].replace("teasing", "teesing")
    message = (
        r'app.toml:2:1: no rule of the grammar has the topic "teesing" - did you mean "teasing"'
    )
    with pytest.raises(AuthoringError, match=message):
        robot_of(put({**TEASED, "app.toml": app}))


def test_a_saved_grammar_stays_without_the_topic(put):  # noqa: F811
    more = GRAMMAR.replace("a toaster", "a (toaster | kettle)")
    lines = {8.0: "you are a kettle", 10.0: "tell me a twister"}
    robot = robot_of(put(TEASED))
    events = live(robot, 14, lines, {2.0: lambda: put({"grammar.jsgf": more})})
    assert [event.properties["rule"] for event in named(events, "speech.heard")] == ["twister"]
