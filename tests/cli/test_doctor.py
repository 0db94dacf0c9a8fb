"""`hri doctor` with a pretended sound card."""

import sys

import pytest

from hri.cli.main import main
from hri.hal.choices import load_choices
from hri.hal.drivers import sound_card
from tests.hal.sound_cards import BUSY, Card, PortAudio


@pytest.fixture
def answering(monkeypatch, tmp_path):
    """Plugs in sound cards, and answers the questions of the doctor."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)

    def answer(cards, *words):
        answers = iter(words)
        monkeypatch.setattr(sound_card, "load_sounddevice", lambda: PortAudio(*cards))
        monkeypatch.setattr("builtins.input", lambda question: next(answers))
        return main(["doctor", "--choose"])

    return answer


def test_devices_are_chosen_by_the_rate_they_have_and_tried(answering, capsys):
    mic = Card(name="Desk Mic", rates=(44100, 48000), inputs=(1,), outputs=())
    box = Card(name="Box", rates=(48000,), inputs=(), outputs=(2,))
    assert answering([mic, box], "5", "0", "1", "") == 0
    told = capsys.readouterr().out
    assert "  0  Desk Mic (48 kHz mono)\nthat number" in told, "the box is no microphone"
    assert "  1  Box (48 kHz stereo)\n" in told
    assert "  Hri.Microphone at 48 kHz mono, converted to 16 kHz\n" in told
    assert "  Hri.Speaker at 48 kHz stereo\n" in told
    assert load_choices() == {"microphone": "0", "speaker": "1"}


def test_a_chosen_device_that_cannot_be_used_says_why(answering, capsys):
    assert answering([Card(error=BUSY)], "0", "", "") == 0
    assert "  microphone: it is busy - end the program that uses it" in capsys.readouterr().out
