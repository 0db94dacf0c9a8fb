from __future__ import annotations

import argparse
import io
import json
import wave

import numpy as np
import pytest
import soundfile

from hri.cli.grammar import listen
from hri.core.clock import FakeClock
from hri.core.signals import Rejection, Utterance
from hri.hal.drivers.resampling import resample
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar.matching import parse
from hri.speech.hearing import hear
from hri.speech.recognizers.automatic import AutomaticRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.turn import Turn

RATE = 16000


@pytest.fixture(scope="module")
def speak():
    """Makes speech at 16 kHz, with quiet around it."""
    manager = ResourceManager((), FakeClock())
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), manager)
    voice.activate()
    quiet = np.random.default_rng(0).normal(0, 8, RATE).astype(np.int16)

    def speak(*texts):
        parts = [quiet]
        for text in texts:
            speech = voice.synthesize(text)
            sound = resample(speech.samples, speech.rate, RATE)
            parts += [(0.5 * sound).astype(np.int16), quiet]
        return np.concatenate(parts)

    yield speak
    manager.close()


@pytest.fixture(scope="module")
def engine(companion):
    recognizer = AutomaticRecognizer(
        Description("ears", "Hri.Recognizer"), ResourceManager((), FakeClock())
    )
    recognizer.activate()
    recognizer.start(companion)
    yield recognizer
    recognizer.deactivate()


def run(*words):
    parser = argparse.ArgumentParser()
    listen.add_arguments(parser)
    return listen.run(parser.parse_args([str(word) for word in words]))


def objects(capsys):
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def write_wav(path, sound, rate=RATE):
    soundfile.write(path, sound, rate, subtype="PCM_16")
    return path


def test_an_answer_that_nobody_asked_for_is_told_by_its_own_words(engine, companion, speak):
    (heard,) = hear(speak("no"), RATE, engine, companion, turn=Turn())

    assert isinstance(heard, Rejection)
    assert (heard.reason, heard.text) == ("not now", "no")
    assert heard.detail == "<no> counts only while a question is open"


def test_speech_that_no_sentence_fits_names_the_nearest_one(engine, companion, speak):
    (heard,) = hear(speak("the weather was lovely in december"), RATE, engine, companion)

    assert isinstance(heard, Rejection)
    assert heard.reason == "unlike the sound"
    assert parse(companion, heard.text) is not None


def test_each_piece_of_a_recording_is_told_with_its_time(engine, companion, speak):
    sound = speak("go forward ten meters", "show me a happy face")

    first, second = hear(sound, RATE, engine, companion)

    assert (first.text, second.text) == ("go forward ten meters", "show me a happy face")
    assert 0.9 < first.start < first.end < second.start < second.end < len(sound) / RATE
    assert first.tags == {"distance": 10.0}


def test_words_are_told_while_they_are_said_where_somebody_wants_them(engine, companion, speak):
    told = []

    (heard,) = hear(
        speak("show me a happy face"), RATE, engine, companion, tell_partial=told.append
    )

    assert "show me a" in told
    assert told[-1] == heard.text


@pytest.mark.parametrize("rate", [8000, 11025, 22050, 44100, 48000])
def test_any_rate_is_understood(engine, companion, speak, rate):
    sound = resample(speak("show me a happy face"), RATE, rate)

    (heard,) = hear(sound, rate, engine, companion)

    assert heard.text == "show me a happy face"


