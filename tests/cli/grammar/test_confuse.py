from __future__ import annotations

import json

import pytest

THINGS = ["coat", "pencil", "mug", "box", "spoon"]
RULES = (
    "public <bring> = bring me the <thing>;\n"
    f"<thing> = {' | '.join(f'{thing} {{thing={thing}}}' for thing in THINGS)};\n"
)


@pytest.fixture
def said(tmp_path):
    path = tmp_path / "outside.txt"
    path.write_text("# what else\nBring me the goat.\nbring me the mug\nsing a song\n", "utf-8")
    return path


def test_words_beside_the_lists_follow_the_pairs(grammar, write, capsys):
    assert grammar("confuse", write(RULES)) == 0
    out = capsys.readouterr().out
    assert '"goat"' in out
    assert "~  coat <thing> thing=coat\n" in out
    assert "words of lists have a common word as near" in out

    assert grammar("confuse", write(RULES), "--json", "-n", 1) == 0
    (near,) = json.loads(capsys.readouterr().out)["beside"]
    assert near["rule"] == "thing"
    assert near["entry"] == near["word"] == near["tags"]["thing"]
    assert near["outside"][0]["distance"] <= 0.25


def test_outside_sentences_that_are_taken_are_shown_with_what_they_set(
    grammar, write, said, capsys
):
    path = write(RULES)
    assert grammar("confuse", path, "--outside", said) == 0
    assert capsys.readouterr().out == (
        "0.02  goat  ~  coat, which sets thing=coat\n"
        '      "bring me the goat"\n'
        '      "bring me the coat" => bring: thing=coat\n'
        f"{path}: 1 of 2 outside sentences are no farther from one of the grammar than 0.12\n"
    )

    assert grammar("confuse", path, "--outside", said, "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert told["outside"] == 2
    (taken,) = told["taken"]
    assert taken["difference"] == ["goat", "coat"]
    assert taken["sets"] == {"thing": "coat"}
    assert taken["taken_for"]["text"] == "bring me the coat"


def test_a_file_that_is_not_there_is_told(grammar, write, tmp_path, capsys):
    assert grammar("confuse", write(RULES), "--outside", tmp_path / "none.txt") == 2
    assert "none.txt" in capsys.readouterr().err
