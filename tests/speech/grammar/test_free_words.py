"""`<any>` stands for words that nobody listed, and @anywhere for those around a phrase."""

import json
import string

import pytest
from hypothesis import given, strategies as st

from hri.cli.main import main
from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.expressions import spell_tagged
from hri.speech.grammar.lint.linter import check
from hri.speech.grammar.loader import read_grammar
from hri.speech.grammar.matching import meanings, parses, refusal
from hri.speech.grammar.words import MOST_FREE

TALK = """
/** @anywhere */
public <leave> = (goodbye | bye | see you later) {leave=true};
/** @anywhere */
public <timer> = set a timer [for <n> minutes];
<n> = two {n=2} | three {n=3};
public <name> = my name is <any>;
public <stop> = stop;
/** @careful */
public <go> = go [forward] [<n> meters];
"""
OTHERS = st.lists(st.text(string.ascii_lowercase, min_size=1, max_size=8), max_size=12)


@pytest.fixture(scope="module")
def talk(tmp_path_factory):
    path = tmp_path_factory.mktemp("talk") / "talk.jsgf"
    path.write_text(f"#JSGF V1.0;\ngrammar talk;\n{TALK}")
    return load_grammar(path)


@pytest.mark.parametrize(
    ("text", "rule", "free"),
    [
        ("bye", "leave", 0),
        ("i have to run now so bye for today", "leave", 8),
        ("well see you later then", "leave", 2),
        ("please set a timer for 2 minutes thanks", "timer", 2),
        ("set a timer for 7 minutes", "timer", 3),
        ("my name is Anna Maria", "name", 2),
    ],
)
def test_a_phrase_counts_among_other_words(talk, text, rule, free):
    found = parse(talk, text)
    assert (found.rule, len(found.free)) == (rule, free)


@pytest.mark.parametrize("text", ["please stop", "now go forward", "my name is", "go two bananas"])
def test_other_words_are_taken_nowhere_else(talk, text):
    assert parse(talk, text) is None


def test_a_sentence_without_free_words_wins_though_it_comes_later(write):
    grammar = load_grammar(
        write(
            "/** @anywhere */\npublic <a> = turn;\npublic <b> = turn left;\npublic <c> = <any> go;"
        )
    )
    assert parse(grammar, "turn left").rule == "b"
    assert parse(grammar, "turn right").rule == "a"
    assert parse(grammar, "turn and go").rule == "a"
    assert [reading.rule for reading in parses(grammar, "turn left")] == ["b"]
    assert [reading.rule for reading in parses(grammar, "turn go")] == ["a", "c"]


def test_words_that_the_grammar_has_are_not_offered_as_free_ones(talk):
    assert refusal(talk, "go two").expected == ("meters",)
    assert refusal(talk, "my name is").expected == ()
    assert refusal(talk, "so bye for today") is None


@given(OTHERS, st.sampled_from(["see you later", "set a timer for two minutes"]), OTHERS)
def test_whatever_is_around_a_phrase_its_tags_are_the_same(talk, before, phrase, behind):
    found = parse(talk, " ".join([*before, phrase, *behind]))
    assert found is not None
    if found.rule == parse(talk, phrase).rule and not {*before, *behind} & talk.words():
        assert found.tags == parse(talk, phrase).tags
        others = (n for n, w in enumerate(found.text.split()) if w not in phrase.split())
        assert found.free == tuple(others)


def test_a_rule_named_any_is_that_rule(write):
    grammar = load_grammar(write("public <a> = take <any>;\n<any> = all | none;"))
    assert parse(grammar, "take all") is not None
    assert parse(grammar, "take two") is None


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("public <a> = <any>;", "<a> can be said with <any> alone"),
        ("public <a> = [please] <any> {x};", "<a> can be said with <any> alone"),
        ("public <a> = <b> | stop;\n<b> = <any>+;", "<a> can be said with <any> alone"),
        ("/** @anywhere */\npublic <a> = [go];", "<a> can be said with <any> alone"),
        (
            "/** @careful */\npublic <a> = go to <b>;\n<b> = the <any>;",
            "<a> moves the robot, so none of its words may be free",
        ),
        (
            "/** @careful\n @anywhere */\npublic <a> = go;",
            "<a> moves the robot, so it may not count @anywhere",
        ),
    ],
)
def test_what_would_take_everything_and_free_orders_to_move_are_errors(write, text, error):
    grammar, errors = read_grammar(write(text))
    assert not errors
    findings = check(grammar)
    assert [finding.severity for finding in findings] == ["error"]
    assert error in str(findings[0])


def test_free_words_are_shown_and_left_out_of_what_is_spoken_for_tests(talk):
    assert "my name is <any>" in list(talk.sentences(100))
    assert parse(talk, "my name is <any>").free == (3,)
    assert not any("<any>" in sentence for sentence in talk.sample(100))
    assert "name" not in talk.flat_jsgf()


def test_the_command_shows_which_words_are_free(talk, capsys):
    main(["grammar", "parse", str(talk.path), "so bye now"])
    assert "<leave> (so) bye (now)" in capsys.readouterr().out
    main(["grammar", "parse", str(talk.path), "so bye now", "--json"])
    assert json.loads(capsys.readouterr().out)["free"] == [0, 2]


