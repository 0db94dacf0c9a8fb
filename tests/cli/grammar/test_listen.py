from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import numpy as np
import pytest

from hri.cli.grammar import listen
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.hal.drivers import sound_card
from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource import Description
from tests.speech.recognizers.speaking import spoken


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Evening(FakeClock):
    """Somebody presses Ctrl-C after a while."""

    def advance(self, seconds):
        super().advance(seconds)
        if self.now() > 6.0:
            raise KeyboardInterrupt


@pytest.fixture
def typed(grammar, monkeypatch, companion_path):
    def typed(lines, *more):
        monkeypatch.setattr(sys, "stdin", io.StringIO(lines))
        return grammar("listen", companion_path, "--typed", *more)

    return typed


def test_a_typed_line_may_have_little_words_too_many_at_a_price(typed, capsys):
    assert typed("go forward ten meters\n\ngo go forward the ten meters\n", "--json") == 0

    exact, forgiven = map(json.loads, capsys.readouterr().out.splitlines())
    assert exact["tags"] == forgiven["tags"] == {"distance": 10.0}
    assert exact["text"] == forgiven["text"] == "go forward ten meters"
    assert exact["confidence"] == 1.0
    assert 0.5 <= forgiven["confidence"] < 1.0


@pytest.mark.parametrize(
    ("line", "detail"),
    [
        ("turn", 'after "turn": '),
        ("go forwrd", 'did you mean "forward"?'),
        ("zorg", 'no sentence begins with "zorg"'),
        ("turn " * 400, 'after "turn'),
    ],
)
def test_a_typed_line_that_is_no_sentence_is_told_why(typed, capsys, line, detail):
    assert typed(line + "\n") == 1
    assert detail in capsys.readouterr().out


def test_one_channel_of_a_recording_is_heard(grammar, companion_path, tmp_path, capsys):
    sound = np.pad(spoken("go forward"), 8000)
    noise = np.random.default_rng(1).integers(-9000, 9000, len(sound), np.int16)
    stereo = np.stack([sound, noise], axis=1).ravel()
    write_wav(tmp_path / "said.wav", stereo, 16000)
    data = bytearray((tmp_path / "said.wav").read_bytes())
    data[22:24], data[32:34] = b"\x02\x00", b"\x04\x00"  # two channels, four bytes a frame
    (tmp_path / "said.wav").write_bytes(data)

    status = grammar("listen", companion_path, "--wav", tmp_path / "said.wav", "--channel", "left")

    assert status == 0
    assert "move: go forward" in capsys.readouterr().out


def test_the_microphone_is_heard_until_ctrl_c_with_level_words_and_results(
    grammar, companion_path, monkeypatch, capsys
):
    def opened(options, manager):
        microphone = MemoryMicrophone(Description("microphone", "Hri.MemoryMicrophone"), manager)
        microphone.activate()
        microphone.hear(np.pad(spoken("go forward ten meters"), (16000, 0)))
        return microphone

    monkeypatch.setattr(listen, "_open_microphone", opened)
    monkeypatch.setattr(listen, "RealClock", Evening)
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)

    assert grammar("listen", companion_path, "--mic") == 0

    shown = [line.removeprefix("\x1b[K") for line in terminal.getvalue().split("\r")]
    assert any(line.startswith("[####") and "*" in line for line in shown)
    assert any("go forward" in line for line in shown)
    assert shown[-1] == ""
    assert capsys.readouterr().out.startswith("move: go forward ten meters {distance=10}")


def test_recordings_of_several_sentences_give_an_object_a_line(
    grammar, companion_path, tmp_path, capsys
):
    quiet = np.zeros(20000, np.int16)
    go, left = spoken("go forward ten meters"), spoken("turn left")
    write_wav(tmp_path / "two.wav", np.concatenate([quiet, go, quiet, left, quiet]), 16000)
    write_wav(tmp_path / "none.wav", quiet, 16000)

    files = (tmp_path / "two.wav", tmp_path / "none.wav", tmp_path / "missing.wav")
    assert grammar("listen", companion_path, "--json", "--wav", *files) == 2

    told = capsys.readouterr()
    objects = [json.loads(line) for line in told.out.splitlines()]
    assert [(Path(one["file"]).name, one["text"]) for one in objects] == [
        ("two.wav", "go forward ten meters"),
        ("two.wav", "turn left"),
        ("none.wav", ""),
    ]
    assert objects[0]["tags"] == {"distance": 10.0}
    assert 1.2 < objects[0]["start_s"] < objects[0]["end_s"] < objects[1]["start_s"]
    assert objects[2]["reason"] == "no speech"
    fields = "file start_s end_s accepted text rule tags confidence reason latency_s sure"
    fields += " unsure choices begun may_go_on continues level_dbfs"
    assert all(list(one) == fields.split() for one in objects)
    assert "missing.wav" in told.err


def test_a_model_is_for_the_engine_that_can_use_it(grammar, companion_path, tmp_path, capsys):
    model = ("--model", tmp_path / "none", "--wav", "x.wav")

    assert grammar("listen", companion_path, *model) == 2
    assert "no Vosk model in" in capsys.readouterr().err
    assert grammar("listen", companion_path, "--engine", "ctc", *model) == 2
    assert "--engine ctc takes no --model" in capsys.readouterr().err


@pytest.mark.parametrize("words", [(), ("--mic",)])
def test_without_a_microphone_it_says_what_else_there_is(
    grammar, companion_path, monkeypatch, capsys, words
):
    def missing():
        raise NotAvailable("sound card: PortAudio is missing - apt install libportaudio2")

    monkeypatch.setattr(sound_card, "load_sounddevice", missing)

    assert grammar("listen", companion_path, *words) == 2
    told = capsys.readouterr().err
    assert "PortAudio is missing" in told
    assert ("--typed" in told) == (not words)
