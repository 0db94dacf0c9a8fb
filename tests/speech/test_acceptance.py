from __future__ import annotations

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import HeardSlot, Rejection, Utterance
from hri.hal.recognizer import Alternative, HeardWord, Hypothesis, Segment
from hri.speech.acceptance import LIKELY, agreed, disputed, judge
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.turn import Turn, Wakefulness

PIECE = Segment(10.0, 12.0, quiet=0.5)


@pytest.fixture
def grammar(write):
    return load_grammar(
        write(
            "/** @careful */ public <move> = go (forward | back {way=back});\n"
            "/** @interrupts */ public <stop> = stop;\n"
            "/** @answer */ public <yes> = yes;\n"
            "public <greet> = hello [robot];\n"
        )
    )


def reason(grammar, text, confidence=0.9, turn=None, *alternatives):
    hypothesis = Hypothesis(text, confidence, alternatives=alternatives)
    result = judge(grammar, PIECE, hypothesis, 0.5, turn)
    return result.reason if isinstance(result, Rejection) else result.rule


def test_what_is_clear_counts_and_every_rejection_has_its_reason(grammar):
    assert reason(grammar, "hello", 0.5) == "greet"
    assert reason(grammar, "") == "no speech"
    assert reason(grammar, "hello fish") == "not in grammar"
    assert reason(grammar, "hello", 0.49) == "low confidence"


def test_a_sentence_of_the_grammar_that_does_not_fit_the_sound_is_called_the_nearest(grammar):
    result = judge(grammar, PIECE, Hypothesis("go back", 0.05))

    assert (result.reason, result.text) == ("unlike the sound", "go back")
    assert result.detail == "the nearest sentence, but it does not fit"
    assert reason(grammar, "hello fish", 0.05) == "not in grammar"


def test_what_moves_the_robot_must_be_heard_more_clearly(grammar):
    assert reason(grammar, "go back", 0.52) == "low confidence"
    assert reason(grammar, "go back", 0.56) == "move"


@pytest.mark.parametrize(
    ("deed", "other", "is_meant"),
    [
        ("call my mother", "call my mother", True),
        ("call my mother at noon", "call my mother", True),
        ("call me mother", "call my mother", False),
        ("say stop now", "stop now", False),
        ("phone", "phone", False),
    ],
)
def test_words_of_a_free_slot_are_no_command_but_a_stop_counts(write, deed, other, is_meant):
    grammar = load_grammar(
        write(
            "public <remind> = remind me to <deed.spoken 1-9>;\n"
            "public <phone> = call my mother | phone;\n"
            "/** @interrupts */ public <stop> = stop now;\n"
        )
    )
    slot = HeardSlot("deed", deed, (), 0.9, ())
    hypothesis = Hypothesis(
        f"remind me to {deed}", 0.9, alternatives=(Alternative(other, 0.95),), slots=(slot,)
    )
    assert isinstance(judge(grammar, PIECE, hypothesis), Utterance) == is_meant


def test_what_may_as_well_mean_something_else_is_doubted(grammar):
    other, same = Alternative("go forward", 0.45), Alternative("hello robot", 0.45)

    assert reason(grammar, "go back", 0.9, None, other) == "low confidence"
    assert reason(grammar, "hello", 0.9, None, same) == "greet"
    rejection = judge(grammar, PIECE, Hypothesis("go back", 0.9, alternatives=(other,)))
    assert rejection.detail == 'as likely: "go forward"'


def test_what_all_likely_sentences_agree_on_is_sure(write):
    grammar = load_grammar(
        write(
            "public <order> = (small {size=small} | large {size=large}) coffee\n"
            "  [with (soy milk {milk=soy} | oat milk {milk=oat})];\n"
            "public <stop> = stop;\n"
        )
    )

    def judged(confidence, *alternatives):
        said = Hypothesis("large coffee with oat milk", confidence, alternatives=alternatives)
        return judge(grammar, PIECE, said)

    soy = Alternative("large coffee with soy milk", 0.6)
    rejection = judged(0.9, soy, Alternative("small coffee with oat milk", 0.02))
    assert (rejection.sure, rejection.unsure) == ({"size": "large"}, ("milk",))
    black = judged(0.9, Alternative("large coffee", 0.6))
    assert (black.sure, black.unsure) == ({"size": "large"}, ("milk",))
    other = judged(0.9, Alternative("stop", 0.6))
    assert (other.sure, other.unsure) == ({}, ())
    unclear = judged(0.4)
    assert (unclear.sure, unclear.unsure) == ({"size": "large", "milk": "oat"}, ())
    far = judged(0.05)
    assert (far.reason, far.sure) == ("unlike the sound", {})


