from __future__ import annotations

import wave

from hri.cli.main import main


def run(*words: str) -> int:
    return main(words)


def test_say_writes_a_file(tmp_path):
    path = tmp_path / "hello.wav"

    assert run("say", "hello there", "--wav", str(path)) == 0
    with wave.open(str(path)) as file:
        assert 0.3 < file.getnframes() / file.getframerate() < 3.0


def test_say_tells_what_it_cannot_write(tmp_path, capsys):
    assert run("say", "hello", "--wav", str(tmp_path / "no" / "x.wav")) == 2
    assert "cannot be written" in capsys.readouterr().err
    assert run("say", "hello", "--voice", "martian") == 2
    assert 'no voice "martian"' in capsys.readouterr().err
