"""What the terminal tells of what happens."""

import io
from collections import Counter

import pytest

from hri.cli.run.narrator import Narrator, late
from hri.core.clock import FakeClock
from hri.core.origin import KEYBOARD, STUDIO, caused_by
from hri.robot import Robot
from hri.testing import live_for


@pytest.fixture
def told():
    """Raises events and gives the lines that tell of them."""
    robot = Robot(clock=FakeClock(), notice=lambda line: None)
    out = io.StringIO()
    Narrator(robot, out)

    def told(name, **properties):
        robot.events.raise_event(name, **properties)
        return [" ".join(line.split()) for line in out.getvalue().splitlines()][-1]

    return told


def test_what_is_ignored_is_told_with_why_it_does_not_count(told):
    untimely = {"reason": "not now", "detail": "<no> counts only while a question is open"}
    assert "ignored no (not now: <no> counts only while a question is open)" in told(
        "speech.rejected", text="no", **untimely
    )
    assert "ignored hm (no speech)" in told(
        "speech.rejected", text="hm", reason="no speech", detail=""
    )


@pytest.mark.parametrize(
    ("ticks", "causes", "told"),
    [
        (11895, {"gate": 105}, ""),
        (970, {"": 30}, ""),
        (0, {}, ""),
        (
            950,
            {"gate": 40, "": 10},
            "moving ran late: 50 of 1000 ticks missed, 40 of them because of gate - make gate"
            " faster, or raise the invocation_interval of moving",
        ),
        (
            50,
            {"": 30, "gate": 20},
            "moving ran late: 50 of 100 ticks missed, most because this machine is busy"
            " - end other programs",
        ),
    ],
)
def test_missed_ticks_are_told_when_they_matter_with_what_was_late(ticks, causes, told):
    assert late("moving", ticks, Counter(causes)) == told


def test_ticks_missed_while_it_starts_are_not_counted():
    robot = Robot(clock=FakeClock(), notice=lambda line: None)
    out = io.StringIO()
    narrator = Narrator(robot, out)
    narrator._renderer = None

    async def job(context):
        (*_, runner) = robot.runners
        runner.statistics.causes["loading"] += 1000
        await narrator.greet(context)
        runner.statistics.causes["gate"] += 1000
        robot.finish()

    live_for(robot, 0.5, job)
    narrator.summary()
    assert "because of gate" in out.getvalue()
    assert "loading" not in out.getvalue()
    assert "1000 of" in out.getvalue()


def test_of_several_mistakes_the_first_is_printed(told):
    error = "replies.toml:1:1: one\nreplies.toml:2:1: two\nreplies.toml:3:1: three"
    assert told("replies.refused", error=error, file="replies.toml").endswith(
        "refused replies.toml:1:1: one (and 2 more)"
    )


def test_who_has_it_say_something_is_told_unless_they_type_there(told):
    with caused_by(STUDIO):
        assert told("speech.said", text="Wait.").endswith("said Wait. (studio)")
    with caused_by(KEYBOARD):
        assert told("speech.heard", text="hello").endswith("heard hello")
    assert told("speech.said", text="Hello.").endswith("said Hello.")


def test_a_grammar_is_reloaded_when_it_was_saved_and_not_when_a_question_has_its_own(told):
    assert told("speech.said", text="Which size?").endswith("said Which size?")
    assert told("grammar.changed", file="size.jsgf", reloaded=False).endswith("Which size?")
    assert told("grammar.changed", file="all.jsgf", reloaded=True).endswith("reloaded the grammar")