@pytest.mark.proves("R02")
def test_only_listed_words_are_recognized(grammar):
    for text in ("go", "go forward back", "forward go", "robot hello", "stop stop"):
        assert reason(grammar, text, 1.0) == "not in grammar"


def test_while_the_robot_speaks_only_what_interrupts_counts(grammar):
    speaking = Turn(is_speaking=True)

    assert reason(grammar, "stop", 0.9, speaking) == "stop"
    assert reason(grammar, "stop", 0.6, speaking) == "robot speaking"
    assert reason(grammar, "hello", 0.9, speaking) == "robot speaking"
    assert reason(grammar, "", 0.9, speaking) == "robot speaking"


def test_an_answer_counts_while_a_question_is_open(grammar):
    asked = Turn(is_question_open=True, is_addressed=False)
    assert reason(grammar, "yes", 0.5, asked) == "yes"
    assert reason(grammar, "yes", 0.4, asked) == "low confidence"
    result = judge(grammar, PIECE, Hypothesis("yes", 0.9), 0.5, Turn())
    assert (result.reason, result.detail) == (
        "not now",
        "<yes> counts only while a question is open",
    )


def test_without_a_turn_all_rules_count_and_none_is_expected(grammar):
    assert reason(grammar, "yes", 0.5) == "yes"
    assert reason(grammar, "yes", 0.4) == "low confidence"


def test_without_the_wake_word_little_counts(write):
    grammar = load_grammar(
        write("/** @wake */ public <hey> = hey robot;\npublic <greet> = hello;", "wake")
    )
    asleep = Turn(is_awake=False)

    assert asleep.rules(grammar) == {"hey"}
    assert Turn(is_awake=True).rules(grammar) == {"hey", "greet"}
    assert Turn(is_awake=False, is_question_open=True).rules(grammar) == {"hey", "greet"}
    result = judge(grammar, PIECE, Hypothesis("hello", 0.9), 0.5, asleep)
    assert result.detail == "<greet> counts only after the wake word"


def test_an_answer_waits_for_a_question_also_while_the_robot_is_not_addressed(grammar, write):
    asleep = Turn(is_awake=False)
    result = judge(grammar, PIECE, Hypothesis("yes", 0.9), 0.5, asleep)
    assert result.detail == "<yes> counts only while a question is open"
    waking = load_grammar(
        write("/** @wake */ public <hey> = hey robot;\n/** @answer */ public <yes> = yes;", "wake")
    )
    result = judge(waking, PIECE, Hypothesis("yes", 0.9), 0.5, asleep)
    assert result.detail == "<yes> counts only while a question is open"


def test_no_wake_word_is_needed_for_a_while(grammar):
    wakefulness = Wakefulness(follow_up=8.0)

    assert not wakefulness.is_awake(0.0)
    wakefulness.extend(10.0)
    assert wakefulness.is_awake(18.0)
    assert not wakefulness.is_awake(18.1)


def test_the_times_are_those_of_the_words(grammar):
    words = (HeardWord("go", 0.3, 0.5), HeardWord("back", 0.6, 1.0))

    timed = judge(grammar, PIECE, Hypothesis("go back", 0.9, words))
    untimed = judge(grammar, PIECE, Hypothesis("go back", 0.9))

    assert (timed.start, timed.end) == (10.3, 11.0)
    assert [word.start for word in timed.words] == [10.3, 10.6]
    assert (untimed.start, untimed.end) == (10.0, 11.5)


@given(st.text(max_size=40), st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.booleans())
def test_any_hypothesis_gets_a_verdict(companion, text, confidence, share, strictness, speaking):
    hypothesis = Hypothesis(text, confidence, alternatives=(Alternative("stop", share),))

    result = judge(companion, PIECE, hypothesis, strictness, Turn(is_speaking=speaking))

    assert 0.0 <= result.confidence <= confidence
    if isinstance(result, Utterance) and result.rule not in companion.marked("answer"):
        assert result.confidence >= strictness


