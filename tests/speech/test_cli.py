from __future__ import annotations

import json
import wave

from hri.cli.main import main


def run(*words: str) -> int:
    return main(words)


def test_check_is_content_with_the_companion(capsys):
    assert run("grammar", "check", "companion") == 0
    assert "companion.jsgf: fine, 21 commands" in capsys.readouterr().out


def test_check_refuses_an_undefined_rule_in_one_line(write, capsys):
    path = write("public <a> = <colr> hello;\n<color> = red;")

    assert run("grammar", "check", str(path)) == 2
    assert capsys.readouterr().err == (
        f'{path}:3:14: error: no rule <colr> - did you mean "color"?\n'
    )


def test_check_shows_few_of_many_errors(write, capsys):
    path = write("\n".join(f"public <a{n}> = (;" for n in range(20)))

    assert run("grammar", "check", str(path)) == 2
    assert len(capsys.readouterr().err.splitlines()) == 4


def test_an_unknown_name_is_told(capsys):
    assert run("grammar", "check", "compagnon") == 2
    assert 'did you mean "companion"?' in capsys.readouterr().err


def test_parse_prints_what_is_meant(capsys):
    assert run("grammar", "parse", "companion", "go back one meter", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["accepted"]
    assert (answer["rule"], answer["tags"]) == ("move", {"distance": -1.0})

    assert run("grammar", "parse", "companion", "fly to the moon", "--json") == 1
    assert json.loads(capsys.readouterr().out) == {"accepted": False}


def test_expand_lists_as_many_as_asked(capsys):
    assert run("grammar", "expand", "companion", "-n", "30") == 0
    assert len(set(capsys.readouterr().out.splitlines())) == 30


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
