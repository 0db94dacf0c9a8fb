from __future__ import annotations

import dataclasses
import os
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.reading import LARGEST_FILE
from hri.speech.grammar import analysis, load_grammar, read_grammar
from hri.speech.grammar.expressions import (
    Alternative,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    SourceSpan,
    Tagged,
    Token,
    spell_tagged,
)
from hri.speech.grammar.jsgf import (
    EXTENDS,
    MOST_ERRORS,
    Document,
    RuleDefinition,
    read_jsgf,
)
from hri.speech.grammar.matching import parse
from hri.speech.grammar.name_lists import read_names
from hri.speech.grammar.tags import (
    LONGEST_VALUE,
    Reference,
    TagEntry,
    Template,
    evaluate,
    read_entries,
    spell_tags,
)

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
    assert document.rules[0].doc.text == "Says hello. In two lines."
    assert document.rules[0].expression.items[0].weights == (2.5, 1.0, 1.0)
    assert (document.rules[0].span.line, document.rules[0].span.column) == (9, 1)


@pytest.mark.parametrize(
    ("rules", "place", "what", "remedy"),
    [
        ("public <a> = hello", "3:19", '<a> has no ";"', 'write ";" here'),
        ("public <a> = hello {x} )", "3:24", 'this ")" has no "("', "take it out"),
        ("import <numbers.small>\npublic <a> = hello;", "3:23", 'this import has no ";"', "here"),
        ("# hello\npublic <a> = hello;", "3:1", '"#" begins no comment', "//"),
        ("public <a> = hello; # hello", "3:21", '"#" begins no comment', "//"),
        ("public <a> = hello # or\n | hi;", "3:20", '"#" begins no comment', "//"),
        ("public <a> = words $foo more;", "3:20", '"$" stands in tags only', "write <name>"),
        (
            "public <a> = wait {s=$dration};",
            "3:14",
            "no tag has the name $dration",
            "set it before",
        ),
        (
            "public <a> = <b> {s=$dration};\n<b> = x {duration=1};",
            "3:14",
            "no tag has the name $dration",
            'did you mean "duration"?',
        ),
        ("public <a> = wait <small>;", "3:19", "no rule <small>", "import <numbers.small>;"),
        ("public <a> = (hello;", "3:20", 'expected ")"', 'close the "(" of line 3, column 14'),
        ("public <a> = [hello;", "3:20", 'expected "]"', "column 14"),
        ("public <a> = ;", "3:14", "expected words", "<NULL>"),
        ("public <a> = hello | ;", "3:22", "expected words", "<NULL>"),
        ("pubic <a> = hello;", "3:1", "expected a rule", 'did you mean "public"?'),
        ("public <a> hello;", "3:12", 'expected "="', 'write "="'),
        ("public <a b> = hello;", "3:8", "<a b> is not a rule name", "write <a_b>"),
        ("public <a> = hello {n=;", "3:20", "this tag has no end", '"}"'),
        (
            "public <a> = very*+ good;",
            "3:19",
            '"+" stands behind another repeat',
            "for at least one",
        ),
        (
            "public <a> = (so good)++;",
            "3:24",
            '"+" stands behind another repeat',
            "for at least one",
        ),
        ('public <a> = "hello;', "3:14", "this quote has no end", "quote"),
        ("public <a> = /x/ hello;", "3:14", "/x/ is not a weight", "/2.5/"),
        ("public <a> = hello /2/ you;", "3:20", "a weight in the middle", "first"),
        ("public <a> = <b;", "3:14", "this rule name has no end", '">"'),
        ("public <a> = hello\npublic <b> = hi;", "3:19", '<a> has no ";"', 'write ";" here'),
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


@pytest.mark.parametrize(
    ("rules", "place", "what", "remedy"),
    [
        ("public <a> = x {light=very bright};", "3:28", '"bright" stands', 'light="very bri'),
        ("public <a> = x {n==3};", "3:17", "cannot read the tag", "{name=value}"),
        ("public <a> = x {t=1 =};", "3:21", "cannot read the tag", "{name=value}"),
        ("public <a> = x {t=$};", "3:19", "$ names no tag", "{name=value}"),
        ("public <a> = x {};", "3:16", "the tag is empty", "{name=value}"),
        ("public <a> = x {play()} | y {stop()};", "3:17", "(and 1 more)", "{name=value}"),
        ("public <a> = /2/ x | y;", "3:22", "only some have a weight", "a weight before each"),
        ("public <a> = (x | /2/ y | z);", "3:15", "only some have a weight", "before none"),
    ],
)
def test_what_is_odd_is_told_and_costs_nothing(write, rules, place, what, remedy):
    path = write(rules)
    grammar = load_grammar(path)

    (odd,) = grammar.warnings
    assert str(odd).startswith(f"{path}:{place}: ")
    assert what in odd.what
    assert remedy in odd.remedy
    assert parse(grammar, "x")


@pytest.mark.parametrize(
    ("tag", "text"),
    [
        ("ACTION:open the door", "ACTION:open the door"),
        ("play()", "play()"),
        ('"hello there"', '"hello there"'),
        ("this.item = $;", "this.item = $;"),
        ('this.x = new Array();\n  this.y.add("a");', 'this.x = new Array(); this.y.add("a");'),
        ('\\{"intent": "play"\\}', '{"intent": "play"}'),
        ('{"intent": "play"}', '{"intent": "play"}'),
        ("if (a) { go(); } else { stop(); }", "if (a) { go(); } else { stop(); }"),
        ("3", "3"),
        ("go!", "go!"),
        ("\u64ad\u653e", "\u64ad\u653e"),
    ],
)
def test_a_tag_of_another_program_is_kept_as_a_text(write, tag, text):
    grammar = load_grammar(write(f"public <a> = go {{{tag}}} now;"))
    tags = parse(grammar, "go now").tags

    assert tags == {"tag": (text,)}
    assert evaluate([read_entries(spell_tags(tags))]) == tags
    assert len(grammar.warnings) == 1


def test_a_tag_beyond_its_limit_ends_there(write):
    grammar = load_grammar(write(f"public <a> = go {{{'play();' * 1000}}};"))
    assert parse(grammar, "go").tags == {"tag": (("play();" * 1000)[:LONGEST_VALUE],)}


def test_texts_of_several_tags_are_collected(write):
    grammar = load_grammar(
        write("public <a> = [<b>] go {run!} [fast {n=2}];\n<b> = please {pls!};")
    )

    assert parse(grammar, "please go fast").tags == {"tag": ("pls!", "run!"), "n": 2.0}


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

    path.write_bytes(text.replace("ISO-8859-1", "UTF-9").encode("latin-1"))
    with pytest.raises(AuthoringError, match='unknown encoding "UTF-9"'):
        load_grammar(path)

    path.write_bytes(text.replace("ISO-8859-1", "UTF-8").encode("latin-1"))
    with pytest.raises(AuthoringError, match=r"a\.jsgf:3:\d+: not UTF-8"):
        load_grammar(path)


@pytest.mark.parametrize("name", ["turn on", "NULL", "a.b"])
def test_a_wrong_name_of_a_rule_is_told_once(write, name):
    _, errors = read_grammar(write(f"public <{name}> = go on;\npublic <b> = hi;"))
    assert len(errors) == 1


def test_what_is_no_grammar_file_is_refused(tmp_path):
    with pytest.raises(HriError, match="no such grammar"):
        load_grammar(tmp_path / "none.jsgf")
    os.mkfifo(tmp_path / "pipe.jsgf")
    with pytest.raises(HriError, match="this grammar is not a regular file"):
        load_grammar(tmp_path / "pipe.jsgf")
    path = tmp_path / "large.jsgf"
    path.write_bytes(b" " * (LARGEST_FILE + 1))
    with pytest.raises(HriError, match="too large"):
        load_grammar(path)


def test_deep_nesting_is_refused_with_a_place(write):
    path = write("public <a> = " + "(" * 5000 + "x" + ")" * 5000 + ";")

    with pytest.raises(AuthoringError, match="nested deeper"):
        load_grammar(path)


def test_a_long_chain_of_rules_is_no_trouble(write):
    links = "".join(f"<r{n}> = <r{n + 1}>;\n" for n in range(3000))
    grammar = load_grammar(write(f"public <a> = <r0>;\n{links}<r3000> = end;"))

    assert parse(grammar, "end").rule == "a"


def test_doc_comments_hold_marks_and_examples(write):
    path = write(
        "/** Toward whoever speaks.\n *  @careful @interrupts\n"
        " *  @example come\n *    closer\n *  @see <test.b>\n *  @carefull\n */\n"
        "public <a> = come closer;\n/** robin@example.org */\npublic <b> = x;\n"
    )
    grammar = load_grammar(path)
    rule = grammar.rules["a"]

    assert rule.doc == "Toward whoever speaks."
    assert rule.marks == {"careful", "interrupts"}
    assert rule.examples == ("come closer",)
    assert [tag.name for tag in rule.doc_tags][-2:] == ["see", "carefull"]
    assert rule.doc_tags[-1].span[:2] == (8, 5)
    assert grammar.marked("careful") == {"a"}
    assert grammar.rules["b"].doc == "robin@example.org"


@pytest.mark.parametrize(
    "text",
    [
        "public <a> = " + "(" * 2000 + "x" + ")" * 2000 + ";",
        "public <a> = x" + "*{a}" * 900 + ";",
        "public <a> = x" + "{a}" * 900 + ";",
        '"\\' * 60_000,
        "{\\" * 60_000,
        "/*" * 60_000,
        "/** @x " * 30_000,
        "/** a" + " " * 1_000_000 + "b */ x",
        "<a" * 60_000,
        "<a> = x;" * 80_000,
        "x " * 310_000,
    ],
    ids=lambda text: text[:12],
)
def test_hostile_text_is_refused_in_no_time(text):
    start = time.process_time()
    document = read_jsgf("#JSGF V1.0;\ngrammar t;\n" + text, Path("t.jsgf"))

    assert 1 <= len(document.errors) <= MOST_ERRORS + 1
    assert time.process_time() - start < 5.0


def test_long_rules_are_no_trouble(write):
    words = " ".join(f"w{n}" for n in range(5000))
    wide = " | ".join(f"<r{n}>" for n in range(5000))
    rules = "".join(f"<r{n}> = v{n};\n" for n in range(5000))
    start = time.process_time()
    grammar = load_grammar(write(f"public <a> = {words};\npublic <b> = {wide};\n{rules}"))

    assert len(grammar.words()) == 10_000
    assert time.process_time() - start < 4.0


def test_a_list_of_too_many_names_is_told_once(tmp_path, monkeypatch):
    monkeypatch.setattr("hri.speech.grammar.name_lists.MOST_NAMES", 3)
    path = tmp_path / "names.txt"
    path.write_text("\n".join("abcdefg"))

    (error,) = read_names(path, "name")[1]
    assert str(error) == f"{path}:4:1: more than 3 names - shorten the list"


def test_a_list_of_ten_thousand_names_is_read_at_once(tmp_path, write):
    lines = (f"name{n} surname{n % 97} = id{n}" for n in range(10_000))
    (tmp_path / "names.txt").write_text("\n".join(lines))
    path = write('import "names.txt" as <who>;\npublic <a> = call <who>;')

    start = time.process_time()
    grammar, errors = read_grammar(path)
    assert time.process_time() - start < 1.0
    assert not errors
    assert len(grammar.rules["who"].expression.choices) == 10_000


PIECES = [
    "public",
    "<a>",
    "<b>",
    "=",
    ";",
    "|",
    "(",
    ")",
    "[",
    "]",
    "*",
    "+",
    "{x=1}",
    "{x",
    "{}",
    "hello",
    '"hi"',
    '"hi',
    "/2/",
    "/",
    "//",
    "/*",
    "*/",
    "<",
    ">",
    "import",
    "as",
    "<c.*>",
    '"f.txt"',
    "grammar",
    '{t="$a-$b"}',
    "{n*=2;m=$n}",
    "/**",
    "@careful",
    "\\",
    "<NULL>",
    "<VOID>",
    "<c.d>",
    ".",
    "o'clock",
]


@given(st.lists(st.sampled_from(PIECES) | st.text(max_size=5), max_size=30))
@settings(max_examples=300, deadline=None)
def test_no_text_whatever_crashes_the_reader(pieces):
    document = read_jsgf("#JSGF V1.0;\ngrammar t;\n" + " ".join(pieces), Path("t.jsgf"))

    for error in document.errors:
        assert error.place.line >= 1
        assert error.place.column >= 1


@given(st.lists(st.sampled_from(PIECES) | st.text(max_size=5), max_size=20))
@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_no_file_whatever_crashes_the_loader(tmp_path_factory, pieces):
    path = tmp_path_factory.getbasetemp() / "any.jsgf"
    text = "#JSGF V1.0;\ngrammar any;\npublic <a> = x;\n" + " ".join(pieces)
    path.write_text(text, encoding="utf-8", errors="replace")

    grammar, errors = read_grammar(path)

    errors += analysis.errors(grammar)
    if not errors:
        assert len(list(grammar.sentences(20))) >= 1


SPAN = SourceSpan(1, 1, 1, 1)
VALUES = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False),
    st.booleans(),
    st.text(st.characters(codec="utf-8", exclude_characters='"'), max_size=8),
)
NAMES = st.sampled_from(["n", "place", "far_away", "x.y"])
ENTRIES = st.one_of(
    st.builds(TagEntry, NAMES, st.just("="), VALUES),
    st.builds(TagEntry, NAMES, st.sampled_from(["=", "+=", "*="]), st.builds(Reference, NAMES)),
    st.builds(TagEntry, NAMES, st.just("="), st.just(Template("$n of $place, $$5"))),
    st.builds(TagEntry, NAMES, st.sampled_from(["+=", "*="]), st.floats(-1e6, 1e6)),
)
EXPRESSIONS = st.recursive(
    st.sampled_from(["go", "o'clock", "größer", "and/or", "at|t", 'a"b', "import"]).map(
        lambda word: Token(word, SPAN)
    )
    | st.sampled_from(["a", "b", "c.d"]).map(lambda name: RuleReference(name, SPAN))
    | st.sampled_from([Sequence((), SPAN), Alternative((), (), SPAN)]),
    lambda below: st.one_of(
        st.lists(below, min_size=2, max_size=3).map(lambda items: Sequence(tuple(items), SPAN)),
        st.lists(st.tuples(below, st.floats(0, 1e9)), min_size=2, max_size=3).map(
            lambda pairs: Alternative(*map(tuple, zip(*pairs, strict=True)), SPAN)
        ),
        st.builds(Optional, below, st.just(SPAN)),
        st.builds(Repeat, below, st.integers(0, 1), st.just(SPAN)).filter(
            lambda node: not isinstance(node.item, Repeat)
        ),
        st.builds(
            Tagged, below, st.lists(ENTRIES, min_size=1, max_size=3).map(tuple), st.just(SPAN)
        ),
    ),
    max_leaves=8,
)