MANY_WAYS = """#JSGF V1.0;
grammar ways;
/** @careful */ public <move> = go [on] (two {far=2} | 100 {far=3}) | (go | hey) {far=1};
public <name> = hey <any> {known=true} | what's <any>;
/** @anywhere */ public <ask> = what's (on {what=1} | two {what=2});
/** @wake */ public <hey> = hey [robot] [go {wake=true}];
/** @answer */ public <answer> = (go [on] [two] | two | what's on) {yes=true};
/** @interrupts */ public <stop> = stop | (go | hey) [two] {leave=true};
"""
SAID = ("go", "go 2", "go on two", "hey", "hey go", "what is on", "so what's two", "hey ann", "")
WORDS = ("go", "on", "two", "hey", "stop", "what's", "robot", "ann", "<any>")
TEXTS = st.one_of(st.sampled_from(SAID), st.lists(st.sampled_from(WORDS), max_size=4).map(" ".join))


@pytest.fixture(scope="module")
def many_ways(tmp_path_factory):
    path = tmp_path_factory.mktemp("ways") / "ways.jsgf"
    path.write_text(MANY_WAYS)
    return load_grammar(path)


@given(
    TEXTS,
    st.lists(st.builds(Alternative, TEXTS, st.floats(0, 0.3)), max_size=3),
    st.builds(Turn, st.booleans(), st.booleans(), st.booleans()),
    st.floats(0, 1),
)
@settings(max_examples=300, deadline=None)
def test_a_text_means_what_the_answers_make_of_it_or_the_rules_that_count_or_all(
    many_ways, text, others, turn, confidence
):
    rules = turn.rules(many_ways)
    answers = many_ways.marked("answer") if turn.is_question_open else ()
    stops = many_ways.marked("interrupts") if "<any>" in text.split() else ()
    ways = [parse(many_ways, text.replace("<any>", ""), stops)]
    ways += (parse(many_ways, text, some) for some in (answers, rules, None))
    found = next(filter(None, ways), None)
    meant = [(one.share, parse(many_ways, one.text)) for one in others]
    doubt = sum(
        share
        for share, one in meant
        if found is None or one is None or (one.rule, one.tags) != (found.rule, found.tags)
    )

    judged = judge(many_ways, PIECE, Hypothesis(text, confidence, (), tuple(others)), 0.5, turn)

    assert judged.confidence == confidence * (1.0 - min(1.0, doubt))
    if isinstance(judged, Utterance):
        assert (judged.rule, judged.tags) == (found.rule, found.tags)
        assert found.rule in rules
    elif judged.reason == "low confidence":
        likely = [found, *(one for share, one in meant if share >= LIKELY and one is not None)]
        assert (judged.sure, judged.unsure) == (agreed(likely), disputed(likely))
    elif judged.reason == "not now":
        assert found.rule not in rules
    elif judged.reason == "not in grammar":
        assert found is None


ANYWHERE = """
/** @anywhere */
public <turn> = turn (left {side=left} | right {side=right});
/** @anywhere */
public <greet> = good morning;
/** @anywhere
 *  @answer */
public <yes> = of course {answer=yes} | not now {answer=no};
"""


@pytest.mark.parametrize(
    ("text", "other", "choices", "unsure"),
    [
        ("so turn left and turn right", "turn left", ("turn right", "turn left"), ("side",)),
        ("good morning now turn left", "good morning", ("turn left", "good morning"), ()),
    ],
)
@pytest.mark.parametrize("strictness", [0.1, 0.5])
def test_of_two_phrases_that_are_equally_specific_none_is_chosen(
    write, text, other, choices, unsure, strictness
):
    grammar = load_grammar(write(ANYWHERE))
    rejection = judge(grammar, PIECE, Hypothesis(text, 1.0), strictness)
    assert rejection.reason == "low confidence"
    assert rejection.detail == f'as likely: "{other}"'
    assert (rejection.choices, rejection.unsure) == (choices, unsure)


