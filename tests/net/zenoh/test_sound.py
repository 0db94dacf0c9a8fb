"""A robot whose sound another program hears."""

import pytest

pytest.importorskip("zenoh", reason="the extra zenoh is not installed")

from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.resource import Description
from tests.net.zenoh.robots import until
from tests.speech.recognizers.speaking import spoken

GRAMMAR = "#JSGF V1.0;\ngrammar orders;\npublic <go> = go forward;\npublic <wait> = wait here;\n"
EARS = '<Behavior id="ears" type="Hri.Listener"><Parameter name="grammar" value="{}"/></Behavior>'
WANTS = '<Behavior id="print" type="Hri.InputCollector"/><Link from="board.far" to="print.input"/>'
HEARS = """
<Behavior id="feed" type="Hri.MicrophoneFeed"/>
<Link from="board.anna/anna.ears.sound" to="feed.sound"/>
<Behavior id="last" type="Hri.Latch"/>
<Link from="ears.utterance" to="last.input"/>
<Link from="last.latched" to="board.anna/far"/>
"""


@pytest.fixture
def ears(tmp_path):
    grammar = tmp_path / "orders.jsgf"
    grammar.write_text(GRAMMAR)
    return EARS.format(grammar)


def test_what_a_robot_hears_is_understood_elsewhere_and_comes_back(living, ears):
    anna = living("anna", ears + WANTS, [Description("microphone", "Hri.MemoryMicrophone")])
    berta = living("berta", ears + HEARS, [Description("microphone", "Hri.FedMicrophone")])
    sound, far = berta.board.slot("anna/anna.ears.sound"), anna.board.slot("far")
    assert until(lambda: sound.value is not None)
    anna.robot.resources.obtain("microphone", MemoryMicrophone).hear(spoken("go forward"))
    assert until(lambda: far.value is not None)
    assert far.value.text == "go forward"


def test_a_robot_that_is_deaf_sends_no_sound(living, ears):
    anna = living("anna", ears, [Description("microphone", "Hri.MemoryMicrophone")])
    sound = living("berta").board.slot("anna/anna.ears.sound")
    assert until(lambda: sound.value is not None)
    listener = anna.robot.networks.runners["anna"].network["ears"]
    listener.is_muted = True
    assert until(lambda: sound.value is None)
    listener.is_muted = False
    assert until(lambda: sound.value is not None)
