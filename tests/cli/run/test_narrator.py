"""What the terminal tells of what happens."""

import io

import pytest

from hri.behavior.tick_statistics import Statistics
from hri.cli.run.narrator import Narrator, missed_ticks
from hri.core.clock import FakeClock
from hri.core.origin import KEYBOARD, STUDIO, caused_by
from hri.robot import Robot


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
    ("ticks", "missed", "told"),
    [
        (11895, 105, "moving 105 of 12000 (0.9%) - nobody notices that"),
        (950, 50, "moving 50 of 1000 (5.0%) - it may stutter"),
        (50, 50, "moving 50 of 100 (50.0%) - this machine is too slow for it"),
    ],
)
def test_missed_ticks_come_with_a_verdict(ticks, missed, told):
    assert missed_ticks("moving", Statistics(ticks=ticks, missed=missed)).startswith(
        f"missed ticks: {told}"
    )


def test_the_slowest_behavior_of_a_missed_tick_is_named():
    statistics = Statistics(ticks=9, missed=1, slowest="gate")
    assert missed_ticks("moving", statistics).endswith("; the slowest was gate")


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