def without_spans(node):
    match node:
        case SourceSpan():
            return None
        case tuple():
            return tuple(map(without_spans, node))
        case _ if dataclasses.is_dataclass(node):
            values = (getattr(node, field.name) for field in dataclasses.fields(node))
            return type(node), *map(without_spans, values)
        case _:
            return node


def write_jsgf(document: Document) -> str:
    """The text of a document, without its comments; `read_jsgf` makes the same rules of it."""
    header = " ".join(filter(None, ("#JSGF V1.0", document.encoding, document.locale)))
    lines = [f"{header};"]
    if document.extends:
        lines.append(f"/** {' '.join(f'@{EXTENDS} {e.grammar}' for e in document.extends)} */")
    lines += [f"grammar {document.name};"]
    lines += [f"import <{use.grammar}.{use.rule}>;" for use in document.imports]
    lines += [f'import "{use.file}" as <{use.name}>;' for use in document.name_lists]
    for rule in document.rules:
        public = "public " if rule.is_public else ""
        lines.append(f"{public}<{rule.name}> = {spell_tagged(rule.expression)};")
    return "\n".join(lines) + "\n"


@given(EXPRESSIONS)
@settings(max_examples=200, deadline=None)
def test_what_is_written_is_read_back_the_same(expression):
    rule = RuleDefinition("a", expression, True, SPAN)
    document = Document(Path("t.jsgf"), "t", "UTF-8", "en", rules=[rule])

    text = write_jsgf(document)
    again = read_jsgf(text, Path("t.jsgf"))

    assert again.errors == []
    assert without_spans(again.rules[0].expression) == without_spans(expression)
    assert write_jsgf(again) == text


def test_the_shipped_grammars_are_written_and_read_back():
    for path in sorted((Path(__file__).parents[3] / "grammars").glob("*.jsgf")):
        document = read_jsgf(path.read_text(), path)
        again = read_jsgf(write_jsgf(document), path)

        assert again.errors == []
        assert [without_spans(rule.expression) for rule in again.rules] == [
            without_spans(rule.expression) for rule in document.rules
        ]
        assert (again.imports == []) == (document.imports == [])
