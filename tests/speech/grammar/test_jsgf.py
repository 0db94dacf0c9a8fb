from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.jsgf import read_jsgf
from hri.speech.grammar.matching import parse
from hri.speech.grammar.rules import LARGEST_FILE

FEATURES = """#JSGF V1.0 UTF-8 en;
// A line.
/* A block
   of lines. */
grammar all.features;

/** Says hello.
 *  In two lines. */
public <greet> = (/2.5/ hello | /1/ "Good Day" | hi) [there] <name>*;
public <count> = <digit>+ {done};
<digit> = one {n=1} | two {n=2};
<name> = robin {who=robin} | <NULL> anne <VOID>;
"""


def test_every_feature_is_read():
    document = read_jsgf(FEATURES, Path("all.jsgf"))

    assert document.errors == []
    assert document.name == "all.features"
    assert [rule.name for rule in document.rules] == ["greet", "count", "digit", "name"]
    assert [rule.is_public for rule in document.rules] == [True, True, False, False]
    assert document.rules[0].doc == "Says hello. In two lines."
    assert document.rules[0].expression.items[0].weights == (2.5, 1.0, 1.0)
    assert (document.rules[0].span.line, document.rules[0].span.column) == (9, 1)


@pytest.mark.parametrize(
    ("rules", "place", "what", "remedy"),
    [
        ("public <a> = hello", "3:19", 'expected ";"', "end the rule"),
        ("public <a> = (hello;", "3:20", 'expected ")"', 'close the "(" of line 3, column 14'),
        ("public <a> = [hello;", "3:20", 'expected "]"', "column 14"),
        ("public <a> = ;", "3:14", "expected words", "<NULL>"),
        ("public <a> = hello | ;", "3:22", "expected words", "<NULL>"),
        ("pubic <a> = hello;", "3:1", "expected a rule", 'did you mean "public"?'),
        ("public <a> hello;", "3:12", 'expected "="', 'write "="'),
        ("public <a b> = hello;", "3:8", "<a b> is no rule name", "letters"),
        ("public <a> = hello {n=;", "3:20", "this tag has no end", '"}"'),
        ("public <a> = hello {n==3};", "3:20", "cannot read the tag", "{name=value}"),
        ("public <a> = hello {};", "3:20", "the tag is empty", "{name=value}"),
        ('public <a> = "hello;', "3:14", "this quote has no end", "quote"),
        ("public <a> = /x/ hello;", "3:14", "/x/ is no weight", "/2.5/"),
        ("public <a> = hello /2/ you;", "3:20", "a weight in the middle", "first"),
        ("public <a> = <b;", "3:14", "this rule name has no end", '">"'),
        ("public <a> = hello\npublic <b> = hi;", "4:1", 'expected ";"', "end the rule"),
        ("public <a> = <colr>;\n<color> = red;", "3:14", "no rule <colr>", '"color"'),
        ("public <a> = <a> x | x;", "3:1", "<a> leads back to itself", "end of the rule"),
        ("public <a> = [x] <b>;\n<b> = <a> y | y;", "3:1", "leads back", "use * or +"),
        ("public <a> = x <a>;", "3:1", "can never be said", "words only"),
        ("<a> = hello;", "1:1", "no public rule", 'write "public"'),
        ("public <a> = [<NULL>];", "3:1", "the public rules hold no word", "words"),
        ("public <a> = x;\n<a> = y;", "4:1", "<a> is already defined in line 3", "rename"),
        ("import <nowhere.x>;\npublic <a> = x;", "3:1", 'no grammar "nowhere"', "nowhere.jsgf"),
        ("import <x>;\npublic <a> = x;", "3:8", "expected a rule of another", "import <grammar"),
    ],
)
def test_a_mistake_has_its_place_and_what_to_do(write, rules, place, what, remedy):
    path = write(rules)

    with pytest.raises(AuthoringError) as caught:
        load_grammar(path)

    assert str(caught.value).startswith(f"{path}:{place}: ")
    assert what in caught.value.what
    assert remedy in caught.value.remedy


