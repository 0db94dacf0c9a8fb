"""What is said after a command changes that command, and means nothing else."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.acceptance import judge
from hri.speech.grammar import load_grammar
from hri.speech.grammar.follow_ups import Followed, resolved
from hri.speech.grammar.lint.expectations import failures, read_expectations
from hri.speech.grammar.matching import parse
from hri.speech.turn import Turn

MOVES = """
/** @careful */ public <move> = go forward {distance=0.5};
/** @careful */ public <turn> = turn left {angle=90} | turn right {angle=-90};
public <sing> = sing a song;
/** @after move turn
 *  @as last */
public <other_way> = [no] the other way {distance*=-1 angle*=-1};
/** @after move turn
 *  @as turn */
public <to_side> = no i mean left {angle=90};
/** @after sing */
public <liked> = i liked that;
/** @after any */
public <why> = why is that;
"""


@pytest.fixture
def moves(write):
    return load_grammar(write(MOVES))


def heard(grammar, text, last=None):
    piece = Segment(1.0, 2.0, text=text)
    return judge(grammar, piece, Hypothesis(text, 1.0), 0.5, Turn(last=last))


def test_it_is_the_command_before_with_its_tags_changed(moves):
    found = heard(moves, "no the other way", Followed("turn", {"angle": -30.0}))
    assert (found.rule, found.tags, found.follow_up) == ("turn", {"angle": 30.0}, "other_way")
    assert found.text == "no the other way"


def test_another_command_takes_over_no_tags(moves):
    found = heard(moves, "no i mean left", Followed("move", {"distance": 2.0}))
    assert (found.rule, found.tags) == ("turn", {"angle": 90.0})


@pytest.mark.parametrize("last", [None, Followed("sing", {})])
def test_it_counts_only_after_what_it_names(moves, last):
    found = heard(moves, "the other way", last)
    assert found.reason == "not now"
    assert found.detail == "<other_way> counts only soon after <move> or <turn>"
    assert "other_way" not in Turn(last=last).rules(moves)


def test_a_rule_of_its_own_counts_soon_after_another(moves):
    assert heard(moves, "i liked that", Followed("sing")).rule == "liked"
    assert heard(moves, "i liked that").reason == "not now"


@pytest.mark.parametrize("last", [Followed("sing"), Followed()])
def test_a_rule_may_count_after_whatever_was_understood(moves, last):
    assert heard(moves, "why is that", last).rule == "why"
    assert heard(moves, "why is that").detail.endswith("only soon after another command")


def test_what_moves_the_robot_must_be_heard_as_clearly_in_other_words(moves):
    last = Followed("move", {"distance": 1.0})
    said = Hypothesis("the other way", 0.52)
    assert judge(moves, Segment(0.0, 1.0), said, 0.5, Turn(last=last)).reason == "low confidence"


@given(angle=st.floats(-360, 360), times=st.integers(1, 6))
def test_the_other_way_and_back_is_as_before(angle, times):
    grammar = load_grammar("companion")
    last = Followed("turn", {"angle": angle})
    for _ in range(2 * times):
        found = resolved(grammar, parse(grammar, "the other way", {"other_way"}), last)
        last = Followed(found.rule, found.tags)
    assert math.isclose(last.tags["angle"], angle, abs_tol=1e-8)


@pytest.mark.parametrize(
    ("mark", "error"),
    [
        ("@after mvoe", '@after names "mvoe", which is not a command of this grammar'),
        ("@after", "@after names no command"),
        ("@as last", "@as stands without @after"),
        ("@after move\n * @as trun", '@as names "trun"'),
        ("@after any\n * @as last", "not every command has another form"),
        ("@after move\n * @as last\n * @anywhere", "may not count @anywhere"),
    ],
)
def test_a_mark_that_leads_nowhere_is_refused_with_its_place(write, mark, error):
    text = f"public <move> = go on;\npublic <turn> = turn now;\n/** {mark} */\npublic <x> = and so;"
    with pytest.raises(AuthoringError) as refused:
        load_grammar(write(text))
    assert error in str(refused.value)
    assert refused.value.place.line >= 5


def test_free_words_may_not_stand_for_an_order_to_move(write):
    text = MOVES + "/** @after move\n * @as last */ public <like> = like <any>;"
    with pytest.raises(AuthoringError, match="none of its words may be free"):
        load_grammar(write(text))


def test_lines_that_follow_the_line_before(moves, tmp_path):
    path = tmp_path / "lines.txt"
    path.write_text(
        "+ turn left => turn: angle=90\n++ the other way => turn: angle=-90\n"
        "++ the other way => turn: angle=90\n+ sing a song\n- the other way\n"
        "+ turn right\n++ no i mean left => turn: angle=-90\n"
    )
    (failure,) = failures(moves, read_expectations(path))
    assert str(failure).endswith("is understood as turn: angle=90 - expected turn: angle=-90")


@pytest.mark.parametrize(
    ("text", "rule"),
    [("hi", "greet"), ("hey there", "greet"), ("bye", "leave"), ("hush", "quiet")],
)
def test_what_is_too_short_for_the_ear_counts_when_it_is_typed(text, rule):
    grammar = load_grammar("companion")
    heard = judge(grammar, Segment(0, 1, text=text), Hypothesis(text, 1.0), turn=Turn())
    assert heard.rule == rule
    unheard = judge(grammar, Segment(0, 1), Hypothesis(text, 1.0), turn=Turn())
    assert unheard.reason == "not now"
    assert not grammar.graph().entries.keys() & grammar.marked("typed")


LEFT, AHEAD = Followed("turn", {"angle": 90.0}), Followed("move", {"distance": 1.0})


@pytest.mark.parametrize(
    ("text", "last", "rule", "tags"),
    [
        ("no no no stop", None, "stop", {}),
        ("watch out for the dog", None, "stop", {}),
        ("you're going to hit the cat", AHEAD, "stop", {}),
        ("no no no", LEFT, "stop", {}),
        ("let me through", None, "move", {"distance": -0.3}),
        ("take two steps forward", None, "move", {"distance": 0.6096}),
        ("go left you silly robot", None, "turn", {"angle": 90}),
        ("a bit to the right", None, "turn", {"angle": -20}),
        ("come and find me", None, "come", {}),
        ("don't stop", AHEAD, "move", {"distance": 1.0}),
        ("undo that", LEFT, "turn", {"angle": -90.0}),
        ("only half", AHEAD, "move", {"distance": -0.5}),
        ("too close", AHEAD, "move", {"distance": -0.3}),
        ("right", LEFT, "turn", {"angle": -90}),
    ],
)
def test_orders_are_typed_in_many_words(text, last, rule, tags):
    grammar = load_grammar("companion")
    found = judge(grammar, Segment(0, 1, text=text), Hypothesis(text, 1.0), turn=Turn(last=last))
    assert (found.rule, found.tags) == (rule, pytest.approx(tags, abs=0.01))


@pytest.mark.parametrize("text", ["don't stop", "no no no", "undo that", "only half"])
def test_what_changes_a_motion_means_nothing_without_one(text):
    grammar = load_grammar("companion")
    found = judge(grammar, Segment(0, 1, text=text), Hypothesis(text, 1.0), turn=Turn())
    assert found.reason == "not now"


def test_an_urgent_line_is_obeyed_while_the_robot_speaks_and_such_words_are_not_heard():
    grammar = load_grammar("companion")
    assert "urgent" in Turn(is_speaking=True, is_typed=True).rules(grammar)
    assert "urgent" not in Turn(is_speaking=True).rules(grammar)


@pytest.mark.parametrize("text", ["that's enough", "whoa whoa", "right there", "hold it"])
def test_that_is_enough_stops_only_what_was_told_to_move(text):
    grammar = load_grammar("companion")
    line, words = Segment(0, 1, text=text), Hypothesis(text, 1.0)
    moving = Turn(last=Followed("move", {"distance": 1.0}))
    assert judge(grammar, line, words, turn=moving).rule == "stop"
    assert judge(grammar, line, words, turn=Turn()).reason == "not now"


@pytest.mark.parametrize(
    "text",
    ["don't go there stop right now", "never mind that just stop", "stop talking and stop"],
)
@pytest.mark.parametrize("turn", [Turn(), Turn(is_speaking=True), Turn(is_question_open=True)])
def test_a_typed_sentence_that_ends_with_stop_stops(text, turn):
    heard = judge(
        load_grammar("companion"), Segment(0, 1, text=text), Hypothesis(text, 1.0), turn=turn
    )
    assert heard.rule == "stop"
