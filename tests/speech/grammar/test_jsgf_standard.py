"""What JSGF 1.0 allows and forbids, one row a case."""

from __future__ import annotations

import pytest

from hri.core.errors import AuthoringError
from hri.speech.grammar import load_grammar
from hri.speech.grammar.jsgf import read_jsgf
from hri.speech.grammar.matching import parse


@pytest.mark.parametrize(
    ("rules", "said", "unsaid"),
    [
        # Tokens
        ("public <a> = hello World;", ["hello world", "Hello, world!"], ["hello", "world"]),
        ('public <a> = "New York" now;', ["new york now"], ["new now"]),
        ('public <a> = "say \\"hi\\"";', ["say hi"], ["hi"]),
        ("public <a> = don't o'clock;", ["don't o'clock", "don\u2019t o'clock"], ["dont oclock"]),
        ("public <a> = vorwärts 東京 и;", ["vorwärts 東京 и", "VORWÄRTS 東京 И"], ["vorwarts"]),
        ("public <a> = cafe\u0301;", ["café", "cafe\u0301"], ["cafe"]),
        ("public <a> = hello, robot.;", ["hello robot"], ["hello"]),
        ("public <a> = and/or;", ["and/or"], ["and", "or"]),
        ("public <a> = public import grammar;", ["public import grammar"], ["public"]),
        # Comments
        ("public <a> = x // y\n | z;", ["x", "z"], ["y", "x z"]),
        ("public <a> = x /* y\n y */ z;", ["x z"], ["x y z"]),
        ("public <a> = x/* y */z;", ["x z"], ["x"]),
        ("public <a> = /**/ x /***/;", ["x"], []),
        # Rule names
        ("public <$1/2-@&%é> = x;", ["x"], []),
        ("public <a> = < b >;\n<b> = x;", ["x"], []),
        ("public <a> = <B> <b>;\n<b> = x;\n<B> = y;", ["y x"], ["x y"]),
        ("public <a> = <test.b>;\n<b> = x;", ["x"], []),
        # Sequences, alternatives, weights
        ("public <a> = x y | z;", ["x y", "z"], ["x", "x z"]),
        ("public <a> = /10/ x | /.5/ y | /1e-3/ z | /8f/ w;", ["x", "y", "z", "w"], []),
        ("public <a> = /2/ x y | z;", ["x y", "z"], ["x"]),
        ("public <a> = x | /0/ y;", ["x"], ["y"]),
        ("public <a> = (/2/ x | y) z;", ["x z", "y z"], ["x"]),
        # Groups and what stands behind them
        ("public <a> = x (y | z);", ["x y", "x z"], ["x"]),
        ("public <a> = [x] [y] z;", ["z", "x z", "x y z"], ["x", "y x z"]),
        ("public <a> = x y*;", ["x", "x y y"], ["x y x y", ""]),
        ("public <a> = (x y)*z;", ["z", "x y x y z"], ["x z"]),
        ("public <a> = x+ y;", ["x y", "x x y"], ["y"]),
        ("public <a> = [x]* y;", ["y", "x x y"], ["x"]),
        ("public <a> = (x+)* y;", ["y", "x x y"], ["x"]),
        ('public <a> = "back\\\\slash";', ["back slash", "back\\slash"], ["backslash"]),
        # <NULL>, <VOID>, recursion
        ("public <a> = x <NULL> | y <VOID>;", ["x"], ["y"]),
        ("public <a> = x | <off>;\n<off> = <VOID>;", ["x"], [""]),
        ("public <a> = x | y <off> | <off> z;\n<off> = no <VOID>;", ["x"], ["y", "z", "no"]),
        ("public <a> = x [<off>] y*;\n<off> = <of>;\n<of> = <VOID> | /0/ u;", ["x y"], ["x u"]),
        ("public <a> = x;\npublic <b> = <VOID> y;", ["x"], ["y"]),
        ("public <a> = x | y <a>;", ["x", "y y x"], ["y"]),
        ("public <a> = x (and <a> | <NULL>);", ["x", "x and x and x"], ["x and"]),
        ("public <a> = x [and <b>];\n<b> = y <a>;", ["x", "x and y x"], ["x and y"]),
    ],
)
def test_legal_text_is_understood(write, rules, said, unsaid):
    grammar = load_grammar(write(rules))

    assert [text for text in said if parse(grammar, text) is None] == []
    assert [text for text in unsaid if parse(grammar, text) is not None] == []


