"""What people may say to a question, beside the sentences of its grammar."""

import pytest

from hri.core.signals import Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.acceptance import judge
from hri.speech.answering import answering
from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.merging import with_interrupts_of

PIZZA = """
public <order> =
    (small {size=small} | medium {size=medium} | large {size=large}) [pizza] [with <topping>];
public <topping> = (olives | bacon) {topping};
public <number> = two {number=2} | seven {number=7};
/** @careful */
public <go> = go to the kitchen;
/** @interrupts */
public <wait> = wait a moment;
"""


@pytest.fixture
def asked(write):
    return answering(load_grammar(write(PIZZA)))


@pytest.mark.parametrize(
    ("text", "rule", "tags"),
    [
        ("large", "order", {"size": "large"}),
        ("um well a large one please", "order", {"size": "large"}),
        ("a large one please with ham", "order", {"size": "large"}),
        ("i think we would take the small pizza today", "order", {"size": "small"}),
        ("i'd like a small with olives please", "order", {"size": "small", "topping": True}),
        ("make it two please", "number", {"number": 2}),
        ("robin please go to the kitchen", "go", {}),
        ("never mind", "asking.cancel", {}),
        ("oh forget it please", "asking.cancel", {}),
        ("pardon", "asking.again", {}),
        ("sorry what did you say", "asking.again", {}),
        ("could you say that again please", "asking.again", {}),
    ],
)
def test_people_may_say_more_than_the_answer(asked, text, rule, tags):
    found = parse(asked.called("Robin"), text)
    assert (found.rule, found.tags) == (rule, tags)


@pytest.mark.parametrize(
    "text",
    [
        "i want to have two of them",
        "we should go to the kitchen now",
        "the train will wait a moment",
    ],
)
def test_what_is_short_moves_or_interrupts_is_exact(asked, text):
    assert parse(asked, text) is None


def test_a_mark_of_the_author_lets_a_short_answer_count_among_other_words(write):
    asked = answering(load_grammar(write("/** @anywhere */\npublic <n> = two {n=2};")))
    assert parse(asked, "i want to have two of them").tags == {"n": 2}


@pytest.mark.parametrize("words", ["never mind | what", "<asking.cancel> | <asking.again>"])
def test_own_rules_for_the_same_words_win(write, words):
    asked = answering(load_grammar(write(f"import <asking.*>;\npublic <mine> = {words} | red;")))
    assert {parse(asked, text).rule for text in ("never mind", "what", "the red one")} == {"mine"}
    assert parse(asked, "cancel it").rule == ("mine" if "<" in words else "asking.cancel")


def test_a_grammar_of_another_language_is_as_it_is(write):
    path = write("")
    path.write_text("#JSGF V1.0 UTF-8 de;\ngrammar farbe;\npublic <farbe> = rot | blau;\n")
    grammar = load_grammar(path)
    assert answering(grammar) is grammar


def test_stop_among_noises_is_stop_though_it_is_an_answer_too(write, companion):
    own = answering(load_grammar(write("public <next> = go on | stop {next=end};")))
    both = with_interrupts_of(own, companion)
    heard = judge(both, Segment(0, 1), Hypothesis("<any> stop <any>", 0.99))
    assert isinstance(heard, Utterance)
    assert heard.rule == "stop"
