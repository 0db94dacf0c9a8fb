from __future__ import annotations

import io
import json

import pytest

from hri.cli.main import main
from hri.core import paths

RULES = """#JSGF V1.0;
grammar test;
public <go> = go <where> [now];
<where> = to [the] <place>;
<place> = kitchen {place=kitchen} | garden {place="the garden"};
public <hide> = hide {n=1} | hide {n=2};
"""


@pytest.fixture
def robot(tmp_path):
    path = tmp_path / "test.jsgf"
    path.write_text(RULES)
    return str(path)


def parse(*words: str) -> int:
    return main(("grammar", "parse", *words))


def test_rule_tags_and_tree_are_printed(robot, capsys):
    assert parse(robot, "Go to the garden!") == 0
    assert capsys.readouterr().out.splitlines() == [
        "go to the garden",
        'go {place="the garden"}',
        "  <go> go to the garden",
        "    <where> to the garden",
        "      <place> garden",
    ]


def test_json_has_all_there_is(robot, capsys):
    assert parse(robot, "go to kitchen", "--json") == 0
    answer = json.loads(capsys.readouterr().out)

    place = {"rule": "place", "start": 2, "end": 3, "children": ["kitchen"]}
    where = {"rule": "where", "start": 1, "end": 3, "children": ["to", place]}
    tree = {"rule": "go", "start": 0, "end": 3, "children": ["go", where]}
    meaning = {"rule": "go", "tags": {"place": "kitchen"}, "tree": tree, "free": [], "slots": []}
    parses = {"parses": [meaning], "more_parses": False}
    assert answer == {"text": "go to kitchen", "accepted": True, **meaning, **parses}


def test_both_meanings_are_shown(robot, capsys):
    assert parse(robot, "hide") == 0
    assert capsys.readouterr().out.splitlines() == [
        "hide",
        "ambiguous, 2 meanings; the first counts",
        "hide {n=1}",
        "  <hide> hide",
        "hide {n=2}",
        "  <hide> hide",
    ]

    assert parse(robot, "hide", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert [reading["tags"] for reading in answer["parses"]] == [{"n": 1.0}, {"n": 2.0}]


def test_that_there_are_more_readings_than_are_listed_is_told(grammar, write, capsys):
    path = write("public <s> = (x {a+=1} | x {b+=1} | x {c+=1})+ end;")
    text = "x " * 12 + "end"
    assert grammar("parse", path, text) == 0
    assert "ambiguous, 20 or more meanings; the first counts" in capsys.readouterr().out

    assert grammar("parse", path, text, "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert len(answer["parses"]) == 20
    assert answer["more_parses"] is True


def test_a_refusal_tells_how_far_it_went_and_what_could_follow(robot, capsys):
    assert parse(robot, "go to kichen") == 1
    assert capsys.readouterr().out == (
        '"go to kichen" is not in the grammar: "kichen" does not fit after "go to"'
        ' - did you mean "kitchen"?\n  after "go to": garden, kitchen, the\n'
    )

    assert parse(robot, "go to", "--json") == 1
    answer = json.loads(capsys.readouterr().out)
    assert not answer["accepted"]
    assert [answer[name] for name in ("rule", "tags", "tree", "parses")] == ["", {}, None, []]
    assert (answer["understood"], answer["word"]) == ("go to", "")
    assert answer["expected"] == ["garden", "kitchen", "the"]


def test_what_is_too_much_at_the_end_is_told(robot, capsys):
    assert parse(robot, "hide away") == 1
    assert "the sentence ends there" in capsys.readouterr().out


def test_tolerance_shows_its_cost(robot, capsys):
    assert parse(robot, "um go go to kitchen", "--tolerant") == 0
    assert capsys.readouterr().out.startswith("go to kitchen   (+um +go, cost 0.6)\ngo {place=")

    assert parse(robot, "um go go to kitchen", "--tolerant", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["text"] == "go to kitchen"
    assert (answer["cost"], answer["edits"]) == (0.6, ["+um", "+go"])

    assert parse(robot, "go to kitchen", "--tolerant", "--json") == 0
    assert json.loads(capsys.readouterr().out)["cost"] == 0


def test_tolerant_takes_a_command_out_of_a_longer_sentence(robot, capsys):
    line = "hey buddy go to kitchen because i'm hungry"
    assert parse(robot, line, "--tolerant") == 0
    assert capsys.readouterr().out.startswith("go to kitchen\n")
    assert parse(robot, line) == 1


def test_a_refusal_points_to_tolerance_where_it_helps(robot, capsys):
    assert parse(robot, "um hide") == 1
    assert "with --tolerant: hide   (+um, cost 0.1)" in capsys.readouterr().out


def test_lines_of_standard_input_get_one_object_each(robot, capsys, monkeypatch):
    text = f"hide\n\ngo to kitchen\n{'x' * 50_000}\nfly"
    monkeypatch.setattr("sys.stdin", io.StringIO(text))

    assert parse(robot, "-", "--json") == 1
    answers = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [answer["accepted"] for answer in answers] == [True, True, False, False]


def test_bytes_that_are_no_text_are_refused_like_words(robot, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"\xff\xfe\nhide\n"), "utf-8"))

    assert parse(robot, "-", "--json") == 1
    assert capsys.readouterr().out.count("\n") == 2


def test_a_word_that_is_no_text_is_refused_like_others(robot, capsys):
    assert parse(robot, "\udcff hide well") == 1
    assert capsys.readouterr().out.encode().startswith('"\ufffd hide well" is not in'.encode())


def test_rules_in_rules_beyond_number_are_printed(tmp_path, capsys):
    links = "".join(f"<r{n}> = <r{n + 1}>;\n" for n in range(1500))
    path = tmp_path / "deep.jsgf"
    path.write_text(f"#JSGF V1.0;\ngrammar deep;\npublic <a> = <r0> x;\n{links}<r1500> = end;\n")

    assert parse(str(path), "end x", "--json") == 0
    assert json.loads(capsys.readouterr().out)["accepted"]
    assert parse(str(path), "end x") == 0


def test_an_error_of_the_grammar_has_its_place(tmp_path, capsys):
    path = tmp_path / "bad.jsgf"
    path.write_text("#JSGF V1.0;\ngrammar bad;\npublic <a> = <b>;\n")

    assert parse(str(path), "x") == 2
    assert capsys.readouterr().err == (
        f"{path}:3:14: no rule <b> - write <b> = words;\n"
        "    public <a> = <b>;\n"
        "                 ^\n"
    )


def test_the_house_grammars_take_little_words_with_patience(capsys):
    assert paths.find("grammars", "companion")
    assert parse("companion", "well turn left please", "--tolerant", "--json") == 0
    assert json.loads(capsys.readouterr().out)["rule"] == "turn"


def test_words_without_quotes_are_one_sentence(robot, capsys):
    assert parse(robot, "go", "to", "the", "garden") == 0
    assert capsys.readouterr().out.startswith("go to the garden\n")

    assert parse(robot, "hide", "go to garden") == 0
    assert capsys.readouterr().out.count("\ngo ") == 2