def test_phrases_that_mean_the_same_or_are_less_specific_or_no_answers_are_not_doubted(write):
    grammar, asked = load_grammar(write(ANYWHERE)), Turn(is_question_open=True)
    assert reason(grammar, "turn left i said turn left") == "turn"
    assert reason(grammar, "of course turn left", 0.9, asked) == "yes"
    assert reason(grammar, "of course or not now", 0.9, asked) == "low confidence"


@pytest.fixture
def phrases(write):
    return load_grammar(
        write(
            "/** @anywhere */ public <leave> = see you later;\n"
            "/** @anywhere */ public <greet> = good morning [<me>];\n"
            "public <call> = my name is <any>;\n"
            "/** @name */ <me> = robot | robin;\n"
        )
    )


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("see you later", "leave"),
        ("<any> see you later <any>", None),
        ("<any> robin <any> see you later", "leave"),
        ("<any> see you later <any> robot", "leave"),
        ("well good morning robin", "greet"),
        ("good morning everybody", None),
        ("my name is <any>", "call"),
    ],
)
def test_a_phrase_among_other_words_counts_when_they_are_said_to_the_robot(phrases, text, rule):
    elsewhere = "not now"
    assert reason(phrases, text, 0.9, Turn(is_addressed=False)) == (rule or elsewhere)
    assert reason(phrases, text, 0.9, Turn()) != elsewhere


def test_what_was_said_to_someone_else_says_so(phrases):
    words = Hypothesis("<any> see you later", 0.9)
    overheard = judge(phrases, PIECE, words, turn=Turn(is_addressed=False))
    assert (overheard.reason, overheard.detail) == ("not now", "said to someone else")
    typed = judge(
        phrases, Segment(0, 0, text="then see you later"), words, turn=Turn(is_addressed=False)
    )
    assert typed.rule == "leave"


def test_its_name_counts_only_where_nothing_else_is_likely(phrases):
    turn, named = Turn(is_addressed=False), "<any> robin <any> see you later"
    other = Alternative("<any> see you later", 0.2)
    assert reason(phrases, named, 0.9, turn, other) == "not now"
    assert reason(phrases, named, 0.9, turn, Alternative(other.text, 0.01)) == "leave"


def test_small_talk_of_others_is_not_answered(write):
    """A rule with a topic is what people also say to each other."""
    grammar = load_grammar(write("/** @topic about_me */ public <age> = how old are you;"))
    words = Hypothesis("how old are you", 0.95)
    overheard = judge(grammar, PIECE, words, turn=Turn(is_addressed=False))
    assert (overheard.reason, overheard.detail) == ("not now", "said to someone else")
    assert judge(grammar, PIECE, words, turn=Turn()).rule == "age"


def test_a_slot_that_loses_against_its_own_sound_is_asked_for_alone(write):
    grammar = load_grammar(
        write(
            "public <order> = (small {size=small} | large {size=large}) coffee\n"
            "  with (soy milk {milk=soy} | oat milk {milk=oat});\n"
        )
    )
    text = "large coffee with oat milk"

    def judged(oat, strictness=0.5):
        words = [HeardWord(word, 0.0, 0.1, oat if word == "oat" else 0.99) for word in text.split()]
        return judge(grammar, PIECE, Hypothesis(text, 0.9, tuple(words)), strictness)

    assert judged(0.98).tags == {"size": "large", "milk": "oat"}
    rejection = judged(0.05)
    assert (rejection.reason, rejection.detail) == (
        "low confidence",
        'unsure of "coffee with oat milk"',
    )
    assert (rejection.sure, rejection.unsure) == ({"size": "large"}, ("milk",))
    assert judged(0.05, strictness=0.0).tags == {"size": "large", "milk": "oat"}


def test_a_filled_free_slot_of_a_command_wins_over_small_talk_and_two_commands_are_a_doubt(write):
    chat = "/** @topic fun */ public <chat> = how do you spell <any 1-2>;\n"
    spell = "public <spell> = how do you spell <word.spoken 1-2>;\n"
    assert reason(load_grammar(write(spell + chat)), "how do you spell cat") == "spell"
    other = "public <write> = how do you spell <any 1-2>;\n"
    assert reason(load_grammar(write(spell + other)), "how do you spell cat") == "low confidence"
