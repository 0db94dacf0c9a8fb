"""Motions and sentences that someone outside of the network asks for are not the robot's own."""

import pytest

from hri.behavior.drive_command import DriveCommand
from hri.behavior.ports import OutputPort
from hri.core.origin import OUTSIDE
from hri.core.signals import Twist
from hri.drive.behaviors import CommandGate
from hri.hal.motion import REST
from hri.speech.behaviors import SpeakOn
from hri.testing import context, run_for
from tests.drive.course import DEVICES
from tests.speech.fakes import Stage


def said(port, spoken):
    """A source of a value that someone outside said, or nobody did."""
    source = OutputPort(datatype="any")
    port.sources.append(source)

    def say(value, now):
        source.send(value, now if spoken else None)

    return say


@pytest.mark.parametrize(("spoken", "origin"), [(True, OUTSIDE), (False, "")])
def test_a_motion_has_the_origin_of_its_command_and_a_stop_is_the_gates_own(spoken, origin):
    gate, lent = CommandGate("gate"), context(*DEVICES)
    drive = DriveCommand("drive")
    drive.velocity.sources.append(gate.velocity)
    say = said(gate.twist, spoken)

    compute = gate.compute

    def steered(now, dt):
        say(Twist(0.2) if now < 1.0 else REST, now)
        compute(now, dt)

    gate.compute = steered
    events = run_for(3.0, [gate, drive], lent, 0.05)
    assert [(event.name, event.origin) for event in events] == [
        ("drive.commanded", origin),
        ("drive.stopped", ""),
    ]


@pytest.mark.parametrize(("spoken", "origin"), [(True, OUTSIDE), (False, "")])
def test_a_sentence_has_the_origin_of_what_sets_it_off(spoken, origin):
    behavior = SpeakOn()
    stage = Stage(behavior)
    heard = []
    behavior._events.subscribe("speech.*", lambda event: heard.append((event.name, event.origin)))
    said(behavior.trigger, spoken)(True, 0.0)
    stage.run(2.0)
    assert heard == [("speech.said", origin), ("speech.finished", origin)]