@pytest.mark.parametrize(
    ("rules", "tags"),
    [
        ("public <a> = x {t=1} y;", {"t": 1.0}),
        ("public <a> = x y {t=1} {u=2};", {"t": 1.0, "u": 2.0}),
        ("public <a> = (x y) {t=1};", {"t": 1.0}),
        ("public <a> = [x] {t=1} [y] {u=2} [z] {v=3};", {"t": 1.0, "u": 2.0, "v": 3.0}),
        ("public <a> = <b> {u=$t} y;\n<b> = x {t=1};", {"u": 1.0}),
        ("public <a> = x y | x y {t=1} | z {t=2};", {}),
        ('public <a> = "x y" {t="\\{\\\\\\}"};', {"t": "{\\}"}),
        ("public <a> = (x | y)+ {t=1};", {"t": 1.0}),
        ("public <a> = x\n{\nt=1;\nu\n}\ny;", {"t": 1.0, "u": True}),
        ("public <a> = <NULL> {t=1} x y;", {"t": 1.0}),
    ],
)
def test_a_tag_belongs_to_what_stands_before_it(write, rules, tags):
    assert parse(load_grammar(write(rules)), "x y").tags == tags


@pytest.mark.parametrize(
    ("text", "place", "what"),
    [
        ("#JSGF V2.0;\ngrammar a;\npublic <a> = x;", "1:1", 'header "#JSGF V2.0;" is not'),
        ("#JSGF V1.0\ngrammar a;\npublic <a> = x;", "1:1", "is not understood"),
        ("#JSGF V1.0;\npublic <a> = x;", "2:1", 'expected "grammar"'),
        ("#JSGF V1.0;\ngramar a;\npublic <a> = x;", "2:1", 'expected "grammar"'),
        ("#JSGF V1.0;\ngrammar <a>;\npublic <a> = x;", "2:9", "expected the grammar's name"),
        ("#JSGF V1.0;\ngrammar a..b;\npublic <a> = x;", "2:9", "expected the grammar's name"),
        ("#JSGF V1.0;\ngrammar a;\npublic <NULL> = x;", "3:8", "<NULL> is defined by JSGF"),
        ("#JSGF V1.0;\ngrammar a;\npublic <b.c> = x;", "3:8", "a rule of another grammar"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = x) y;", "3:15", 'this ")" has no "("'),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = (x];", "3:16", 'expected ")", found "]"'),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = * x;", "3:14", 'expected words, found "*"'),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = {t=1} x;", "3:14", "expected words"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = x | | y;", "3:18", "expected words"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = <b>;\n<b> = <VOID> x;", "3:1", "never be said"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = y <a> | <VOID> x;", "3:1", "never be said"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = /-1/ x | y;", "3:14", "/-1/ is not a weight"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = x , y;", "3:16", "nothing that can be said"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = x; /* y", "3:17", "this comment has no end"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = /0/ x | /0/ y;", "3:1", "never be said"),
        ("#JSGF V1.0;\ngrammar a;\nimport <b>;", "3:8", "expected a rule of another grammar"),
        ('#JSGF V1.0;\ngrammar a;\nimport "b.txt" <b>;', "3:16", 'expected "as"'),
        ("", "1:1", "the header is missing"),
    ],
)
def test_illegal_text_is_refused_at_its_place(tmp_path, text, place, what):
    path = tmp_path / "a.jsgf"
    path.write_text(text, encoding="utf-8")

    with pytest.raises(AuthoringError) as caught:
        load_grammar(path)

    assert str(caught.value).startswith(f"{path}:{place}: ")
    assert what in caught.value.what
    assert caught.value.remedy


def test_misspelt_keywords_are_named(tmp_path):
    path = tmp_path / "a.jsgf"
    path.write_text("#JSGF V1.0;\ngramar a;\nimprt <b.c>;\npublik <a> = x;\n")

    with pytest.raises(AuthoringError, match='did you mean "grammar"'):
        load_grammar(path)


@pytest.mark.parametrize(
    ("header", "encoding", "locale"),
    [
        ("#JSGF v1.0;", "", ""),
        ("#jsgf v1.0 utf-8 en;", "utf-8", "en"),
        ("# JSGF  V 1.0 ;", "", ""),
        ("#JSGF V1;", "", ""),
        ("#JSGF 1.0 UTF-8;", "UTF-8", ""),
        ("#JSGF V1.0 fr;", "", "fr"),
        ("#JSGF V1.0 fr-CA ;", "", "fr-CA"),
        ("#JSGF/* one */V1.0 /* two **/ UTF-8 /* three */ fr /* four; */;", "UTF-8", "fr"),
        (
            "\ufeff// A comment;\n/* Another\n * one. */\n\n#JSGF V1.0 UTF-8 fr; // the third",
            "UTF-8",
            "fr",
        ),
    ],
)
def test_the_header_is_read_liberally(tmp_path, header, encoding, locale):
    path = tmp_path / "a.jsgf"
    path.write_text(f"{header}\ngrammar a;\npublic <a> = x;\n", encoding="utf-8")

    document = read_jsgf(path.read_text(encoding="utf-8"), path)

    assert document.errors == []
    assert (document.encoding, document.locale) == (encoding, locale)
    assert parse(load_grammar(path), "x")


def test_the_header_may_name_the_language(tmp_path):
    path = tmp_path / "a.jsgf"
    path.write_text("#JSGF V1.0 UTF-8 en-US;\ngrammar a;\npublic <a> = x;\n")

    assert load_grammar(path).locale == "en-US"
