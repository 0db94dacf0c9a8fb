"""`hri grammar watch` checks and tests what is saved; `test` tells all that is wrong."""

import os

import pytest

from hri.cli.grammar.watch import watch
from hri.cli.main import main
from hri.core.clock import FakeClock

GOOD = "#JSGF V1.0;\ngrammar my;\npublic <light> = switch on the light;\n"


@pytest.fixture
def put(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    saved = [0]

    def put(name, text):
        (tmp_path / name).write_text(text)
        saved[0] += 10  # two saves within the resolution of the file system
        os.utime(tmp_path / name, (saved[0], saved[0]))
        return tmp_path / name

    return put


def test_each_save_is_checked_and_tested_until_ctrl_c(put, capsys):
    clock = FakeClock()
    grammar = put("my.jsgf", GOOD)
    shown = []

    def look():
        shown.append("".join(capsys.readouterr()))

    def end():
        look()
        raise KeyboardInterrupt

    clock.call_at(1.2, look)
    clock.call_at(1.3, lambda: put("my.jsgf", GOOD.replace("=", "")))
    clock.call_at(2.2, look)
    clock.call_at(2.3, lambda: put("my.jsgf", GOOD))
    clock.call_at(2.4, lambda: put("my.txt", "+ switch off the light\n"))
    clock.call_at(3.2, look)
    clock.call_at(4.2, end)
    assert watch(grammar, [], clock) == 0
    assert [text.count("--- ") for text in shown] == [1, 1, 1, 0]
    assert "my.jsgf: fine, 1 command" in shown[0]
    assert 'my.jsgf:3:16: error: "=" was expected' in shown[1] or "error" in shown[1]
    assert "my.txt: 0 of 1 sentences as expected" in shown[2]


def test_all_mistakes_of_sentences_and_of_the_grammar_are_told(put, capsys):
    put("my.jsgf", GOOD + "public <a> = <b>;\npublic <c> = <d>;\n")
    put("my.txt", "+ switch on the light\nhello\n+\n")
    assert main(["grammar", "test", "my.txt"]) == 2
    told = capsys.readouterr().err
    assert "my.txt:2:1: a line of another kind" in told
    assert "my.txt:3:1: no sentence" in told
    put("my.txt", "+ switch on the light\n")
    assert main(["grammar", "test", "my.txt"]) == 2
    told = capsys.readouterr().err
    assert "my.jsgf:4:14: no rule <b>" in told
    assert "my.jsgf:5:14: no rule <d>" in told


def test_sentences_are_for_the_grammar_beside_them_whatever_its_suffix(put, capsys):
    put("my.gram", GOOD)
    put("my.txt", "+ switch on the light\n")
    put("named.txt", "grammar my\n+ switch on the light\n")
    assert main(["grammar", "test", "my.txt", "named.txt"]) == 0
    assert capsys.readouterr().out.count("1 of 1 sentences as expected") == 2
    assert main(["grammar", "check", "my"]) == 0


def test_a_wrong_file_does_not_keep_others_from_being_tried(put, capsys):
    put("my.jsgf", GOOD)
    put("my.txt", "+ switch on the light\n")
    put("bad.txt", "hello\n")
    assert main(["grammar", "test", "bad.txt", "my.txt"]) == 2
    out = capsys.readouterr()
    assert "my.txt: 1 of 1 sentences as expected" in out.out
    assert "bad.txt:1:1: a line of another kind" in out.err
