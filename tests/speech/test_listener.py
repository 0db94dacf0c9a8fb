from __future__ import annotations

import pytest

from hri.behavior.ports import OutputPort
from hri.core.errors import AuthoringError, HriError
from hri.speech.behaviors import Listener

from .fakes import TICK, HighMicrophone, Stage


def speaking(listener: Listener) -> OutputPort[bool]:
    """Something that says whether the robot speaks, linked to the listener."""
    port: OutputPort[bool] = OutputPort()
    listener.is_speaking.sources.append(port)
    return port


def test_a_command_is_heard_with_its_meaning():
    stage = Stage(Listener())
    stage.ears.script[1.0] = ("go forward ten meters", 0.72149)

    stage.run(1.0)
    assert stage.events == []
    stage.run(0.2)

    ((time, name, properties),) = stage.events
    assert 1.15 <= time <= 1.2 + TICK
    assert name == "speech.heard"
    assert properties == {
        "text": "go forward ten meters",
        "rule": "move",
        "tags": {"distance": 10.0},
        "confidence": 0.721,
    }


@pytest.mark.parametrize(
    ("text", "confidence", "reason"),
    [
        ("go forward", 0.49, "low confidence"),
        ("go forward fish", 0.9, "not in grammar"),
        ("", 0.0, "no speech"),
    ],
)
def test_what_does_not_count_is_rejected_with_its_reason(text, confidence, reason):
    stage = Stage(Listener())
    stage.ears.script[1.0] = (text, confidence)

    stage.run(1.5)

    ((_, name, properties),) = stage.events
    assert name == "speech.rejected"
    assert properties == {"reason": reason, "text": text, "confidence": confidence}


def test_strictness_moves_the_line():
    stage = Stage(Listener(strictness=0.8))
    stage.ears.script[1.0] = ("go forward", 0.7)

    stage.run(1.5)

    assert stage.names() == ["speech.rejected"]


def test_while_the_robot_speaks_only_stop_counts():
    listener = Listener()
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.script |= {1.0: ("go forward", 0.9), 2.0: ("stop", 0.9), 4.0: ("go back", 0.9)}

    port.value = True
    stage.run(2.5)
    port.value = False
    stage.run(2.0)

    assert stage.names() == ["speech.rejected", "speech.heard", "speech.heard"]
    assert stage.events[0][2]["reason"] == "robot speaking"
    assert stage.events[1][2]["rule"] == "stop"


def test_speech_that_began_while_the_robot_spoke_counts_as_such():
    listener = Listener()
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.script[2.0] = ("go forward", 0.9)

    stage.run(1.6)
    port.value = True
    stage.run(0.1)
    port.value = False
    stage.run(1.0)

    assert stage.events[0][2]["reason"] == "robot speaking"


def test_the_utterance_is_sent_once():
    stage = Stage(Listener())
    stage.ears.script[1.0] = ("hello robot", 0.9)
    sent = []
    for _ in range(40):
        stage.run(TICK)
        if (utterance := stage.behavior.utterance.value) is not None:
            sent.append(utterance)

    (utterance,) = sent
    assert (utterance.rule, utterance.start, utterance.end) == ("greet", 0.5, 1.0)


def test_it_is_idle_when_all_is_understood():
    stage = Stage(Listener())
    stage.ears.script |= {1.0: ("hello robot", 0.9), 1.01: ("go forward", 0.9)}

    stage.run(0.3)
    assert stage.behavior.is_idle
    stage.run(0.4)
    assert stage.behavior.is_hearing.value
    assert not stage.behavior.is_idle
    stage.run(0.4)
    assert not stage.behavior.is_idle
    stage.run(0.4)
    assert stage.behavior.is_idle
    assert stage.names() == ["speech.heard", "speech.heard"]


def test_a_wrong_grammar_is_refused_before_anything_starts(write):
    with pytest.raises(AuthoringError, match="no rule <colr>"):
        Stage(Listener(grammar=str(write("public <a> = <colr>;\n<color> = red;"))))
    with pytest.raises(HriError, match=r'no "companio" in grammars - did you mean "companion"'):
        Stage(Listener(grammar="companio"))


def test_a_microphone_of_another_rate_is_heard_at_the_recognizers():
    stage = Stage(Listener(), HighMicrophone)
    stage.run(2.0)
    assert stage.ears.count == pytest.approx(2.0 * stage.ears.rate, rel=0.02)
