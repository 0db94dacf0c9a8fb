"""What the terminal tells of what happens."""

import io

import pytest

from hri.cli.narrator import Narrator
from hri.core.clock import FakeClock
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
