"""Other ways to say a sentence: the file, and what a text is taken for."""

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError
from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.excerpt import excerpt
from hri.speech.grammar.guessing import LEAST_SURE, guess_rule, paraphrased

GRAMMAR = """#JSGF V1.0;
grammar small;

/** @example turn around */
public <turn> = turn (around | left {angle=90});

public <greet> = hi | hello there;

/** @topic chat
 *  @example tell me a joke
 */
public <joke> = [please] tell me a joke;

/** @topic chat */
public <ill> = i'm sick;

public <sneeze> = sneeze;

/** @careful */
public <go> = go home now;

/** @interrupts */
public <stop> = stop that;
"""
PARAPHRASES = """# As people type it.
[joke]
got any gags
Make me laugh!
what's funny today

[ill]
my stomach hurts
i threw up twice last night
i broke my arm

[greet]
hi hello you

[turn ?]
face the window
look the other way

[-]
the laundry is still wet
my arm is longer than yours
"""


@pytest.fixture
def written(tmp_path):
    def write(paraphrases=PARAPHRASES):
        (tmp_path / "small.jsgf").write_text(GRAMMAR)
        (tmp_path / "small.paraphrases.txt").write_text(paraphrases)
        return tmp_path / "small.jsgf"

    return write


@pytest.fixture
def grammar(written):
    return load_grammar(written())


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("got any good gags", "tell me a joke"),
        ("make us laugh", "tell me a joke"),
        ("I threw up, I think", "i'm sick"),
        ("my stomach still hurts", "i'm sick"),
    ],
)
def test_a_text_means_the_rule_whose_paraphrases_it_is_like(grammar, text, sentence):
    assert parse(grammar, text) is None
    assert paraphrased(grammar, text).text == sentence


@pytest.mark.parametrize(
    "text", ["the laundry is wet", "zebras", "", "make me a tent", "wet " * 40]
)
def test_a_text_that_is_like_none_means_nothing(grammar, text):
    assert paraphrased(grammar, text) is None


def test_what_is_only_about_a_rule_is_never_taken_for_it(grammar):
    found = guess_rule(grammar, "please face the window")
    assert (found.rule, found.is_vague) == ("turn", True)
    assert found.probability >= LEAST_SURE
    assert paraphrased(grammar, "please face the window") is None


def test_a_word_of_a_rule_without_paraphrases_speaks_for_that_rule(grammar):
    assert paraphrased(grammar, "got any gags please").rule == "joke"
    assert paraphrased(grammar, "got any gags sneeze") is None


def test_a_rule_that_does_not_count_now_is_not_meant(grammar):
    assert paraphrased(grammar, "got any gags", {"greet", "joke"}).rule == "joke"
    assert paraphrased(grammar, "got any gags", {"greet"}) is None


def test_a_greeting_gives_way_to_what_follows_it_and_an_order_does_not(grammar):
    for text, rule in (
        ("hi i broke my arm", "ill"),
        ("turn around i broke my arm", None),
        ("stop that i broke my arm", None),
    ):
        part = excerpt(grammar, text)
        assert part is not None
        found = paraphrased(grammar, text, part=part)
        assert (found and found.rule) == rule


@pytest.mark.parametrize(
    ("paraphrases", "place", "what"),
    [
        ("[jok]\nhaha\n", "1:1", 'no public rule <jok> in small - did you mean "joke"?'),
        ("haha\n", "1:1", "no rule above this line"),
        ("[turn]\nspin\n", "1:1", "<turn> gives values, so no guess may mean it - write [turn ?]"),
        ("[go]\nmove\n", "1:1", "<go> moves the robot, so no guess may mean it - write [go ?]"),
        ("[joke\nhaha\n", "1:1", "[joke is not a name - write [rule]"),
        ("[joke]\nhaha\n[ill]\n\nHaha!\n", "5:1", '"Haha!" stands in line 2, too'),
        ("[joke]\nhaha\n[ill]\nouch\n[joke]\nhoho\n", "5:1", "[joke] stands in line 1, too"),
    ],
)
def test_a_mistake_in_the_file_is_refused_with_its_place(written, paraphrases, place, what):
    with pytest.raises(AuthoringError) as refused:
        load_grammar(written(paraphrases))
    assert f"small.paraphrases.txt:{place}: {what}" in str(refused.value)


def test_a_file_that_changed_is_read_again(written):
    assert paraphrased(load_grammar(written()), "give me a giggle") is None
    changed = PARAPHRASES.replace("got any gags", "give me a giggle")
    assert paraphrased(load_grammar(written(changed)), "give me a giggle").rule == "joke"


def test_a_grammar_that_extends_another_has_its_paraphrases(written, tmp_path):
    written()
    (tmp_path / "more.jsgf").write_text(
        "#JSGF V1.0;\n/** @extends small */\ngrammar more;\npublic <sing> = sing;\n"
    )
    assert paraphrased(load_grammar(tmp_path / "more.jsgf"), "got any gags").rule == "joke"


def test_a_topic_that_is_left_out_is_not_meant(grammar):
    assert paraphrased(grammar.without(["chat"]), "got any gags") is None


WORDS = st.sampled_from(("my", "stomach", "hurts", "turn", "around", "the", "laundry", "gags", "x"))


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    folder = tmp_path_factory.mktemp("grammar")
    (folder / "small.jsgf").write_text(GRAMMAR)
    (folder / "small.paraphrases.txt").write_text(PARAPHRASES)
    return load_grammar(folder / "small.jsgf")


@given(words=st.lists(WORDS, max_size=40))
def test_whatever_is_typed_a_guess_is_a_sentence_of_its_rule(kept, words):
    found = paraphrased(kept, " ".join(words))
    if found is not None:
        assert found.rule in ("joke", "ill")
        assert parse(kept, found.text).rule == found.rule