def test_reading_goes_on_after_a_mistake(write):
    path = write("public <a> = (x;\npublic <b> = y;\n<c> = | z;\npublic <d> = y z;\n")

    grammar, errors = read_grammar(path)

    assert [error.place.line for error in errors] == [3, 5]
    assert grammar.public_rules == ("b", "d")


def test_a_missing_header_is_told(tmp_path):
    path = tmp_path / "a.jsgf"
    path.write_text("grammar a;\npublic <a> = x;\n")

    with pytest.raises(AuthoringError, match=r"a\.jsgf:1:1: the header is missing"):
        load_grammar(path)


def test_imports_bring_public_rules_of_other_files(write):
    write("public <number> = <digit> {n=$d};\n<digit> = one {d=1} | two {d=2};", "numbers")
    write("public <color> = red {c=red};\npublic <secret> = dark;", "colors")
    path = write(
        "import <numbers.number>;\nimport <colors.*>;\n"
        "public <a> = <number> <color> | <colors.secret>;\n<digit> = nine;"
    )

    grammar = load_grammar(path)

    assert grammar.public_rules == ("a",)
    assert parse(grammar, "two red").tags == {"n": 2.0, "c": "red"}
    assert parse(grammar, "dark") is not None
    assert parse(grammar, "nine red") is None


def test_files_may_import_each_other(write):
    write("import <test.a>;\npublic <b> = x [<a>];", "other")
    path = write("import <other.b>;\npublic <a> = y [<b>];")

    assert parse(load_grammar(path), "y x y x").rule == "a"


def test_an_import_of_a_missing_rule_says_what_is_there(write):
    write("public <number> = one;", "numbers")
    path = write("import <numbers.numbr>;\npublic <a> = <numbr>;")

    with pytest.raises(AuthoringError, match=r'no public rule <numbr> - did you mean "number"'):
        load_grammar(path)


def test_the_header_names_the_encoding(tmp_path):
    path = tmp_path / "a.jsgf"
    text = "#JSGF V1.0 ISO-8859-1 de;\ngrammar a;\npublic <a> = vorwärts;\n"
    path.write_bytes(text.encode("latin-1"))
    assert load_grammar(path).words() == {"vorwärts"}

    path.write_bytes(text.replace("ISO-8859-1", "UTF-9").encode())
    with pytest.raises(AuthoringError, match='unknown encoding "UTF-9"'):
        load_grammar(path)

    path.write_bytes(text.replace("ISO-8859-1", "UTF-8").encode("latin-1"))
    with pytest.raises(AuthoringError, match=r"a\.jsgf:3:\d+: not UTF-8"):
        load_grammar(path)


def test_what_is_no_grammar_file_is_refused(tmp_path):
    with pytest.raises(HriError, match="no such grammar"):
        load_grammar(tmp_path)
    path = tmp_path / "large.jsgf"
    path.write_bytes(b" " * (LARGEST_FILE + 1))
    with pytest.raises(HriError, match="too many"):
        load_grammar(path)


def test_deep_nesting_is_refused_with_a_place(write):
    path = write("public <a> = " + "(" * 5000 + "x" + ")" * 5000 + ";")

    with pytest.raises(AuthoringError, match="nested deeper"):
        load_grammar(path)


def test_a_long_chain_of_rules_is_no_trouble(write):
    links = "".join(f"<r{n}> = <r{n + 1}>;\n" for n in range(3000))
    grammar = load_grammar(write(f"public <a> = <r0>;\n{links}<r3000> = end;"))

    assert parse(grammar, "end").rule == "a"


PIECES = 'public <a> <b> = ; | ( ) [ ] * + {x=1} {x {} hello "hi" "hi /2/ / // /* */ < >'


@given(st.lists(st.sampled_from(PIECES.split()), max_size=30))
@settings(max_examples=200, deadline=None)
def test_no_text_whatever_crashes_the_reader(pieces):
    document = read_jsgf("#JSGF V1.0;\ngrammar t;\n" + " ".join(pieces), Path("t.jsgf"))

    for error in document.errors:
        assert error.place.line >= 1
        assert error.place.column >= 1
