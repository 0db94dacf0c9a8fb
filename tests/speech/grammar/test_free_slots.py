"""`<name.spoken>` stands for words that nobody listed, and they are a value."""

import json
import re
import string
import time

import pytest
from hypothesis import example, given, strategies as st

from hri.cli.main import main
from hri.hal.word_graph import MOST_LETTERS, SpokenSlot
from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.expansion import ShownWays, count_sentences, random_sentences, sentences
from hri.speech.grammar.expressions import spell_tagged
from hri.speech.grammar.lint.linter import check
from hri.speech.grammar.loader import read_grammar
from hri.speech.grammar.matching import meanings, parses
from hri.speech.grammar.merging import with_interrupts_of, with_parts_of
from hri.speech.grammar.sure_tags import sure_tags
from hri.speech.grammar.words import as_typed, free_words, slot_name, typed

TALK = """
import "names.txt" as <name.spoken>;
/** @spoken name 2-20 letters */
public <introduce> = (my name is | i am called) <name.spoken 1-2> [please];
public <call> = call <friend.spoken> [now];
<friend> = ann {friend=1} | uncle ben {friend=2};
public <put> = put <what.spoken> and <where.spoken>;
public <count> = count [to] <words.spoken 2> {first=$words} then <last.spoken 1>;
"""
NAMES = "# Whom we know.\nAnna\nMary Ann\nJean-Luc\nanna\n"


@pytest.fixture(scope="module")
def talk(tmp_path_factory):
    folder = tmp_path_factory.mktemp("talk")
    (folder / "names.txt").write_text(NAMES)
    path = folder / "talk.jsgf"
    path.write_text(f"#JSGF V1.0;\ngrammar talk;\n{TALK}")
    return load_grammar(path)


@pytest.mark.parametrize(
    ("written", "counts", "name"),
    [
        ("<name.spoken>", (1, 3), "name"),
        ("<name.spoken 1-2>", (1, 2), "name"),
        ("<my_name2.spoken  4 - 5 >", (4, 5), "my_name2"),
        ("<name.spoken 2>", (2, 2), "name"),
        ("<any>", (1, 12), ""),
        ("<any 2>", (2, 2), ""),
        ("<name.spokn>", None, ""),
        ("<2.spoken>", None, ""),
        ("name.spoken", None, ""),
    ],
)
def test_the_written_form_says_how_many_words_of_which_slot(written, counts, name):
    assert (free_words(written), slot_name(written)) == (counts, name)


@pytest.mark.parametrize(
    ("text", "tags"),
    [
        ("my name is anna", {"name": "anna"}),
        ("My name is McDonald.", {"name": "McDonald"}),
        ("my name is Jean-Luc Picard, please", {"name": "Jean-Luc Picard"}),
        ("My name's O\N{RIGHT SINGLE QUOTATION MARK}Neil!", {"name": "O'Neil"}),
        ("I AM CALLED  Mary   ANN", {"name": "Mary ANN"}),
        ("i'm called (Zoë)", {"name": "Zoë"}),
        ("my name is R2D2", {"name": "R2D2"}),
        ("call ann", {"friend": 1.0}),
        ("call Uncle Ben now", {"friend": 2.0}),
        ("call Siobhan now", {"friend": "Siobhan"}),
        ("put the $1,000 note and the drawer", {"what": "the $1,000 note", "where": "the drawer"}),
        ("put 1,000 kg and 2.5 m", {"what": "1,000 kg", "where": "2.5 m"}),
        ("put salt and pepper and here", {"what": "salt", "where": "pepper and here"}),
        ("count to one two then Three", {"first": "one two", "last": "Three"}),
    ],
)
def test_the_value_is_what_was_typed(talk, text, tags):
    assert parse(talk, text).tags == tags


@pytest.mark.parametrize(
    "text",
    [
        "my name is",
        "my name is x",  # one letter
        "my name is Anna Maria Theresa",  # three words
        "my name is Maximiliana Bartholomea",  # more than 20 letters
        "my name is Anna today now please",
        "call",
        "count one then three",
    ],
)
def test_what_does_not_fit_is_not_taken(talk, text):
    assert parse(talk, text) is None


def test_words_of_a_slot_are_free_and_have_their_places(talk):
    found = parse(talk, "Put THE cup and here")
    assert (found.text, found.as_typed) == ("put the cup and here", "put THE cup and here")
    assert (found.free, found.around) == ((1, 2, 4), ())
    places = [(slot.name, slot.text, slot.start, slot.end) for slot in found.slots]
    assert places == [("what", "THE cup", 1, 3), ("where", "here", 4, 5)]


