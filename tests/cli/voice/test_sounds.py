"""`hri sounds` lists, checks and makes sounds that are not words."""

import json

import pytest

from hri.cli.main import main
from hri.hal.drivers.wav_file import read_wav


def test_the_list_has_names_and_what_they_are(capsys):
    assert main(["sounds"]) == 0
    assert "yawn      2.5 s  yawn      a yawn" in capsys.readouterr().out
    assert main(["sounds", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {"name", "seconds", "gesture", "about"} == set(rows[0])


def test_sounds_are_written_one_after_the_other(tmp_path):
    out = tmp_path / "heard.wav"
    assert main(["sounds", "giggle", "[sigh long]", "--out", str(out), "--voice", "plain"]) == 0
    samples, rate = read_wav(out)
    assert 3.0 < len(samples) / rate < 4.5


@pytest.mark.parametrize("name", ["giggel", "giggle louder", "[giggel]"])
def test_an_unknown_sound_is_one_line(name, capsys):
    assert main(["sounds", name]) == 2
    assert 'did you mean "giggle"?' in capsys.readouterr().err


@pytest.mark.parametrize("words", [[""], ["[]"], ["Giggle!"], ["--out", "heard.wav"]])
def test_what_names_no_sound_is_one_line(words, capsys):
    assert main(["sounds", *words]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_file_of_ones_own_is_checked_and_used(tmp_path, capsys):
    mine = tmp_path / "mine.toml"
    mine.write_text(
        'schema = 1\n[hic]\nabout = "a hiccup"\nparts = [{ shape = "ih", ms = 90, voice = 1 }]\n'
    )
    out = tmp_path / "heard.wav"
    assert main(["sounds", "--file", str(mine), "hic", "--out", str(out)]) == 0
    assert out.exists()
    mine.write_text(mine.read_text().replace("ih", "oi"))
    assert main(["sounds", "--file", str(mine)]) == 2
    assert "mine.toml:4" in capsys.readouterr().err


def test_say_makes_them_among_words(tmp_path):
    out = tmp_path / "heard.json"
    assert main(["say", "[giggle] Yes.", "--phonemes", str(out)]) == 0
    times = json.loads(out.read_text())
    assert times["text"] == "[giggle] Yes."
    assert times["words"][0]["start"] > 0.7