@pytest.mark.parametrize(
    "harm",
    [
        lambda sound: (sound.astype(np.int32) // 2 + 8000).astype(np.int16),
        lambda sound: np.clip(sound.astype(np.int32) * 6, -32768, 32767).astype(np.int16),
        lambda sound: sound // 12,
    ],
    ids=["an offset", "clipping", "a whisper"],
)
def test_bad_sound_is_understood(engine, companion, speak, harm):
    heard = list(hear(harm(speak("show me a happy face")), RATE, engine, companion))

    assert "show me a happy face" in [one.text for one in heard]


def test_nothing_is_heard_in_silence_and_a_reason_in_foreign_speech(engine, companion, speak):
    assert list(hear(np.zeros(3 * RATE, np.int16), RATE, engine, companion)) == []
    heard = list(hear(speak("the cat sat on the purple window sill"), RATE, engine, companion))
    assert heard
    assert all(isinstance(one, Rejection) and one.reason for one in heard)


def test_an_answer_is_heard_only_while_a_question_is_open(engine, companion, speak):
    sound = speak("yes please")

    (asked,) = hear(sound, RATE, engine, companion, turn=Turn(is_question_open=True))
    (unasked,) = hear(sound, RATE, engine, companion, turn=Turn())

    assert isinstance(asked, Utterance)
    assert isinstance(unasked, Rejection)


def test_listen_tells_programs_one_object_a_piece(tmp_path, speak, capsys):
    said = write_wav(tmp_path / "two.wav", speak("go forward ten meters", "stop"))
    silent = write_wav(tmp_path / "none.wav", np.zeros(RATE, np.int16))

    assert run("companion", "--json", "--wav", said, silent) == 1

    first, second, third = objects(capsys)
    assert (first["file"], first["accepted"], first["rule"]) == (str(said), True, "move")
    assert (first["text"], first["tags"]) == ("go forward ten meters", {"distance": 10.0})
    assert first["start_s"] < first["end_s"] < second["start_s"]
    assert first["reason"] == ""
    assert 0.0 <= first["latency_s"] < 1.0
    assert second["text"] == "stop"
    assert (third["file"], third["accepted"], third["reason"]) == (str(silent), False, "no speech")
    assert third["text"] == ""


def test_listen_goes_on_behind_a_file_it_cannot_read(tmp_path, speak, capsys):
    (tmp_path / "broken.wav").write_bytes(b"RIFF____WAVEfmt nonsense")
    said = write_wav(tmp_path / "said.wav", speak("stop"))

    status = run("companion", "--wav", tmp_path / "broken.wav", tmp_path / "no.wav", said)

    out, errors = capsys.readouterr()
    assert status == 2
    assert "stop: stop" in out
    assert "broken.wav: not a readable" in errors
    assert "no.wav: no such file" in errors


@pytest.mark.parametrize("subtype", ["PCM_U8", "PCM_24", "PCM_32", "FLOAT"])
def test_listen_takes_stereo_of_any_width(tmp_path, speak, capsys, subtype):
    sound = resample(speak("show me a happy face"), RATE, 44100)
    stereo = np.stack([sound, np.zeros_like(sound)], axis=1)
    soundfile.write(tmp_path / "wide.wav", stereo, 44100, subtype=subtype)

    run("companion", "--json", "--wav", tmp_path / "wide.wav")

    assert "show me a happy face" in [one["text"] for one in objects(capsys)]


def test_listen_takes_typed_lines_in_turn(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("go back one meter\n\nfly away\nyes\n"))

    assert run("companion", "--typed") == 1

    assert capsys.readouterr().out.splitlines() == [
        "move: go back one meter {distance=-1}  (1.00)",
        'not in grammar "fly away" (1.00) - no sentence begins with "fly"',
        'not now "yes" (1.00) - <yes> counts only while a question is open',
    ]


def test_a_question_can_be_open(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("yes\n"))

    assert run("companion", "--typed", "--question") == 0
    assert capsys.readouterr().out.startswith("yes: yes")


def test_strictness_is_a_share(capsys):
    with pytest.raises(SystemExit):
        run("companion", "--strictness", "2")
    assert "write a number from 0 to 1" in capsys.readouterr().err


def test_the_loudest_moment_of_a_file_is_no_matter_of_its_header(tmp_path, speak, capsys):
    path = tmp_path / "cut.wav"
    write_wav(path, speak("stop"))
    path.write_bytes(path.read_bytes()[:-20000])  # its header promises more than there is

    run("companion", "--json", "--wav", path)

    with wave.open(str(path)) as file:
        assert file.getnframes() > 0
    assert objects(capsys)[0]["text"] == "stop"