def test_the_reading_with_fewest_free_words_wins(write):
    rules = "public <a> = my name is <name.spoken>;\npublic <b> = my name is robin;\n"
    rules += "public <c> = my name is <name.spoken> and <any>;"
    grammar = load_grammar(write(rules))
    assert [one.rule for one in parses(grammar, "my name is Robin")] == ["b"]
    assert parse(grammar, "my name is robin hood").rule == "a"
    assert parse(grammar, "my name is robin and more").rule == "c"


def test_readings_that_differ_only_in_the_words_of_slots_ask_no_question(talk):
    (meant,) = meanings(talk, "put a and b and c")
    assert meant.tags == {"what": "a", "where": "b and c"}


def test_a_slot_that_a_rule_has_twice_has_the_last_value(write):
    grammar = load_grammar(write("public <a> = from <x.spoken 1> to <x.spoken 1>;"))
    assert parse(grammar, "from here to There").tags == {"x": "There"}
    assert [slot.text for slot in parse(grammar, "from here to There").slots] == ["here", "There"]
    told = [str(finding) for finding in check(grammar)]
    assert len(told) == 1
    assert 'the second "x" replaces the first' in told[0]


def test_a_pattern_limits_a_slot(write):
    rules = '/** @spoken code 3-5 letters like "[a-c]*?"*/ public <a> = my code is <code.spoken 1>;'
    grammar = load_grammar(write(rules))
    fits = {text: parse(grammar, f"my code is {text}") for text in ("Abc", "d12", "ab", "abcdef")}
    assert {text for text, found in fits.items() if found} == {"Abc"}
    (slot,) = grammar.graph().slots.values()
    assert (slot.letters, slot.like) == ((3, 5), "[a-c]*?")


def test_the_word_graph_knows_the_slots(talk):
    graph = talk.graph()
    assert graph.slots == {
        "<name.spoken 1-2>": SpokenSlot("name", 1, 2, ("anna", "mary ann", "jean-luc"), (2, 20)),
        "<friend.spoken>": SpokenSlot("friend", 1, 3),
        "<what.spoken>": SpokenSlot("what", 1, 3),
        "<where.spoken>": SpokenSlot("where", 1, 3),
        "<words.spoken 2>": SpokenSlot("words", 2, 2),
        "<last.spoken 1>": SpokenSlot("last", 1, 1, (), (1, MOST_LETTERS)),
    }
    assert graph.slots.keys() < {*graph.words}
    assert "jean-luc" not in graph.words


def test_other_engines_do_not_know_them(talk):
    flat = talk.flat_jsgf()
    assert "name" not in flat
    assert "uncle ben" in flat
    assert {*talk.sample(100)} == {
        f"call {who}{now}" for who in ("ann", "uncle ben") for now in ("", " now")
    }


def test_its_tags_are_known_to_whoever_asks(talk):
    assert talk.tag_names("introduce") == {"name"}
    assert talk.tag_names("count") == {"first", "last"}
    assert sure_tags(talk.rules, "introduce") == {"name"}
    assert sure_tags(talk.rules, "call") == {"friend"}


def test_a_slot_is_written_as_it_was_read(talk):
    assert spell_tagged(talk.rules["count"].expression) == (
        "count [to] <words.spoken 2> {first=$words} then <last.spoken 1>"
    )
    assert spell_tagged(talk.rules["call"].expression) == (
        "call (<friend> | <friend.spoken>) [now]"
    )


# Where it comes from


def test_a_grammar_with_a_rule_of_that_name_means_the_rule(write):
    write("public <spoken> = aloud {aloud=true};", "name")
    assert parse(load_grammar(write("public <a> = read <name.spoken>;")), "read aloud").tags == {
        "aloud": True
    }
    write("public <aloud> = aloud;", "name")
    assert parse(load_grammar(write("public <a> = read <name.spoken>;")), "read on").tags == {
        "name": "on"
    }


def test_a_slot_may_have_the_name_of_a_grammar_of_the_house(write):
    grammar = load_grammar(write("public <a> = paint it <color.spoken 1>;"))
    assert parse(grammar, "paint it Mauve").tags == {"color": "Mauve"}
    assert not any(key.startswith("color") for key in grammar.rules)


def test_a_broken_grammar_of_that_name_does_not_matter(write, tmp_path):
    (tmp_path / "name.jsgf").write_bytes(b"\xff\xfe\x00")
    assert parse(load_grammar(write("public <a> = read <name.spoken>;")), "read on").tags == {
        "name": "on"
    }


def test_a_list_of_names_beside_it_is_what_is_listed(write, tmp_path):
    (tmp_path / "friends.txt").write_text("Robin Smith\nthe boss = Alex\n")
    rules = 'import "friends.txt" as <friend>;\npublic <call> = call <friend.spoken>;'
    grammar = load_grammar(write(rules))
    assert parse(grammar, "call the boss").tags == {"friend": "Alex"}
    assert parse(grammar, "call robin smith").tags == {"friend": "Robin Smith"}
    assert parse(grammar, "call Smith").tags == {"friend": "Smith"}
    assert not check(grammar)


