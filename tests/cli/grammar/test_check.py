from __future__ import annotations

import json
from pathlib import Path

import pytest


@pytest.mark.slow
def test_the_companion_is_fine(grammar, capsys):
    assert grammar("check", "companion") == 0
    assert "companion.jsgf: fine, 418 commands" in capsys.readouterr().out


def test_an_error_is_shown_in_its_line_under_a_caret(grammar, write, capsys):
    path = write("public <a> = <colr> hello;\n<color> = red;")

    assert grammar("check", path) == 2
    assert capsys.readouterr().err == (
        f'{path}:3:14: error: no rule <colr> - did you mean "color"?\n'
        "    public <a> = <colr> hello;\n"
        "                 ^\n"
    )


def test_what_the_default_engine_cannot_hear_is_told(grammar, write, capsys):
    nested = "".join(f"<{a}> = {' '.join(8 * [f'<{b}>'])};\n" for a, b in ("de", "ef"))
    rules = f"public <c> = {' '.join(8 * ['<d>'])} end;\n{nested}<f> = [one] [two] [three] [four];"

    assert grammar("check", write(rules)) == 0
    out = capsys.readouterr().out
    assert "warning: the grammar needs more than 2000000 states of the recognizer - have" in out

    assert grammar("check", write(rules.replace("end;", "zorblax_ <gone>;"))) == 2
    said = capsys.readouterr()
    assert "no rule <gone>" in said.err
    assert "states of the recognizer" not in said.out + said.err


def test_few_of_many_errors_are_shown_unless_all_are_wanted(grammar, write, capsys):
    path = write("\n".join(f"public <a{n}> = (;" for n in range(20)))

    assert grammar("check", path) == 2
    err = capsys.readouterr().err
    assert err.count("error:") == 3
    assert "17 more errors" in err

    assert grammar("check", path, "--all") == 2
    assert capsys.readouterr().err.count("error:") == 20

    assert grammar("check", write("\n".join(f"public <a{n}> = (;" for n in range(4)))) == 2
    assert "1 more error -" in capsys.readouterr().err


def test_a_file_that_is_no_text_is_a_finding_like_others(grammar, write, capsys):
    path = write("public <a> = hello robot;")
    path.write_bytes(path.read_bytes() + b"\xff")

    assert grammar("check", path) == 2
    assert f"{path}:3:26: error: not UTF-8 text" in capsys.readouterr().err
    assert grammar("check", path, "--json") == 2
    (finding,) = json.loads(capsys.readouterr().out)["findings"]
    assert (finding["severity"], finding["column"]) == ("error", 26)


def test_strict_makes_warnings_fail(grammar, write, capsys):
    path = write("public <a> = go forward | no;")

    assert grammar("check", path) == 0
    assert "warning:" in capsys.readouterr().out
    assert grammar("check", path, "--strict") == 1


def test_programs_get_places_and_remedies(grammar, write, capsys):
    path = write("public <a> = go forward | no;")

    assert grammar("check", path, "--json") == 0
    told = json.loads(capsys.readouterr().out)
    (finding,) = told["findings"]
    assert (told["commands"], told["words"]) == (1, 3)
    assert (finding["severity"], finding["line"], finding["column"]) == ("warning", 3, 27)
    assert '"no"' in finding["what"]


def test_a_caret_stands_under_its_spot_in_long_and_wide_lines(grammar, write, capsys):
    words = " | ".join(f"word{chr(97 + n)}" for n in range(26))
    path = write(f"public <a> = {words} | <nowhere>;\npublic <\u4e2d\u6587> = go <x>;")

    assert grammar("check", path) == 2
    lines = capsys.readouterr().err.splitlines()
    assert max(map(len, lines[1::3])) <= 104
    assert lines[1][lines[2].index("^") :].startswith("<nowhere>")
    assert lines[5].index("^") == lines[4].index("<x>") + 2


def test_without_a_dictionary_the_rest_is_checked(grammar, write, monkeypatch, capsys):
    monkeypatch.setattr("hri.speech.pronunciation.dictionary.DICTIONARY", Path("nowhere"))
    path = write("public <a> = go forward | no;\n<b> = never;")

    assert grammar("check", path) == 0
    told = capsys.readouterr()
    assert "pronunciations are not checked: the dictionary" in told.err
    assert "<b> is not used" in told.out


@pytest.mark.parametrize("name", ["compagnon", "/nowhere/x.jsgf"])
def test_a_grammar_that_is_not_there_is_told(grammar, capsys, name):
    assert grammar("check", name) == 2
    assert " - " in capsys.readouterr().err


def test_help_lists_the_commands_and_gives_examples(grammar, capsys):
    for words, expected in ((["--help"], "calibrate"), (["check", "--help"], "examples:")):
        with pytest.raises(SystemExit) as ended:
            grammar(*words)
        assert ended.value.code == 0
        assert expected in capsys.readouterr().out


@pytest.mark.parametrize("name", ["check", "expand", "test", "confuse", "pronounce", "lexicon"])
def test_every_command_has_examples(grammar, capsys, name):
    with pytest.raises(SystemExit):
        grammar(name, "--help")
    assert f"hri grammar {name}" in capsys.readouterr().out.partition("examples:")[2]


def test_notes_are_shown_to_those_who_ask(grammar, write, capsys):
    path = write("public <a> = stop;")
    assert grammar("check", path, "--strict") == 0
    assert capsys.readouterr().out == f"{path}: fine, 1 command, 1 word, 1 note (see --all)\n"

    assert grammar("check", path, "--all") == 0
    out = capsys.readouterr().out
    assert f'{path}:3:14: note: "stop" is one word' in out
    assert out.endswith("1 note\n")


def test_a_grammar_in_the_folder_one_works_in_needs_no_suffix(grammar, write, monkeypatch, capsys):
    monkeypatch.chdir(write("public <a> = go on;", "kitchen").parent)

    assert grammar("check", "kitchen") == 0
    assert "kitchen.jsgf: fine" in capsys.readouterr().out
