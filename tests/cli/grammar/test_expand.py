from __future__ import annotations

from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse

RULES = "public <a> = go (left {x=1} | right) [now];\npublic <b> = stop;\n<c> = fast;"


def test_as_many_are_listed_as_asked(grammar, capsys):
    assert grammar("expand", "companion", "-n", 30) == 0
    assert len(set(capsys.readouterr().out.splitlines())) == 30


def test_the_same_seed_draws_the_same_sentences(grammar, capsys, companion_path):
    drawn = []
    for seed in (1, 1, 2):
        assert grammar("expand", "companion", "--random", 12, "--seed", seed) == 0
        drawn.append(capsys.readouterr().out.splitlines())
    assert drawn[0] == drawn[1] != drawn[2]
    assert len(set(drawn[0])) == 12
    companion = load_grammar(companion_path)
    assert all(parse(companion, sentence) for sentence in drawn[0])


def test_no_more_are_drawn_than_there_are(grammar, write, capsys):
    assert grammar("expand", write(RULES), "--random", 100) == 0
    assert len(capsys.readouterr().out.splitlines()) == 5


def test_sentences_are_counted(grammar, write, capsys):
    assert grammar("expand", write(RULES), "--count") == 0
    assert capsys.readouterr().out == "5 sentences, 5 ways to say them\n"
    assert grammar("expand", write("public <a> = go (go | stop)*;"), "--count") == 0
    assert capsys.readouterr().out.startswith("unlimited sentences")
    assert grammar("expand", write(f"public <a> = {'[go] ' * 1000} now;"), "--count") == 0
    assert capsys.readouterr().out == "about 10^301 ways to say something\n"


def test_one_rule_may_be_expanded_even_a_private_one(grammar, write, capsys):
    path = write(RULES)
    assert grammar("expand", path, "--rule", "c") == 0
    assert capsys.readouterr().out == "fast\n"
    tagged = write("public <a> = go <c>;\n<c> = fast {n=9};", "tagged")
    assert grammar("expand", tagged, "--rule", "c", "--tags") == 0
    assert capsys.readouterr().out == "fast {n=9}\n"
    assert grammar("expand", path, "--rule", "<bb>") == 2
    assert 'no rule <bb> - did you mean "b"?' in capsys.readouterr().err


def test_sentences_with_tags_are_a_file_of_expectations(grammar, write, capsys, tmp_path):
    path = write(RULES)
    assert grammar("expand", path, "--tags") == 0
    lines = capsys.readouterr().out
    assert "+ go left => a: x=1\n" in lines
    assert "+ go right => a: {}\n" in lines

    (tmp_path / "test.txt").write_text(lines)
    assert grammar("test", tmp_path / "test.txt") == 0
    assert "5 of 5 sentences as expected" in capsys.readouterr().out


def test_a_rule_that_has_no_sentence_to_list_says_so(grammar, write, capsys):
    doubled = "".join(f"<r{n}> = <r{n - 1}> <r{n - 1}>;\n" for n in range(1, 31))
    path = write(f"public <a> = <r30>;\n<r0> = one | two;\n{doubled}")

    assert grammar("expand", path) == 2
    assert "no sentence to list" in capsys.readouterr().err
    assert grammar("expand", write("public <a> = [<NULL>];")) == 2