def test_slots_lists_and_limits_come_with_what_is_imported_and_extended(write, tmp_path):
    (tmp_path / "names.txt").write_text("Anna\nBo\nC\n")
    rules = 'import "names.txt" as <name.spoken>;\n/** @spoken name 2-9 letters */\n'
    write(rules + "public <hello> = hello <name.spoken>;", "base")
    (tmp_path / "own.jsgf").write_text(
        "#JSGF V1.0;\n/** @extends base */ grammar own;\npublic <bye> = bye <name.spoken>;"
    )
    own = load_grammar(tmp_path / "own.jsgf")
    importing = load_grammar(write("import <base.hello>;\npublic <a> = oh <hello>;", "other"))
    for grammar, text in ((own, "hello"), (own, "bye"), (importing, "oh hello")):
        assert parse(grammar, f"{text} Zed").tags == {"name": "Zed"}
        assert parse(grammar, f"{text} Z") is None
        assert grammar.graph().slots["<name.spoken>"].known == ("anna", "bo")


def test_grammars_that_are_merged_keep_what_slots_usually_are(talk, write):
    other = load_grammar(write("/** @interrupts */ public <stop> = stop;"))
    for merged in (with_interrupts_of(talk, other), with_parts_of(other, talk)):
        assert merged.known["name"] == ("anna", "mary ann", "jean-luc")


def test_a_file_that_changes_is_read_again(write, tmp_path):
    path = write('import "names.txt" as <name.spoken>;\npublic <a> = hi <name.spoken>;')
    for name in ("anna", "bea"):
        (tmp_path / "names.txt").write_text(name)
        assert load_grammar(path).known == {"name": (name,)}


# What authors get wrong


@pytest.mark.parametrize(
    ("rules", "error"),
    [
        ("public <a> = hi <name.spokn>;", 'no rule <name.spokn> - did you mean "name.spoken"?'),
        (
            "public <a> = hi <name.spokn 1-2>;",
            '<name.spokn 1-2> is not a rule name - did you mean "name.spoken 1-2"?',
        ),
        (
            "public <a> = hi <color.spokan>;",
            '"color" has no public rule <spokan> - did you mean "color.spoken"?',
        ),
        (
            "public <a> = hi <name.spoken 3-1>;",
            "<name.spoken 3-1> is not a number of words, 1 to 50 - write <name.spoken 2> for"
            " two words, <name.spoken 1-3> for one to three",
        ),
        (
            "/** @careful */ public <a> = go to <name.spoken>;",
            "<a> moves the robot, so none of its words may be free - list the words, or take"
            " @careful out if it moves nothing",
        ),
        (
            "public <a> = [please] <name.spoken>;",
            "<a> can be said with <name.spoken> alone, so it takes whatever is said - write a"
            " word that must be said",
        ),
        (
            "/** @spoken name 12 */ public <a> = hi <name.spoken>;",
            '@spoken "name 12" does not say what may stand in a free slot - write @spoken name'
            ' 2-12 letters, like "mc*", without not, or all of them',
        ),
        (
            'import "gone.txt" as <name.spoken>;',
            'no list of names "gone.txt" - put it beside the grammar',
        ),
        (
            "public <a> = hi {who=$nam} <name.spoken>;",
            'no tag has the name $nam that who takes its value from - did you mean "name"?',
        ),
    ],
)
def test_mistakes_have_a_place_and_a_remedy(write, rules, error):
    grammar, errors = read_grammar(write(f"{rules} public <z> = zed;"))
    (told,) = map(str, errors or check(grammar))
    assert re.sub(r"^.*?:3:\d+: (error: )?", "", told) == error


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("anna = 1", "2:1: a free slot takes its value from what is said - write words only"),
        ("!!!", "2:1: no spoken words here - write words only"),
    ],
)
def test_a_list_of_a_slot_has_words_only(write, tmp_path, line, error):
    (tmp_path / "names.txt").write_text(f"bob\n{line}\n")
    rules = 'import "names.txt" as <name.spoken>;\npublic <a> = hi <name.spoken>;'
    _, errors = read_grammar(write(rules))
    assert [str(one).partition("names.txt:")[2] for one in errors] == [error]


def test_what_says_nothing_is_told(write, tmp_path):
    (tmp_path / "names.txt").write_text("anna\nmary ann\nx\n")
    rules = """import "names.txt" as <name.spoken>;
    import "names.txt" as <nobody.spoken>;
    /** @spoken nam 2-12 letters @spoken name 2-4 letters */
    public <a> = hi <name.spoken 1>;
    /** @spoken name 2-12 letters */
    public <b> = bye <name.spoken 1>;
    """
    grammar = load_grammar(write(rules))
    told = [str(finding).partition("warning: ")[2] for finding in check(grammar)]
    assert told == [
        "<nobody.spoken> is not used by any rule - use it, or take it out",
        '@spoken limits <nam.spoken>, which stands in no rule - did you mean "name"?',
        "<name.spoken> has limits in line 5, and only the last ones count"
        " - take one of the two marks out",
        '"mary ann" (and 1 more) cannot stand in <name.spoken>'
        " - take it out of names.txt, or let the slot take it",
    ]


