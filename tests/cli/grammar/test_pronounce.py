"""`hri grammar pronounce` and `hri grammar lexicon`."""

from __future__ import annotations

import json

import pytest

from hri.speech.pronunciation.lexicon import user_lexicon


def test_the_ways_to_say_a_word_are_told(grammar, capsys):
    assert grammar("pronounce", "robot", "zorblax") == 0
    out = capsys.readouterr().out
    assert "robot  R OW B AA T  " in out
    assert "(CMU dictionary)" in out
    assert "robot  R OW B AH T  " in out
    assert "(guessed)" in out


def test_programs_get_one_object_a_word(grammar, capsys):
    assert grammar("pronounce", "read", "친구", "--json") == 1
    read, unknown = map(json.loads, capsys.readouterr().out.splitlines())
    assert read["phones"] == ["R EH D", "R IY D"]
    assert read["origin"] == "dictionary"
    assert "nobody knows" in unknown["error"]


@pytest.mark.proves("R03")
def test_a_pronunciation_is_added_and_how_to_undo_it_told(grammar, capsys):
    assert grammar("pronounce", "zorblax", "--add", "z ao1 r") == 0
    out = capsys.readouterr().out
    assert f"added to {user_lexicon()} - to undo it" in out
    assert "zorblax  Z AO R  " in out
    assert "(your lexicon" in out


def test_a_pronunciation_that_is_replaced_is_told(grammar, capsys):
    assert grammar("pronounce", "zorblax", "--add", "z ao1 r") == 0
    assert grammar("pronounce", "zorblax", "--add", "z aa r", "--add", "z ow r") == 0
    out = capsys.readouterr().out
    assert "no longer Z AO1 R\n" in out
    assert out.count("zorblax  Z AA R") == out.count("zorblax  Z OW R") == 1


def test_bytes_that_are_no_text_have_no_sound(grammar, capsys):
    assert grammar("pronounce", "\udcff") == 1
    assert "nobody knows how" in capsys.readouterr().out


def test_what_is_added_must_be_phones_of_one_word(grammar, capsys):
    assert grammar("pronounce", "zorblax", "--add", "zorb") == 2
    assert 'no phone "ZORB"' in capsys.readouterr().err
    assert grammar("pronounce", "two words", "--add", "T UW") == 2
    assert '--add is for one word - add "two" and "words" one by one' in capsys.readouterr().err
    assert not user_lexicon().exists()


def test_the_words_of_a_grammar_are_listed(grammar, write, capsys):
    assert grammar("lexicon", write("public <a> = read zorblax;")) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "read     R EH D   # dictionary"
    assert lines[2].endswith("# guessed")


def test_missing_words_come_as_a_lexicon(grammar, write, capsys, tmp_path):
    path = write("public <a> = read zorblax;")
    assert grammar("lexicon", path, "--missing") == 0
    printed = capsys.readouterr()
    assert printed.out.startswith("zorblax  Z ")
    assert "append them to" in printed.err

    own = tmp_path / "words.txt"
    own.write_text(printed.out)
    assert grammar("lexicon", path, "--missing", "--add", own) == 0
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "no word is guessed" in printed.err


def test_a_word_that_cannot_be_said_is_told(grammar, write, capsys):
    assert grammar("lexicon", write("public <a> = read 친구;")) == 1
    assert "# nobody knows how" in capsys.readouterr().out