def test_no_finding_speaks_of_free_words_as_of_a_word(talk):
    assert not [found for found in check(talk) if "<any>" in str(found)]


@pytest.mark.parametrize(
    ("free", "fits"),
    [("<any 2>", {2}), ("<any 2-4>", {2, 3, 4}), ("<any  1 - 1 >", {1}), ("/3/ <any 2> | x", {2})],
)
def test_an_author_says_how_many_words_are_free(write, free, fits):
    grammar = load_grammar(write(f"public <name> = my name is ({free});"))
    said = {count: parse(grammar, "my name is" + " anna" * count) for count in range(6)}
    assert {count for count, found in said.items() if found is not None} == fits
    for sentence in grammar.sentences(10):
        assert parse(grammar, sentence) is not None, sentence


def test_without_a_number_free_words_end_somewhere(talk):
    for count in (MOST_FREE, MOST_FREE + 1):
        others = "word " * count
        is_short = count == MOST_FREE
        assert (parse(talk, f"my name is {others}") is not None) is is_short
        assert (parse(talk, f"{others} see you later") is not None) is is_short
        assert (parse(talk, f"see you later {others}") is not None) is is_short


@pytest.mark.parametrize("free", ["<any 0>", "<any 0-2>", "<any 3-2>", "<any 51>", "<any x>"])
def test_a_number_of_words_that_cannot_be_has_its_place_and_a_remedy(write, free):
    _, errors = read_grammar(write(f"public <name> = my name is {free};"))
    assert [str(error).partition(": ")[2] for error in errors] == [
        f"{free} is not a number of words, 1 to 50"
        " - write <any 2> for two words, <any 1-3> for one to three"
    ]
    assert errors[0].place.column == len("public <name> = my name is ") + 1


def test_a_number_of_words_is_written_as_it_was_read_and_stands_in_the_graph(write):
    grammar = load_grammar(write("public <a> = a <any> b <any 2> c <any 2-5> d;"))
    assert spell_tagged(grammar.rules["a"].expression) == "a <any> b <any 2> c <any 2-5> d"
    assert {"<any>", "<any 2>", "<any 2-5>"} < {*grammar.graph().words}


TURNS = """
/** @anywhere */
public <turn> = turn (left {side=left} | right {side=right});
/** @anywhere */
public <bye> = bye;
"""


def test_phrases_that_are_equally_specific_are_all_meanings(write):
    grammar = load_grammar(write(TURNS))
    both = meanings(grammar, "well turn left and then turn right")
    assert [reading.tags["side"] for reading in both] == ["right", "left"]
    assert len(meanings(grammar, "turn left or turn left")) == 1
    assert [reading.rule for reading in meanings(grammar, "turn left and bye")] == ["turn"]


def test_the_commands_show_both_meanings(write, tmp_path, capsys):
    path = write(TURNS)
    main(["grammar", "parse", str(path), "turn left then turn right"])
    told = capsys.readouterr().out
    assert "2 meanings; all are equally specific, so the robot asks" in told
    assert "turn {side=left}" in told
    assert "turn {side=right}" in told
    lines = tmp_path / "lines.txt"
    lines.write_text("+ turn left then turn right => turn: side=left\n+ well turn left\n")
    assert main(["grammar", "test", str(lines), "--grammar", str(path)]) == 1
    told = capsys.readouterr().out
    assert "means turn: side=right or turn: side=left, which are equally specific" in told
    assert "1 of 2 sentences as expected" in told


def test_the_words_around_a_phrase_stay_as_they_were_typed(write):
    rules = "/** @anywhere */ public <leave> = bye; public <tired> = i've had enough of two;"
    grammar = load_grammar(write(rules))

    assert parse(grammar, "i have to run so bye for now").text == "i have to run so bye for now"
    assert parse(grammar, "i have had enough of 2").text == "i've had enough of two"


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("don't tell me what time it is", "told_not_to"),
        ("please do not tell me what time it is", "told_not_to"),
        ("robot never tell me what your name is", ""),
        ("don't you dare tell me what time it is", "told_not_to"),
        ("don't spin around", "told_not_to"),
        ("do not go forward", "told_not_to"),
        ("i don't know what time it is", "time"),
        ("don't worry but what time is it", "time"),
        ("don't you know what time it is", "time"),
    ],
)
def test_who_says_not_to_gives_no_order(text, rule):
    found = parse(load_grammar("companion"), text)
    assert (found.rule if found else "") == rule


def test_free_words_of_a_listed_rule_are_for_the_keyboard(write):
    rules = """
    /** @anywhere
     *  @listed
     */
    public <age> = how old are you | what age is <any 1-2>;
    public <call> = call <any>;
    """
    grammar = load_grammar(write(rules))

    for text in ("how old are you", "so how old are you today", "what age is my neighbor"):
        assert parse(grammar, text).rule == "age"
    graph = grammar.graph()
    assert set(graph.words) == {"how", "old", "are", "you", "call", "<any>"}
    free = [
        target
        for label, target in zip(graph.labels, graph.targets, strict=True)
        if graph.words[label] == "<any>"
    ]
    assert free == [graph.final]