def test_what_an_app_may_remember_is_a_known_mark(write):
    rules = "/** @remember likes */ public <a> = i like <thing.spoken>;"
    assert not check(load_grammar(write(rules)))


def test_two_slots_that_may_share_words_are_no_finding(talk):
    assert not [found for found in check(talk) if "means" in str(found)]


# What the commands show


def test_expansion_shows_what_a_slot_usually_is(talk, capsys):
    shown = list(sentences(talk, talk.public_rules, 100, ShownWays))
    assert {"my name is anna", "put <what> and <where>", "call <friend>"} < {*shown}
    assert count_sentences(talk) == len(shown) == len({*shown})
    main(["grammar", "expand", str(talk.path), "--count"])
    assert f"{len(shown)} sentences" in capsys.readouterr().out
    main(["grammar", "expand", str(talk.path), "--random", "5", "--tags", "--rule", "introduce"])
    lines = capsys.readouterr().out.splitlines()
    assert any("=> introduce: name=" in line for line in lines)


@given(st.randoms(use_true_random=False))
def test_what_is_expanded_is_understood(talk, chance):
    for rule in talk.public_rules:
        sentence = next(random_sentences(talk, chance, (rule,), ShownWays))
        assert parse(talk, sentence).rule == rule


def test_what_is_expanded_is_a_file_of_expectations(talk, tmp_path, capsys):
    main(["grammar", "expand", str(talk.path), "-n", "30", "--tags"])
    (tmp_path / "lines.txt").write_text(capsys.readouterr().out)
    assert main(["grammar", "test", str(tmp_path / "lines.txt"), "--grammar", str(talk.path)]) == 0


def test_parse_shows_slots(talk, capsys):
    main(["grammar", "parse", str(talk.path), "my name is Jean-Luc"])
    assert capsys.readouterr().out.splitlines() == [
        "my name is jean-luc",
        "introduce {name=Jean-Luc}",
        "  <introduce> my name is (jean-luc)",
    ]
    main(["grammar", "parse", str(talk.path), "my name is Jean-Luc", "--json"])
    answer = json.loads(capsys.readouterr().out)
    assert answer["free"] == [3]
    assert answer["slots"] == [{"name": "name", "text": "Jean-Luc", "start": 3, "end": 4}]
    main(["grammar", "parse", str(talk.path), "hello", "--json"])
    assert json.loads(capsys.readouterr().out)["slots"] == []


def test_confusion_is_looked_for_among_what_is_listed(talk, capsys):
    assert main(["grammar", "confuse", str(talk.path)]) == 0
    assert "among 4 sentences" in capsys.readouterr().out


# Whatever is typed

WORD = st.text(string.ascii_letters + "éßñ'-", min_size=2, max_size=10).filter(
    lambda word: word[0] not in "'-" and word[-1] not in "'-"
)


@given(WORD)
@example("McDonald")
@example("Jean-Luc")
@example("ß" * 5)
def test_a_value_comes_back_as_it_was_typed(talk, name):
    if name.lower() not in talk.words():
        assert parse(talk, f"Well: My name is {name}!") is None
        assert parse(talk, f"My NAME is {name}!").tags == {"name": name}


@given(st.text(max_size=60))
@example("İ" * 4)
@example("\N{ROMAN NUMERAL TWELVE} ½ <name> <b>")
def test_words_keep_their_letters_one_by_one(text):
    assert len(as_typed(text)) == len(typed(text))


@given(
    st.lists(st.sampled_from(["put", "and", "call", "my name is", "Anna", "2", "$1,000", "a-b"]))
    | st.lists(st.text(max_size=12), max_size=30)
)
def test_no_text_is_too_odd(talk, words):
    text = " ".join(words)
    found = parse(talk, text)
    if found is not None:
        again = parse(talk, found.as_typed)
        assert (again.rule, again.tags) == (found.rule, found.tags)


def test_no_text_takes_long(write):
    slots = " and ".join(f"<s{number}.spoken 1-50>" for number in range(5))
    limits = "\n".join(f"@spoken s{number} 990-999 letters" for number in range(5))
    grammar = load_grammar(write(f"/** {limits} */\npublic <a> = put {slots};"))
    started = time.process_time()
    for text in ("put " + "and " * 199, "put " + "a and " * 99, "put " + "x" * 100_000 + " and"):
        assert parse(grammar, text) is None
    assert time.process_time() - started < 5.0
