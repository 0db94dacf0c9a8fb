from __future__ import annotations

import io
import json
import wave

import pytest

from hri.cli.main import main
from hri.cli.voice.say import prosody_of
from hri.core.signals import Prosody


def seconds(path):
    with wave.open(str(path)) as file:
        return file.getnframes() / file.getframerate()


def test_the_times_are_written_as_json(tmp_path):
    wav, path = tmp_path / "a.wav", tmp_path / "a.json"

    assert main(["say", "Hello you. Come in!", "--wav", str(wav), "--phonemes", str(path)]) == 0

    times = json.loads(path.read_text())
    assert list(times) == [
        "text",
        "rate",
        "duration",
        "alphabet",
        "phonemes",
        "words",
        "sentences",
        "marks",
    ]
    assert times["duration"] == pytest.approx(seconds(wav), abs=1e-3)
    assert set(times["phonemes"][0]) == {"name", "start", "duration", "stressed"}
    assert [word["text"] for word in times["words"]] == ["Hello", "you.", "Come", "in!"]
    assert [sentence["text"] for sentence in times["sentences"]] == ["Hello you.", "Come in!"]
    last = times["phonemes"][-1]
    assert last["start"] + last["duration"] == pytest.approx(times["duration"], abs=1e-3)


def test_rate_and_emotion_change_how_it_sounds(tmp_path):
    lengths = {}
    for name, options in {
        "plain": [],
        "fast": ["--rate", "300"],
        "sad": ["--emotion", "sadness"],
        "little": ["--emotion", "sadness", "--intensity", "0.1"],
    }.items():
        path = tmp_path / f"{name}.wav"
        assert main(["say", "I have found the red ball.", "--wav", str(path), *options]) == 0
        lengths[name] = seconds(path)

    assert lengths["fast"] < 0.7 * lengths["plain"]
    assert lengths["plain"] < lengths["little"] < lengths["sad"]


def test_a_text_comes_from_standard_input(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO("Hello there, you.\n"))

    assert main(["say", "-", "--wav", str(tmp_path / "a.wav")]) == 0
    assert seconds(tmp_path / "a.wav") > 0.6


@pytest.mark.parametrize(
    ("options", "remedy"),
    [
        (["--emotion", "joyy"], 'no emotion "joyy" - did you mean "joy"?'),
        (["--emotion", "joy", "--intensity", "2"], "give one from 0 to 1"),
        (["--voice", "en-us+f33"], 'no voice "en-us+f33" - did you mean "f3"?'),
        (["--emotion", "hapy"], 'no emotion "hapy" - did you mean "happy"?'),
        (["--intensity", "2"], "give one from 0 to 1"),
        (["--voice", "xx"], 'no voice "xx" - `hri voices` lists them'),
        (["--rate", "79"], "--rate 79 - give words a minute, 80 to 450"),
        (["--wav", "v.mp3"], "v.mp3: only WAV is written - name it v.wav"),
        (["--phonemes", "/no/such/place.json"], "cannot be written"),
    ],
)
def test_a_mistake_is_one_line(tmp_path, capsys, options, remedy):
    assert main(["say", "hello", "--wav", str(tmp_path / "a.wav"), *options]) == 2
    told = capsys.readouterr().err
    assert remedy in told
    assert len(told.splitlines()) == 1


@pytest.mark.parametrize("text", ["", "  \n"])
def test_nothing_is_refused(text, tmp_path, capsys):
    assert main(["say", text, "--wav", str(tmp_path / "a.wav")]) == 2
    assert "empty text - give some words" in capsys.readouterr().err
    assert not (tmp_path / "a.wav").exists()


def test_who_wants_the_times_alone_needs_no_speaker(tmp_path):
    path = tmp_path / "a.json"
    assert main(["say", "Hello.", "--phonemes", str(path)]) == 0
    assert json.loads(path.read_text())["text"] == "Hello."


@pytest.mark.parametrize(("name", "same"), [("happy", "joy"), ("neutral", None)])
def test_an_emotion_is_called_as_people_call_it(name, same):
    assert prosody_of(name, 1.0) == (prosody_of(same, 1.0) if same else Prosody())


def test_a_mistake_in_the_lexicon_has_its_place(tmp_path, monkeypatch, capsys):
    lexicon = tmp_path / "lexicon.txt"
    lexicon.write_text("robin R AA1 B AH0 N\nzaatar BLAH\n")
    monkeypatch.setenv("HRI_LEXICON", str(lexicon))
    assert main(["say", "hello", "--wav", str(tmp_path / "a.wav")]) == 2
    assert f"{lexicon}:2:" in capsys.readouterr().err


def test_voices_are_listed_by_language(capsys):
    assert main(["voices", "--language", "en", "--json"]) == 0

    voices = json.loads(capsys.readouterr().out)
    found = {voice["voice"]: voice for voice in voices}
    assert found["en-us"]["name"] == "English (America)"
    assert found["en-us"]["driver"] == "Hri.EspeakVoice"
    assert "+f3" in found
    assert "de" not in found
    assert main(["voices"]) == 0
    assert "German" in capsys.readouterr().out


def test_each_voice_says_what_it_cannot_do(capsys):
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    assert main(["voices", "--language", "en", "--json"]) == 0
    cannot = {voice["voice"]: voice["cannot"] for voice in json.loads(capsys.readouterr().out)}
    assert cannot["heart"] == []
    assert "emphasis within a sentence" in cannot["en-us"]
    assert "pitch" not in cannot["en-us"]


def test_the_variants_take_a_few_lines_and_no_table(capsys):
    assert main(["voices", "--language", "Korean"]) == 0
    table, variants, characters, engines = capsys.readouterr().out.split("\n\n")
    assert [line.split()[0] for line in table.splitlines()] == ["voice", "ko"]
    assert "+f3 +f4" in variants
    assert len(variants.splitlines()) < 20
    assert "  robot " in characters
    assert "Hri.EspeakVoice" in engines


def test_voices_speak_one_after_the_other(tmp_path, capsys):
    out = tmp_path / "heard.wav"
    assert main(["voices", "--play", "en-us", "german", "robot", "--out", str(out)]) == 0
    assert 7 < seconds(out) < 15
    assert main(["voices", "--play", "robott", "--out", str(out)]) == 2
    assert 'did you mean "robot"' in capsys.readouterr().err


@pytest.mark.parametrize(
    ("language", "remedy"),
    [
        ("nowhere-x", "`hri voices` lists all"),
        ("xx", "`hri voices` lists all"),
        ("englisch", 'did you mean "english"?'),
    ],
)
def test_a_language_nobody_speaks_is_told(language, remedy, capsys):
    assert main(["voices", "--language", language]) == 2
    assert capsys.readouterr().err == f'no voice speaks "{language}" - {remedy}\n'


def test_what_is_too_long_to_be_said_is_told(tmp_path, capsys):
    assert main(["say", "a" + " " * 5000, "--wav", str(tmp_path / "a.wav")]) == 0
    assert "only the first 5000 characters of 5001 are spoken" in capsys.readouterr().err


def test_the_times_go_to_standard_output_for_a_dash(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["say", "Hello.", "--phonemes", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["text"] == "Hello."
    assert list(tmp_path.iterdir()) == []
